#include "ui/dialogs/segy_field_form.h"

#include <QFormLayout>
#include <QHBoxLayout>
#include <QSignalBlocker>

#include "storage/formats/segy/samples.h"

namespace footwall::ui {
namespace {

namespace segy = formats::segy;

QComboBox* choice(QWidget* parent, const char* name, const QString& none) {
  auto* box = new QComboBox(parent);
  box->setObjectName(QLatin1String(name));
  box->addItem(none);
  return box;
}

QLayout* side_by_side(QWidget* first, QWidget* second) {
  auto* row = new QHBoxLayout;
  row->setSpacing(4);
  row->addWidget(first, 1);
  row->addWidget(second, 1);
  return row;
}

QString byte_text(const segy::HeaderWord& word) {
  return QString::fromStdString(segy::text_of(word));
}

template <class Value>
std::optional<Value> chosen(const QComboBox* box) {
  if (!box->currentData().isValid()) return std::nullopt;
  return static_cast<Value>(box->currentData().toInt());
}

}  // namespace

SegyFieldForm::SegyFieldForm(const QString& name, QWidget* parent) : QWidget(parent) {
  name_ = line({}, "name");
  name_->setText(name);
  domain_ = choice(this, "domain", tr("choose …"));
  domain_->addItem(tr("time"), static_cast<int>(survey::Domain::kTime));
  domain_->addItem(tr("depth"), static_cast<int>(survey::Domain::kDepth));
  unit_ = choice(this, "unit", tr("choose …"));
  for (const auto unit :
       {survey::VerticalUnit::kMillisecond, survey::VerticalUnit::kMetre, survey::VerticalUnit::kFoot}) {
    unit_->addItem(QString::fromUtf8(survey::name_of(unit).data()), static_cast<int>(unit));
  }
  crs_ = line(tr("not stated, e.g. EPSG:23031"), "crs");
  inline_byte_ = line({}, "inline_byte");
  crossline_byte_ = line({}, "crossline_byte");
  x_byte_ = line({}, "x_byte");
  y_byte_ = line({}, "y_byte");
  for (QLineEdit* field : {inline_byte_, crossline_byte_, x_byte_, y_byte_}) {
    field->setToolTip(tr("A byte of the trace header from 1, as 189, 81:ieee, 193:int16, or none"));
  }
  scalar_ = line({}, "scalar");
  scalar_->setToolTip(tr("As at byte 71: 10 multiplies X and Y by 10, -100 divides them by 100"));
  interval_ = line({}, "interval");
  format_ = choice(this, "format", tr("as the file says"));
  for (int code = 1; code <= 16; ++code) {
    const segy::SampleFormat* known = segy::sample_format(code);
    if (known == nullptr) continue;
    format_->addItem(QStringLiteral("%1  %2").arg(code).arg(
                         QString::fromUtf8(known->name.data(), static_cast<qsizetype>(known->name.size()))),
                     code);
  }
  endian_ = choice(this, "endian", tr("as found"));
  endian_->addItem(tr("big-endian"), static_cast<int>(segy::Endian::kBig));
  endian_->addItem(tr("little-endian"), static_cast<int>(segy::Endian::kLittle));
  for (QComboBox* box : {format_, endian_, domain_, unit_}) {
    box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    box->setMinimumContentsLength(8);
    connect(box, &QComboBox::currentIndexChanged, this, [this] { Q_EMIT changed(true); });
  }

  auto* form = new QFormLayout(this);
  form->setContentsMargins(0, 0, 0, 0);
  form->setVerticalSpacing(4);
  form->setHorizontalSpacing(12);
  form->addRow(tr("Volume"), name_);
  form->addRow(tr("Domain, unit"), side_by_side(domain_, unit_));
  form->addRow(tr("CRS"), crs_);
  form->addRow(tr("Inline, crossline"), side_by_side(inline_byte_, crossline_byte_));
  form->addRow(tr("X, Y"), side_by_side(x_byte_, y_byte_));
  form->addRow(tr("Interval, scalar"), side_by_side(interval_, scalar_));
  form->addRow(tr("Format"), side_by_side(format_, endian_));
  QWidget* before = name_;
  for (QWidget* next :
       std::initializer_list<QWidget*>{domain_, unit_, crs_, inline_byte_, crossline_byte_, x_byte_, y_byte_,
                                       interval_, scalar_, format_, endian_}) {
    setTabOrder(before, next);
    before = next;
  }
}

QLineEdit* SegyFieldForm::line(const QString& placeholder, const char* name) {
  auto* field = new QLineEdit(this);
  field->setObjectName(QLatin1String(name));
  field->setPlaceholderText(placeholder);
  const bool changes_look = qstrcmp(name, "name") != 0 && qstrcmp(name, "crs") != 0;
  connect(field, &QLineEdit::textChanged, this, [this, changes_look] { Q_EMIT changed(changes_look); });
  return field;
}

SegyFields SegyFieldForm::fields() const {
  return {.inline_byte = inline_byte_->text(),
          .crossline_byte = crossline_byte_->text(),
          .x_byte = x_byte_->text(),
          .y_byte = y_byte_->text(),
          .scalar = scalar_->text(),
          .format = chosen<int>(format_),
          .endian = chosen<segy::Endian>(endian_),
          .interval = interval_->text(),
          .domain = chosen<survey::Domain>(domain_),
          .unit = chosen<survey::VerticalUnit>(unit_),
          .crs = crs_->text(),
          .name = name_->text()};
}

void SegyFieldForm::take(const segy::LineCandidate& candidate) {
  {
    const QSignalBlocker block(this);
    inline_byte_->setText(byte_text(candidate.inline_word));
    crossline_byte_->setText(byte_text(candidate.crossline_word));
    x_byte_->setText(byte_text(candidate.x));
    y_byte_->setText(byte_text(candidate.y));
  }
  Q_EMIT changed(true);
}

void SegyFieldForm::show_found(const segy::Report& report, const std::optional<survey::Geometry>& geometry) {
  inline_byte_->setPlaceholderText(byte_text(report.inline_word));
  crossline_byte_->setPlaceholderText(byte_text(report.crossline_word));
  x_byte_->setPlaceholderText(byte_text(report.x_word));
  y_byte_->setPlaceholderText(byte_text(report.y_word));
  scalar_->setPlaceholderText(report.coordinate_scalar != 0 ? tr("scalar %1").arg(report.coordinate_scalar)
                                                            : tr("scalar of X, Y"));
  const SegyFields said = fields();
  const QString unit = said.unit ? QString::fromUtf8(survey::name_of(*said.unit).data()) : QString();
  const double interval = geometry ? geometry->interval : report.interval_us / 1000;
  interval_->setPlaceholderText(interval > 0
                                    ? QStringLiteral("%1 %2").arg(interval, 0, 'g', 8).arg(unit).trimmed()
                                    : tr("not said by the file"));
  format_->setItemText(
      0, report.format_name.empty() ? tr("as the file says") : QString::fromStdString(report.format_name));
  endian_->setItemText(0, tr("%1-endian").arg(QString::fromUtf8(segy::name_of(report.endian).data())));
}

}  // namespace footwall::ui
