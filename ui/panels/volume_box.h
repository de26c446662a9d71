// How a volume's values are spread, with handles for the clip of the sections, and whether its file is the
// one that the project knows.
#pragma once
#include <QWidget>
#include <optional>

#include "ui/model/volume_looker.h"
#include "ui/model/workbench.h"

class QLabel;

namespace footwall::ui {

class Histogram;

class VolumeBox final : public QWidget {
  Q_OBJECT

 public:
  explicit VolumeBox(Workbench& workbench, QWidget* parent = nullptr);

  // 0: none. Its file is read when it becomes another one.
  void show_volume(Id volume);
  Histogram& histogram() { return *histogram_; }
  QString state() const;  // of the file, in words

 private:
  void show_info(const volume::VolumeInfo& info);
  void show_range();
  void clip(double low, double high);

  Workbench& workbench_;
  project::VolumeRecord shown_;
  std::optional<SectionReader::VolumeFacts> facts_;  // once its file has been read
  std::pair<double, double> range_;                  // of the colours, as shown last
  QLabel* state_ = nullptr;
  Histogram* histogram_ = nullptr;
  VolumeLooker looker_;
};

}  // namespace footwall::ui
