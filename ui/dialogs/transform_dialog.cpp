#include "ui/dialogs/transform_dialog.h"

#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "ui/model/provisional_move.h"

namespace footwall::ui {
namespace {

constexpr double kFarthest = 1e6;
constexpr double kLeastScale = 0.01, kMostScale = 100;

}  // namespace

TransformDialog::TransformDialog(Workbench& workbench, QWidget* parent)
    : QDialog(parent),
      workbench_(workbench),
      faults_(workbench.selection.faults()),
      pillars_(workbench.selection.pillars()),
      nodes_(workbench.selection.nodes()) {
  setWindowTitle(tr("Transform"));
  setMinimumWidth(320);
  const survey::Geometry& survey = *workbench.document.survey();
  const QString unit = QString::fromStdString(survey.horizontal_unit);
  const QString z_unit = QString::fromUtf8(survey::name_of(survey.vertical_unit).data());
  x_ = field("x", -kFarthest, kFarthest, 2, 10, unit);
  y_ = field("y", -kFarthest, kFarthest, 2, 10, unit);
  z_ = field("z", -kFarthest, kFarthest, 2, survey.interval, z_unit);
  rotate_ = field("rotate", -360, 360, 2, 1, QStringLiteral("°"));
  scale_ = field("scale", kLeastScale, kMostScale, 4, 0.05, QStringLiteral("×"));
  scale_z_ = field("scale_z", kLeastScale, kMostScale, 4, 0.05, QStringLiteral("×"));
  scale_->setValue(1);
  scale_z_->setValue(1);
  rotate_->setToolTip(
      tr("Clockwise seen from above, about the vertical through the middle of what is selected"));
  scale_->setToolTip(tr("X and Y, about the middle of what is selected"));
  scale_z_->setToolTip(tr("Heights, about the middle of what is selected"));

  const std::size_t count = transformed(workbench.document, faults_, pillars_, nodes_, {}).size();
  auto* what = new QLabel(tr("%1 nodes; turned and scaled about their middle").arg(count), this);
  what->setForegroundRole(QPalette::PlaceholderText);
  auto* form = new QFormLayout;
  form->setVerticalSpacing(4);
  form->setHorizontalSpacing(12);
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  form->addRow(tr("Move X"), x_);
  form->addRow(tr("Move Y"), y_);
  form->addRow(tr("Move down"), z_);
  form->addRow(tr("Turn"), rotate_);
  form->addRow(tr("Scale sideways"), scale_);
  form->addRow(tr("Scale heights"), scale_z_);
  auto* ok = new QPushButton(tr("OK"), this);
  ok->setObjectName(QStringLiteral("ok"));
  ok->setDefault(true);
  ok->setEnabled(count > 0);
  auto* cancel = new QPushButton(tr("Cancel"), this);
  cancel->setAutoDefault(false);
  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(8);
  buttons->addStretch(1);
  buttons->addWidget(cancel);
  buttons->addWidget(ok);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(12, 12, 12, 12);
  column->setSpacing(8);
  column->addWidget(what);
  column->addLayout(form);
  column->addStretch(1);
  column->addLayout(buttons);
  connect(ok, &QPushButton::clicked, this, &TransformDialog::accept);
  connect(cancel, &QPushButton::clicked, this, &TransformDialog::reject);
  for (QDoubleSpinBox* one : {x_, y_, z_, rotate_, scale_, scale_z_})
    connect(one, &QDoubleSpinBox::valueChanged, this, &TransformDialog::preview);
}

QDoubleSpinBox* TransformDialog::field(const char* name, double low, double high, int decimals, double step,
                                       const QString& unit) {
  auto* box = new QDoubleSpinBox(this);
  box->setObjectName(QLatin1String(name));
  box->setRange(low, high);
  box->setDecimals(decimals);
  box->setSingleStep(step);
  box->setSuffix(QLatin1Char(' ') + unit);
  return box;
}

Transform TransformDialog::transform() const {
  return {.move = {x_->value(), y_->value(), z_->value()},
          .rotate_degrees = rotate_->value(),
          .scale = {scale_->value(), scale_->value(), scale_z_->value()}};
}

bool TransformDialog::changes_nothing() const {
  const Transform now = transform();
  return now.move == survey::WorldPoint{} && now.rotate_degrees == 0 &&
         now.scale == std::array<double, 3>{1, 1, 1};
}

void TransformDialog::preview() {
  Document& document = workbench_.document;
  if (changes_nothing()) return document.end_provisional();
  const std::map<Id, survey::WorldPoint> moved =
      transformed(document, faults_, pillars_, nodes_, transform());
  std::set<Id> touched;
  for (const auto& [node, to] : moved) touched.insert(document.fault_of_node(node)->record.id);
  for (const Id fault : touched)
    document.show_provisionally(fault, moved_provisionally(document.fault(fault)->pillars, moved));
}

void TransformDialog::accept() {
  if (changes_nothing()) {
    workbench_.document.end_provisional();
  } else {
    transform_items(workbench_.document, faults_, pillars_, nodes_, transform());
  }
  QDialog::accept();
}

void TransformDialog::reject() {
  workbench_.document.end_provisional();
  QDialog::reject();
}

}  // namespace footwall::ui
