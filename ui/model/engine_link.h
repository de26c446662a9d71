// The window's line to the engine: a local one that is started when first needed, or one that runs already
// (--engine). Everything that waits does so on a thread of the link; answers are signals in the window's
// thread.
#pragma once
#include <QDateTime>
#include <QImage>
#include <QObject>
#include <QString>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/service/client/connection_file.h"
#include "ui/model/document.h"

namespace footwall::ui {

struct FaultSurface;

// Statistics of faces by name, as one answer of the engine brings them. Entry n of each is of face n.
struct EngineNumbers {
  std::uint64_t edit = 0;  // the newest edit that they know of, with all before it
  // Of each fault here, the surface that the engine had when it computed them.
  std::map<Id, std::shared_ptr<const FaultSurface>> computed_on;
  std::vector<std::int64_t> faults, panels;
  std::vector<std::int32_t> face_numbers;
  std::map<std::string, std::vector<double>> statistics;
};

struct PictureRequest {
  std::array<double, 16> view_projection{};  // row major, scene metres to clip space (engine.proto, Camera)
  std::array<double, 3> eye{}, right{}, up{}, forward{};
  bool perspective = true;
  int width = 0, height = 0;
  struct Isosurface {
    Id volume = 0;
    float value = 0;
    QRgb colour = 0;
    std::array<double, 9> linear{};  // of the volume's index space to the scene, row major
    std::array<double, 3> shift{};
  };
  std::vector<Isosurface> isosurfaces;
};

// A picture with its depths (OpenGL window depth, row 0 on top, 1 = background), whole or after a pass.
struct Picture {
  std::uint64_t request = 0;
  QImage colours;  // RGBA8888
  std::vector<float> depths;
  bool last = false;
};

class EngineLink final : public QObject {
  Q_OBJECT

 public:
  enum class State { kOff, kStarting, kReady, kBusy, kLost };
  struct Options {
    int ranks = 0;                // 0: half the cores, at least one
    QString connection = {};      // "@FILE" or an address; empty: a local engine
    bool starts_at_once = false;  // as soon as there is a volume that statistics can be of
  };

  EngineLink(Document& document, const Options& options, QObject* parent = nullptr);
  // Ends a local engine.
  ~EngineLink() override;

  State state() const;
  // "2 ranks", "stopped: killed by signal 9": what stands behind "engine:" in the status line.
  QString state_text() const;
  int ranks() const;
  // How to reach the engine that runs; nothing where none does.
  std::optional<service::Connection> connection() const;
  // Whether it was told to start, and not to stop since.
  bool is_wanted() const;
  // Starts it, or again after kLost. Returns at once.
  void start();
  void stop();

  // The volume that statistics are of. Opens it, and tells the engine the faults again.
  void set_volume(Id volume);
  Id volume() const;
  // The newest edit that numbers have come for: all up to it are answered.
  std::uint64_t answered() const;
  // When numbers came last; invalid where none have come.
  QDateTime answered_at() const;
  // The faces of a fault are these from now on; numbers() of those that changed follow, under the number
  // returned or a later one. Newest wins. While there is no engine the newest surfaces are kept for when
  // there is one.
  std::uint64_t put_fault(const std::shared_ptr<const FaultSurface>& surface);
  std::uint64_t remove_fault(Id fault);

  // A picture; a newer request takes the place of one that waits, and cancels the one under way.
  std::uint64_t draw(const PictureRequest& request);

 Q_SIGNALS:
  void state_changed();
  void volume_changed();  // statistics are of another volume from now on
  void numbers(const footwall::ui::EngineNumbers& numbers);
  void picture(std::shared_ptr<const footwall::ui::Picture> picture);
  void failed(const QString& message, const QString& hint);

 private:
  struct Private;
  std::unique_ptr<Private> private_;
};

}  // namespace footwall::ui
