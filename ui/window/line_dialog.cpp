#include "ui/window/line_dialog.h"

#include <QDialogButtonBox>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

namespace footwall::ui {
namespace {

// Null where the display has no such line.
const Display::ShownSection* line_of(const Workbench& workbench, Id section) {
  const auto& all = workbench.display.sections();
  const auto found = std::ranges::find(all, section, &Display::ShownSection::id);
  return found == all.end() || found->section.kind != Section::Kind::kLine ? nullptr : &*found;
}

}  // namespace

LineDialog::LineDialog(Workbench& workbench, Id section, QWidget* parent)
    : QDialog(parent),
      workbench_(workbench),
      section_(section),
      survey_(*workbench.document.survey()),
      before_(line_of(workbench, section)->section) {
  setWindowTitle(tr("Line"));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(12, 12, 12, 12);
  column->setSpacing(8);
  auto* grid = new QGridLayout;
  grid->setHorizontalSpacing(12);
  grid->addWidget(new QLabel(tr("Inline"), this), 0, 1);
  grid->addWidget(new QLabel(tr("Crossline"), this), 0, 2);
  ends_ = {make_end(QStringLiteral("from"), before_.from), make_end(QStringLiteral("to"), before_.to)};
  const std::array names{tr("From"), tr("To")};
  for (int row = 0; row < 2; ++row) {
    const End& end = ends_[static_cast<std::size_t>(row)];
    grid->addWidget(new QLabel(names[static_cast<std::size_t>(row)], this), row + 1, 0);
    grid->addWidget(end.inline_number, row + 1, 1);
    grid->addWidget(end.crossline_number, row + 1, 2);
  }
  column->addLayout(grid);
  message_ = new QLabel(this);
  message_->setForegroundRole(QPalette::PlaceholderText);
  column->addWidget(message_);
  buttons_ = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
  connect(buttons_, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons_, &QDialogButtonBox::rejected, this, &QDialog::reject);
  column->addWidget(buttons_);
}

LineDialog::End LineDialog::make_end(const QString& name, const survey::IndexPoint& place) {
  return {make_number(survey_.inlines, place.i, name + QStringLiteral("-inline")),
          make_number(survey_.crosslines, place.j, name + QStringLiteral("-crossline"))};
}

QSpinBox* LineDialog::make_number(const survey::LineAxis& axis, double index, const QString& name) {
  auto* number = new QSpinBox(this);
  number->setObjectName(name);
  number->setKeyboardTracking(false);  // half a number is another line
  number->setRange(static_cast<int>(std::min<std::int64_t>(axis.first, axis.last())),
                   static_cast<int>(std::max<std::int64_t>(axis.first, axis.last())));
  number->setSingleStep(std::abs(axis.step));
  number->setValue(static_cast<int>(axis.line_of(std::llround(index))));
  connect(number, &QSpinBox::valueChanged, this, &LineDialog::follow);
  return number;
}

// A number between lines is taken for the nearest line.
survey::IndexPoint LineDialog::place_of(const End& end) const {
  const auto index = [](const survey::LineAxis& axis, int line) {
    return std::round(static_cast<double>(line - axis.first) / axis.step);
  };
  return {index(survey_.inlines, end.inline_number->value()),
          index(survey_.crosslines, end.crossline_number->value()), 0};
}

void LineDialog::follow() {
  Section line = before_;
  line.from = place_of(ends_[0]);
  line.to = place_of(ends_[1]);
  const bool is_line = !(line.from == line.to);
  message_->setText(is_line ? QString() : tr("Both ends are the same place: that is no line."));
  buttons_->button(QDialogButtonBox::Ok)->setEnabled(is_line);
  if (is_line) workbench_.display.move_section(section_, line);
}

void LineDialog::reject() {
  workbench_.display.move_section(section_, before_);
  QDialog::reject();
}

void open_line_dialog(Workbench& workbench, Id section, QWidget* parent) {
  if (!workbench.document.survey() || line_of(workbench, section) == nullptr) return;
  auto* dialog = new LineDialog(workbench, section, parent);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowModality(Qt::WindowModal);
  dialog->show();
}

}  // namespace footwall::ui
