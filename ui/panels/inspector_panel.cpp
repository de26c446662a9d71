#include "ui/panels/inspector_panel.h"

#include <QAction>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QSlider>
#include <QTimer>
#include <QVBoxLayout>
#include <cmath>
#include <utility>

#include "ui/panels/fault_fields.h"
#include "ui/panels/histogram.h"
#include "ui/panels/selection_summary.h"
#include "ui/panels/volume_box.h"

namespace footwall::ui {
namespace {

constexpr int kRefreshAfterMs =
    80;  // a drag changes what is shown at every frame: the numbers follow less often
constexpr double kFinest = 0.1, kCoarsest = 8;  // voxels
constexpr int kDetailSteps = 100;
constexpr int kShortKey = 3;  // letters; longer ones stand in the tip alone

double detail_at(int step) {
  return kFinest * std::pow(kCoarsest / kFinest, static_cast<double>(step) / kDetailSteps);
}

int step_of(double detail) {
  return static_cast<int>(
      std::lround(std::log(detail / kFinest) / std::log(kCoarsest / kFinest) * kDetailSteps));
}

QLabel* heading(const QString& text, QWidget* parent) {
  auto* label = new QLabel(text, parent);
  QFont font = label->font();
  font.setPixelSize(11);
  font.setBold(true);
  font.setLetterSpacing(QFont::PercentageSpacing, 108);
  label->setFont(font);
  label->setForegroundRole(QPalette::PlaceholderText);
  label->setWordWrap(true);
  return label;
}

QPushButton* button_for(QAction* action, QWidget* parent) {
  auto* button = new QPushButton(parent);
  const auto follow = [action, button] {
    const QString key = action->shortcut().toString(QKeySequence::NativeText);
    const QString name = action->text().remove(QLatin1Char('&'));
    button->setText(key.isEmpty() || key.size() > kShortKey ? name
                                                            : QStringLiteral("%1   %2").arg(name, key));
    button->setEnabled(action->isEnabled());
    button->setToolTip(action->toolTip());
  };
  QObject::connect(action, &QAction::changed, button, follow);
  QObject::connect(button, &QPushButton::clicked, action, &QAction::trigger);
  follow();
  return button;
}

}  // namespace

InspectorPanel::InspectorPanel(Workbench& workbench, FindAction action, QWidget* parent)
    : QScrollArea(parent), workbench_(workbench) {
  setFrameShape(QFrame::NoFrame);
  setWidgetResizable(true);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  body_ = new QWidget(this);
  body_->setAutoFillBackground(true);
  body_->setBackgroundRole(QPalette::Base);
  auto* column = new QVBoxLayout(body_);
  column->setContentsMargins(12, 4, 12, 12);
  column->setSpacing(8);
  title_ = heading({}, body_);
  column->addWidget(title_);
  rows_ = new QWidget(body_);
  column->addWidget(rows_);
  fields_ = new FaultFields(workbench_.document, body_);
  column->addWidget(fields_);
  volume_ = new VolumeBox(workbench_, body_);
  column->addWidget(volume_);

  of_fault_ = new QWidget(body_);
  auto* fault = new QVBoxLayout(of_fault_);
  fault->setContentsMargins(0, 4, 0, 0);
  fault->setSpacing(8);
  statistic_ = heading({}, of_fault_);
  fault->addWidget(statistic_);
  histogram_ = new Histogram(of_fault_);
  fault->addWidget(histogram_);
  detail_text_ = heading({}, of_fault_);
  fault->addWidget(detail_text_);
  detail_ = new QSlider(Qt::Horizontal, of_fault_);
  detail_->setRange(0, kDetailSteps);
  detail_->setTracking(false);
  detail_->setToolTip(tr("How closely the triangles follow the surface between pillars"));
  fault->addWidget(detail_);
  for (const char* id : {"fault.interpolate", "fault.smooth", "fault.worst", "fault.accept-shift"}) {
    if (QAction* one = action(QString::fromLatin1(id))) fault->addWidget(button_for(one, of_fault_));
  }
  column->addWidget(of_fault_);
  column->addStretch(1);
  setWidget(body_);

  timer_ = new QTimer(this);
  timer_->setSingleShot(true);
  timer_->setInterval(kRefreshAfterMs);
  connect(timer_, &QTimer::timeout, this, &InspectorPanel::refresh);
  connect(&workbench_.selection, &Selection::changed, this, &InspectorPanel::refresh);
  connect(&workbench_.display, &Display::faces_changed, this, &InspectorPanel::refresh_statistic);
  connect(&workbench_.display, &Display::isosurfaces_changed, this, &InspectorPanel::soon);
  connect(&workbench_.document, &Document::faults_changed, this, &InspectorPanel::soon);
  connect(&workbench_.document, &Document::shapes_changed, this, &InspectorPanel::soon);
  connect(&workbench_.document, &Document::volumes_changed, this, &InspectorPanel::soon);
  connect(&workbench_.document, &Document::survey_changed, this, &InspectorPanel::soon);
  connect(&workbench_.surfaces, &Surfaces::surfaces_changed, this, &InspectorPanel::soon);
  connect(&workbench_.surfaces, &Surfaces::numbers_changed, this, &InspectorPanel::soon);
  connect(&workbench_.surfaces, &Surfaces::offsets_changed, this, &InspectorPanel::soon);
  connect(&workbench_.shown_numbers, &ShownNumbers::run_changed, this, &InspectorPanel::soon);
  connect(&workbench_.shown_numbers, &ShownNumbers::numbers_changed, this, &InspectorPanel::soon);
  connect(histogram_, &Histogram::range_changed, this, [this](double low, double high) {
    FaceLook look = workbench_.display.faces();
    look.low = low;
    look.high = high;
    workbench_.display.set_faces(look);
  });
  connect(histogram_, &Histogram::range_reset, this, [this] {
    FaceLook look = workbench_.display.faces();
    look.low.reset();
    look.high.reset();
    workbench_.display.set_faces(look);
  });
  connect(detail_, &QSlider::valueChanged, this, &InspectorPanel::set_detail);
  connect(detail_, &QSlider::sliderMoved, this, [this](int step) {
    detail_text_->setText(tr("DETAIL %1 voxels").arg(detail_at(step), 0, 'f', 2));
  });
  refresh();
}

void InspectorPanel::soon() {
  if (!timer_->isActive()) timer_->start();
}

Id InspectorPanel::shown_fault() const {
  const Item owner = workbench_.selection.owner();
  return owner.kind == Item::Kind::kFault ? owner.id : 0;
}

void InspectorPanel::refresh() {
  Properties now = selected_properties(workbench_);
  if (now.title.isEmpty())
    now = {tr("Nothing selected"), {{tr("Click a fault, in the list or in a view."), QString()}}};
  if (now.title != shown_.title || now.rows != shown_.rows) {
    shown_ = std::move(now);
    show_rows();
  }
  const Item& current = workbench_.selection.current();
  const bool is_fault = current.kind == Item::Kind::kFault && shown_fault() == current.id;
  fields_->show_fault(is_fault ? current.id : 0);
  fields_->setVisible(is_fault);
  volume_->show_volume(current.kind == Item::Kind::kVolume ? current.id : 0);
  volume_->setVisible(current.kind == Item::Kind::kVolume);
  of_fault_->setVisible(shown_fault() != 0);
  refresh_statistic();
  refresh_detail();
}

void InspectorPanel::show_rows() {
  title_->setText(shown_.title.toUpper());
  delete rows_->layout();
  qDeleteAll(rows_->findChildren<QWidget*>(Qt::FindDirectChildrenOnly));
  auto* grid = new QGridLayout(rows_);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setVerticalSpacing(6);
  grid->setHorizontalSpacing(12);
  grid->setColumnStretch(1, 1);
  int line = 0;
  for (const auto& [name, value] : shown_.rows) {
    auto* left = new QLabel(name, rows_);
    left->setForegroundRole(QPalette::PlaceholderText);
    if (value.isEmpty()) {
      left->setWordWrap(true);
      grid->addWidget(left, line++, 0, 1, 2);
      continue;
    }
    auto* right = new QLabel(value, rows_);
    right->setTextFormat(Qt::PlainText);
    right->setWordWrap(true);
    right->setTextInteractionFlags(Qt::TextSelectableByMouse);
    grid->addWidget(left, line, 0, Qt::AlignTop);
    grid->addWidget(right, line++, 1, Qt::AlignTop);
  }
}

void InspectorPanel::refresh_statistic() {
  const Id fault = shown_fault();
  if (fault == 0) return;
  const FaceLook& look = workbench_.display.faces();
  const ShownNumbers& shown = workbench_.shown_numbers;
  QString heading = look.statistic.toUpper().replace(QLatin1Char('_'), QLatin1Char(' '));
  if (shown.is_of_run(look.statistic)) heading += QStringLiteral(" · ") + words_for(*shown.run());
  statistic_->setText(heading);
  std::set<Id> faults;
  for (const Fault& one : workbench_.document.faults()) {
    if (workbench_.display.is_visible({.kind = Item::Kind::kFault, .id = one.record.id}))
      faults.insert(one.record.id);
  }
  auto range = shown.range(faults, look.statistic);
  if (look.low && look.high) range = {*look.low, *look.high};
  const auto numbers = shown.numbers(fault, look.statistic);
  histogram_->show_values(numbers ? numbers->values : std::vector<double>(), range);
}

void InspectorPanel::refresh_detail() {
  const Id fault = shown_fault();
  if (fault == 0 || detail_->isSliderDown()) return;
  const pillars::Options options = workbench_.surfaces.options(fault);
  const QSignalBlocker quiet(detail_);
  detail_->setValue(step_of(options.detail));
  detail_->setEnabled(!workbench_.document.read_only());
  detail_text_->setText(
      tr("DETAIL %1 voxels, edges ≤ %2").arg(options.detail, 0, 'g', 2).arg(options.max_edge));
}

void InspectorPanel::set_detail() {
  const Id fault = shown_fault();
  if (fault == 0) return;
  pillars::Options options = workbench_.surfaces.options(fault);
  options.detail = detail_at(detail_->value());
  workbench_.surfaces.set_options(fault, options);
  refresh_detail();
}

}  // namespace footwall::ui
