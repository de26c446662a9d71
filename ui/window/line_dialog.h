// The two ends of a line section as numbers of lines; the section follows while they change.
#pragma once
#include <QDialog>
#include <array>

#include "ui/model/workbench.h"

class QDialogButtonBox;
class QLabel;
class QSpinBox;

namespace footwall::ui {

class LineDialog final : public QDialog {
  Q_OBJECT

 public:
  // section: of Display, a line; the project has a survey.
  LineDialog(Workbench& workbench, Id section, QWidget* parent = nullptr);

  void reject() override;

 private:
  struct End {
    QSpinBox* inline_number = nullptr;
    QSpinBox* crossline_number = nullptr;
  };
  End make_end(const QString& name, const survey::IndexPoint& place);
  QSpinBox* make_number(const survey::LineAxis& axis, double index, const QString& name);
  survey::IndexPoint place_of(const End& end) const;
  void follow();

  Workbench& workbench_;
  Id section_;
  survey::Geometry survey_;
  Section before_;
  std::array<End, 2> ends_;
  QLabel* message_ = nullptr;
  QDialogButtonBox* buttons_ = nullptr;
};

// Above `parent`, where `section` is a line that is still shown.
void open_line_dialog(Workbench& workbench, Id section, QWidget* parent);

}  // namespace footwall::ui
