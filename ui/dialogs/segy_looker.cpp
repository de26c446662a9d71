#include "ui/dialogs/segy_looker.h"

#include <utility>

namespace footwall::ui {

SegyLooker::SegyLooker(std::filesystem::path file, QObject* parent)
    : QObject(parent), file_(std::move(file)), thread_([this] { work(); }) {}

SegyLooker::~SegyLooker() {
  {
    const std::scoped_lock lock(mutex_);
    ending_ = true;
    job_.cancel();
  }
  wanted_.notify_one();
  thread_.join();
}

std::uint64_t SegyLooker::look(const formats::segy::Options& options) {
  const std::scoped_lock lock(mutex_);
  options_ = options;
  job_.cancel();
  wanted_.notify_one();
  return ++last_request_;
}

void SegyLooker::show_line(bool of_inline, std::optional<std::int64_t> index) {
  {
    const std::scoped_lock lock(mutex_);
    of_inline_ = of_inline;
    index_ = index;
    line_wanted_ = true;
  }
  wanted_.notify_one();
}

void SegyLooker::work() {
  for (;;) {
    std::unique_lock lock(mutex_);
    wanted_.wait(lock, [this] { return ending_ || options_ || line_wanted_; });
    if (ending_) return;
    const std::uint64_t request = last_request_;
    const auto options = std::exchange(options_, std::nullopt);
    line_wanted_ = false;
    const bool of_inline = of_inline_;
    const auto index = index_;
    job_ = JobContext([this](const Progress& progress) {
      QMetaObject::invokeMethod(
          this, [this, fraction = progress.fraction] { Q_EMIT progressed(fraction); }, Qt::QueuedConnection);
    });
    const JobContext job = job_;
    lock.unlock();
    try {
      look_once(options, request, of_inline, index, job);
    } catch (const Error& error) {
      if (error.code() == ErrorCode::kCancelled) continue;  // for a newer request, or the end
      QMetaObject::invokeMethod(
          this,
          [this, request, message = QString::fromStdString(error.message()),
           hint = QString::fromStdString(error.hint())] { Q_EMIT failed(request, message, hint); },
          Qt::QueuedConnection);
    } catch (const std::exception& error) {
      QMetaObject::invokeMethod(
          this,
          [this, request, message = QString::fromUtf8(error.what())] {
            Q_EMIT failed(request, message, QString());
          },
          Qt::QueuedConnection);
    }
  }
}

void SegyLooker::look_once(const std::optional<formats::segy::Options>& options, std::uint64_t request,
                           bool of_inline, std::optional<std::int64_t> index, const JobContext& job) {
  if (options) survey_.reset();  // where this fails, no line is shown of the file as it was
  if (options) survey_ = std::make_shared<const formats::segy::SurveyLook>(file_, *options, job);
  if (!survey_) return;
  const auto& axis = of_inline ? survey_->found().inlines : survey_->found().crosslines;
  const std::int64_t middle = axis ? axis->count / 2 : 0;
  auto look = std::make_shared<const SegyLook>(
      SegyLook{request, survey_, survey_->line(of_inline, index.value_or(middle), job)});
  QMetaObject::invokeMethod(
      this, [this, look = std::move(look)] { Q_EMIT looked(look); }, Qt::QueuedConnection);
}

}  // namespace footwall::ui
