#include "ui/panels/fault_fields.h"

#include <QCompleter>
#include <QFormLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <utility>

namespace footwall::ui {
namespace {

constexpr std::array kProperties{"interpreter", "status", "note"};
constexpr int kNoteHeight = 64;

QString step_name(std::size_t property, const QString& fault) {
  switch (property) {
    case 0:
      return QObject::tr("Interpreter of %1").arg(fault);
    case 1:
      return QObject::tr("Status of %1").arg(fault);
    default:
      return QObject::tr("Note of %1").arg(fault);
  }
}

}  // namespace

FaultFields::FaultFields(Document& document, QWidget* parent) : QWidget(parent), document_(document) {
  auto* form = new QFormLayout(this);
  form->setContentsMargins(0, 0, 0, 0);
  form->setVerticalSpacing(4);
  form->setHorizontalSpacing(12);
  interpreter_ = new QLineEdit(this);
  status_ = new QLineEdit(this);
  auto* usual = new QCompleter({tr("draft"), tr("checked"), tr("final")}, status_);
  usual->setCaseSensitivity(Qt::CaseInsensitive);
  status_->setCompleter(usual);
  note_ = new QPlainTextEdit(this);
  note_->setFixedHeight(kNoteHeight);
  note_->setTabChangesFocus(true);
  const auto add = [&](const QString& name, const char* property, QWidget* field) {
    auto* label = new QLabel(name, this);
    label->setForegroundRole(QPalette::PlaceholderText);
    label->setBuddy(field);
    field->setObjectName(QLatin1String(property));
    field->setAccessibleName(name);
    field->installEventFilter(this);
    form->addRow(label, field);
  };
  add(tr("interpreter"), kProperties[0], interpreter_);
  add(tr("status"), kProperties[1], status_);
  add(tr("note"), kProperties[2], note_);
  connect(interpreter_, &QLineEdit::returnPressed, this, &FaultFields::store);
  connect(status_, &QLineEdit::returnPressed, this, &FaultFields::store);
}

FaultFields::Texts FaultFields::stored() const {
  const Fault* fault = document_.fault(fault_);
  if (fault == nullptr) return {};
  const project::FaultRecord& record = fault->record;
  return {QString::fromStdString(record.interpreter), QString::fromStdString(record.status),
          QString::fromStdString(record.note)};
}

FaultFields::Texts FaultFields::typed() const {
  return {interpreter_->text(), status_->text(), note_->toPlainText()};
}

void FaultFields::fill(const Texts& texts) {
  shown_ = texts;
  if (interpreter_->text() != texts[0]) interpreter_->setText(texts[0]);
  if (status_->text() != texts[1]) status_->setText(texts[1]);
  if (note_->toPlainText() != texts[2]) note_->setPlainText(texts[2]);
  shown_ = typed();  // a field may show less than is stored, e.g. one line of several
}

void FaultFields::show_fault(Id fault) {
  if (fault != fault_) store();
  const bool is_typing = fault == fault_ && typed() != shown_;
  fault_ = fault;
  if (!is_typing) fill(stored());
  const Fault* now = document_.fault(fault_);
  const bool fixed = document_.read_only() || now == nullptr || now->record.locked;
  interpreter_->setReadOnly(fixed);
  status_->setReadOnly(fixed);
  note_->setReadOnly(fixed);
}

void FaultFields::store() {
  const Texts now = typed();
  const Texts before = std::exchange(shown_, now);
  const Fault* fault = document_.fault(fault_);
  if (fault == nullptr || now == before) return;
  const QString name = QString::fromStdString(fault->record.name);
  for (std::size_t n = 0; n < kProperties.size(); ++n) {
    if (now[n] == before[n]) continue;
    document_.edit(step_name(n, name), [&](project::Interpretation& change) {
      change.set_fault_property(fault_, kProperties[n], now[n].trimmed().toStdString());
    });
  }
  fill(stored());
}

bool FaultFields::eventFilter(QObject* watched, QEvent* event) {
  const bool is_key = event->type() == QEvent::KeyPress || event->type() == QEvent::ShortcutOverride;
  if (is_key && static_cast<QKeyEvent*>(event)->matches(QKeySequence::Cancel) && typed() != shown_) {
    if (event->type() == QEvent::KeyPress) fill(stored());
    event->accept();  // before the window's shortcut gets it
    return true;
  }
  // Not while a menu of the field is open.
  if (event->type() == QEvent::FocusOut && static_cast<QFocusEvent*>(event)->reason() != Qt::PopupFocusReason)
    store();
  return QWidget::eventFilter(watched, event);
}

}  // namespace footwall::ui
