// Reads what a volume's file says of itself on a thread of its own: the window never waits for a disk.
#pragma once
#include <QObject>
#include <QString>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <thread>

#include "storage/volume/volume_info.h"

namespace footwall::ui {

class VolumeLooker final : public QObject {
  Q_OBJECT

 public:
  using QObject::QObject;
  // Waits for a file that is being read.
  ~VolumeLooker() override;

  // The newest call alone is answered; the voxels are not read.
  void look(const std::filesystem::path& file);
  // What is asked for has no answer.
  void forget();

 Q_SIGNALS:
  void looked(const footwall::volume::VolumeInfo& info);
  void failed(const QString& message);

 private:
  void begin(const std::filesystem::path& file);
  // info: nothing where `message` says why not.
  void ended(const std::optional<volume::VolumeInfo>& info, const QString& message);

  std::thread thread_;  // while a file is read
  bool is_wanted_ = false;
  std::optional<std::filesystem::path> next_;  // asked for meanwhile
};

}  // namespace footwall::ui
