#include "ui/dialogs/isosurface_dialog.h"

#include <QColorDialog>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

namespace footwall::ui {
namespace {

// Where a new one starts: high enough to be a few bodies, not a fog.
constexpr std::size_t kFirstPercentile = 98;

}  // namespace

IsosurfaceDialog::IsosurfaceDialog(Workbench& workbench, Id isosurface, QWidget* parent)
    : QDialog(parent), workbench_(workbench), isosurface_(isosurface) {
  setMinimumWidth(420);
  if (const IsosurfaceLook* shown = look()) before_ = *shown;
  setWindowTitle(before_ ? tr("Isosurface") : tr("New isosurface"));
  volume_ = new QComboBox(this);
  volume_->setObjectName(QStringLiteral("volume"));
  const Id chosen = before_ ? before_->volume : workbench.display.volume();
  for (const project::VolumeRecord& volume : workbench.document.volumes()) {
    volume_->addItem(QString::fromStdString(volume.name), static_cast<qlonglong>(volume.id));
    if (volume.id == chosen) volume_->setCurrentIndex(volume_->count() - 1);
  }
  histogram_ = new ValueHistogram(this);
  value_ = new QDoubleSpinBox(this);
  value_->setObjectName(QStringLiteral("value"));
  value_->setRange(-1e30, 1e30);
  value_->setDecimals(4);
  value_->setEnabled(false);
  colour_ = new QPushButton(this);
  colour_->setAutoDefault(false);
  colour_->setFixedWidth(56);
  colour_->setToolTip(tr("Colour"));
  colour_->setAccessibleName(tr("Colour"));
  shown_as_ = new QComboBox(this);
  shown_as_->setObjectName(QStringLiteral("shown as"));
  shown_as_->addItem(tr("Picture by the engine"));
  shown_as_->addItem(tr("Mesh of triangles"));
  shown_as_->setToolTip(tr(
      "A picture costs the same however large the surface is, and is drawn anew for each camera; triangles "
      "are made here, turn with the scene and can be picked"));
  message_ = new QLabel(this);
  message_->setWordWrap(true);
  message_->setForegroundRole(QPalette::LinkVisited);
  ok_ = new QPushButton(before_ ? tr("Done") : tr("Add"), this);
  ok_->setObjectName(QStringLiteral("ok"));
  ok_->setDefault(true);
  ok_->setEnabled(before_.has_value());
  auto* cancel = new QPushButton(tr("Cancel"), this);
  cancel->setAutoDefault(false);

  auto* value_row = new QHBoxLayout;
  value_row->setSpacing(4);
  value_row->addWidget(value_, 1);
  value_row->addWidget(colour_);
  auto* form = new QFormLayout;
  form->setVerticalSpacing(4);
  form->setHorizontalSpacing(12);
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  form->addRow(tr("Volume"), volume_);
  form->addRow(tr("Value"), value_row);
  form->addRow(tr("Shown as"), shown_as_);
  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(8);
  buttons->addWidget(message_, 1);
  buttons->addWidget(cancel);
  buttons->addWidget(ok_);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(12, 12, 12, 12);
  column->setSpacing(8);
  column->addWidget(histogram_, 1);
  column->addLayout(form);
  column->addLayout(buttons);
  connect(&looker_, &VolumeLooker::looked, this,
          [this](const volume::VolumeInfo& info) { histogram_read(info.statistics); });
  connect(&looker_, &VolumeLooker::failed, message_, &QLabel::setText);
  connect(volume_, &QComboBox::currentIndexChanged, this, &IsosurfaceDialog::read_histogram);
  connect(histogram_, &ValueHistogram::value_moved, this, &IsosurfaceDialog::set_value);
  connect(value_, &QDoubleSpinBox::valueChanged, this, &IsosurfaceDialog::set_value);
  connect(shown_as_, &QComboBox::activated, this, [this](int choice) { set_as_picture(choice == 0); });
  connect(colour_, &QPushButton::clicked, this, &IsosurfaceDialog::choose_colour);
  connect(ok_, &QPushButton::clicked, this, &QDialog::accept);
  connect(cancel, &QPushButton::clicked, this, &IsosurfaceDialog::reject);
  show_colour();
  read_histogram();
}

const IsosurfaceLook* IsosurfaceDialog::look() const {
  const auto& all = workbench_.display.isosurfaces();
  const auto found = std::ranges::find(all, isosurface_, &IsosurfaceLook::id);
  return found == all.end() ? nullptr : &*found;
}

void IsosurfaceDialog::read_histogram() {
  histogram_->clear();
  const Id id = volume_->currentData().toLongLong();
  const auto& volumes = workbench_.document.volumes();
  const auto volume = std::ranges::find(volumes, id, &project::VolumeRecord::id);
  if (volume == volumes.end()) {
    looker_.forget();
    message_->setText(tr("import a volume first"));
    return;
  }
  message_->clear();
  looker_.look(workbench_.document.project().volume_path(*volume));
}

void IsosurfaceDialog::histogram_read(const volume::Statistics& statistics) {
  histogram_->show_histogram(statistics.histogram);
  const QSignalBlocker block(value_);
  const double range = statistics.max - statistics.min;
  value_->setDecimals(range > 0 ? std::clamp(4 - static_cast<int>(std::floor(std::log10(range))), 0, 12) : 4);
  value_->setSingleStep(range > 0 ? range / 200 : 1);
  value_->setEnabled(true);
  const Id volume = volume_->currentData().toLongLong();
  const double first = statistics.percentiles.size() > kFirstPercentile
                           ? statistics.percentiles[kFirstPercentile]
                           : statistics.max;
  Display& display = workbench_.display;
  if (const IsosurfaceLook* shown = look(); shown == nullptr) {
    isosurface_ = display.add_isosurface(volume, first);
  } else if (shown->volume != volume) {
    IsosurfaceLook moved = *shown;
    moved.volume = volume;
    moved.value = first;
    display.change_isosurface(moved);
  }
  ok_->setEnabled(true);
  if (const IsosurfaceLook* shown = look()) {
    histogram_->set_value(shown->value);
    value_->setValue(shown->value);
  }
  show_colour();
}

void IsosurfaceDialog::set_value(double value) {
  const IsosurfaceLook* shown = look();
  if (shown == nullptr) return;
  const QSignalBlocker block_value(value_);
  if (value_->value() != value) value_->setValue(value);
  histogram_->set_value(value);
  IsosurfaceLook changed = *shown;
  changed.value = value;
  workbench_.display.change_isosurface(changed);
}

void IsosurfaceDialog::choose_colour() {
  const IsosurfaceLook* shown = look();
  if (shown == nullptr) return;
  const QColor chosen = QColorDialog::getColor(QColor(shown->colour), this, tr("Colour of the isosurface"));
  shown = look();
  if (!chosen.isValid() || shown == nullptr) return;
  IsosurfaceLook changed = *shown;
  changed.colour = chosen.name();
  workbench_.display.change_isosurface(changed);
  show_colour();
}

void IsosurfaceDialog::set_as_picture(bool as_picture) {
  const IsosurfaceLook* shown = look();
  if (shown == nullptr) return;
  IsosurfaceLook changed = *shown;
  changed.as_picture = as_picture;
  workbench_.display.change_isosurface(changed);
}

void IsosurfaceDialog::show_colour() {
  const IsosurfaceLook* shown = look();
  shown_as_->setEnabled(shown != nullptr);
  if (shown != nullptr) shown_as_->setCurrentIndex(shown->as_picture ? 0 : 1);
  colour_->setEnabled(shown != nullptr);
  QPixmap swatch(32, 12);
  swatch.fill(shown != nullptr ? QColor(shown->colour) : palette().color(QPalette::Mid));
  colour_->setIconSize(swatch.size());
  colour_->setIcon(QIcon(swatch));
}

void IsosurfaceDialog::reject() {
  if (before_) {
    workbench_.display.change_isosurface(*before_);
  } else if (isosurface_ != 0) {
    workbench_.display.remove_isosurface(isosurface_);
  }
  isosurface_ = before_ ? before_->id : 0;
  looker_.forget();  // a histogram that still comes makes nothing
  QDialog::reject();
}

}  // namespace footwall::ui
