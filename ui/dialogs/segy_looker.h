// Looks at a SEG-Y file on a thread of its own: the window never waits for its headers.
#pragma once
#include <QObject>
#include <QString>
#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "storage/formats/segy/survey_look.h"

namespace footwall::ui {

struct SegyLook {
  std::uint64_t request = 0;  // the look() that it answers; of a line, the one before it
  std::shared_ptr<const formats::segy::SurveyLook> survey;
  formats::segy::LinePreview line;
};

class SegyLooker final : public QObject {
  Q_OBJECT

 public:
  explicit SegyLooker(std::filesystem::path file, QObject* parent = nullptr);
  // Cancels what is under way and waits for it.
  ~SegyLooker() override;

  // The newest request wins; one under way is cancelled. Returns its number: an answer to an older one may
  // still be on its way.
  std::uint64_t look(const formats::segy::Options& options);
  // Another line of the file as it was looked at last; no second pass over the headers. No index: the middle.
  void show_line(bool of_inline, std::optional<std::int64_t> index);

 Q_SIGNALS:
  void looked(std::shared_ptr<const footwall::ui::SegyLook> look);
  // The file cannot be read at all, or the options cannot be.
  void failed(quint64 request, const QString& message, const QString& hint);
  void progressed(double fraction);

 private:
  void work();
  void look_once(const std::optional<formats::segy::Options>& options, std::uint64_t request, bool of_inline,
                 std::optional<std::int64_t> index, const JobContext& job);

  const std::filesystem::path file_;
  std::shared_ptr<const formats::segy::SurveyLook> survey_;  // the thread's

  std::mutex mutex_;  // all below
  std::condition_variable wanted_;
  std::optional<formats::segy::Options> options_;
  std::uint64_t last_request_ = 0;
  bool line_wanted_ = false;
  bool of_inline_ = true;
  std::optional<std::int64_t> index_;
  bool ending_ = false;
  JobContext job_;
  std::thread thread_;
};

}  // namespace footwall::ui
