// Interpreter, status and note of a fault, to be written over: each change is one edit, made when the field
// is left or by Enter. Esc puts back what was.
#pragma once
#include <QWidget>
#include <array>

#include "ui/model/document.h"

class QLineEdit;
class QPlainTextEdit;

namespace footwall::ui {

class FaultFields final : public QWidget {
  Q_OBJECT

 public:
  explicit FaultFields(Document& document, QWidget* parent = nullptr);

  // 0: none. What was typed for the one before is stored first.
  void show_fault(Id fault);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  using Texts = std::array<QString, 3>;  // in the order of kProperties
  Texts stored() const;
  Texts typed() const;
  void fill(const Texts& texts);
  void store();

  Document& document_;
  Id fault_ = 0;
  Texts shown_;  // as the fields were filled
  QLineEdit* interpreter_ = nullptr;
  QLineEdit* status_ = nullptr;
  QPlainTextEdit* note_ = nullptr;
};

}  // namespace footwall::ui
