#include "ui/panels/volume_box.h"

#include <QLabel>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "storage/base/hash.h"
#include "ui/model/sample_colours.h"
#include "ui/model/section_source.h"
#include "ui/model/volume_spread.h"
#include "ui/panels/histogram.h"

namespace footwall::ui {
namespace {

constexpr int kBars = 32;

}  // namespace

VolumeBox::VolumeBox(Workbench& workbench, QWidget* parent) : QWidget(parent), workbench_(workbench) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 4, 0, 0);
  column->setSpacing(8);
  histogram_ = new Histogram(this);
  histogram_->setAccessibleName(tr("Histogram of the volume and the clip of the sections"));
  column->addWidget(histogram_);
  state_ = new QLabel(this);
  state_->setObjectName(QStringLiteral("state"));
  state_->setTextFormat(Qt::PlainText);
  state_->setWordWrap(true);
  column->addWidget(state_);
  connect(&looker_, &VolumeLooker::looked, this, &VolumeBox::show_info);
  connect(&looker_, &VolumeLooker::failed, state_, &QLabel::setText);
  connect(histogram_, &Histogram::range_changed, this, &VolumeBox::clip);
  connect(histogram_, &Histogram::range_reset, this, [this] {
    SampleLook look = workbench_.display.samples();
    const SampleLook usual;
    look.clip_percentile = usual.clip_percentile;
    look.gain = usual.gain;
    workbench_.display.set_samples(look);
  });
  connect(&workbench_.display, &Display::samples_changed, this, &VolumeBox::show_range);
}

QString VolumeBox::state() const {
  return state_->text();
}

void VolumeBox::show_volume(Id volume) {
  const auto& volumes = workbench_.document.volumes();
  const auto found = std::ranges::find(volumes, volume, &project::VolumeRecord::id);
  const project::VolumeRecord now = found == volumes.end() ? project::VolumeRecord() : *found;
  if (now.id == shown_.id && now.file == shown_.file && now.checksum == shown_.checksum) return;
  shown_ = now;
  facts_.reset();
  histogram_->show_values({}, {});
  looker_.forget();
  if (now.id == 0) return;
  state_->setText(tr("reading the file …"));
  looker_.look(workbench_.document.project().volume_path(now));
}

void VolumeBox::show_info(const volume::VolumeInfo& info) {
  const bool is_same = shown_.checksum.empty() || to_hex(info.checksum) == shown_.checksum;
  state_->setText(is_same ? tr("The file is there, with the checksum that the project knows.")
                          : tr("The file has another checksum than the project knows: bring the right one "
                               "back, or relink the volume."));
  if (!is_same || info.statistics.count == 0) return;
  facts_ = facts_of(info.statistics);
  const volume::Histogram& spread = info.statistics.histogram;
  histogram_->show_bars(bar_heights(spread, kBars), spread.lo, spread.hi, {spread.lo, spread.hi});
  show_range();
}

void VolumeBox::show_range() {
  if (!facts_) return;
  const SampleColours colours(workbench_.display.samples(), &*facts_);
  range_ = {colours.low(), colours.high()};
  histogram_->set_range(range_.first, range_.second);
}

// The other handle follows: one clip serves both ends.
void VolumeBox::clip(double low, double high) {
  if (!facts_) return;
  const bool is_low = std::abs(low - range_.first) > std::abs(high - range_.second);
  workbench_.display.set_samples(
      clipped_at(workbench_.display.samples(), *facts_, is_low ? low : high, is_low));
  show_range();
}

}  // namespace footwall::ui
