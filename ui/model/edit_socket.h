// Takes edits from `footwall edit` while this program holds the project: a socket in a folder that nobody
// else may enter, named in the project's lock. Each line is one edit of the document, seen in the window at
// once and undone there. What is said on the socket: engine/tasks/edit_at_holder.h.
#pragma once
#include <QObject>
#include <QSocketNotifier>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "engine/session/private_folder.h"
#include "ui/model/document.h"

namespace footwall::ui {

class EditSocket final : public QObject {
  Q_OBJECT

 public:
  // Listens; who connects waits until serve(). Throws Error kIo.
  explicit EditSocket(QObject* parent = nullptr);
  // Ends all connections; the socket goes.
  ~EditSocket() override;

  const std::string& path() const { return path_; }
  // document lives longer.
  void serve(Document& document);

 private:
  struct Peer {
    std::unique_ptr<QSocketNotifier> readable, writable;
    std::string received, to_send;
    bool ends = false;  // once to_send is gone
  };

  void take_connections();
  void read_from(int socket);
  void apply_lines(int socket);
  void send_to(int socket);
  void drop(int socket);
  std::string answer_to(std::string_view line, bool& failed);

  session::PrivateFolder folder_;
  std::string path_;
  int listening_ = -1;
  std::unique_ptr<QSocketNotifier> arrivals_;
  Document* document_ = nullptr;
  std::map<int, Peer> peers_;
};

}  // namespace footwall::ui
