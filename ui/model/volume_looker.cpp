#include "ui/model/volume_looker.h"

#include <memory>
#include <utility>

#include "storage/volume/volume_reader.h"

namespace footwall::ui {

VolumeLooker::~VolumeLooker() {
  if (thread_.joinable()) thread_.join();
}

void VolumeLooker::look(const std::filesystem::path& file) {
  if (!thread_.joinable()) return begin(file);
  is_wanted_ = false;
  next_ = file;
}

void VolumeLooker::forget() {
  is_wanted_ = false;
  next_.reset();
}

void VolumeLooker::begin(const std::filesystem::path& file) {
  is_wanted_ = true;
  thread_ = std::thread([this, file] {
    auto info = std::make_shared<std::optional<volume::VolumeInfo>>();
    QString message;
    try {
      *info = volume::VolumeReader(file).info();
    } catch (const std::exception& error) {
      message = QString::fromUtf8(error.what());
    }
    QMetaObject::invokeMethod(
        this, [this, info, message] { ended(*info, message); }, Qt::QueuedConnection);
  });
}

void VolumeLooker::ended(const std::optional<volume::VolumeInfo>& info, const QString& message) {
  thread_.join();
  if (const auto next = std::exchange(next_, std::nullopt)) return begin(*next);
  if (!is_wanted_) return;
  if (info) {
    Q_EMIT looked(*info);
  } else {
    Q_EMIT failed(message);
  }
}

}  // namespace footwall::ui
