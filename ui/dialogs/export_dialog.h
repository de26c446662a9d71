// Export of faces with statistics, of sticks, of volumes, and of a picture.
#pragma once
#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>

#include "ui/dialogs/export_choice.h"
#include "ui/model/workbench.h"

namespace footwall::ui {

class ExportDialog final : public QDialog {
  Q_OBJECT

 public:
  // write_picture: of the view at hand; none: no PNG is offered.
  ExportDialog(Workbench& workbench, WritePicture write_picture, QWidget* parent = nullptr);

  ExportChoice choice() const;
  void choose(ExportChoice::Kind kind);
  // What the last export did, or why it failed.
  QString message() const { return message_->text(); }

 Q_SIGNALS:
  void exported(const QString& file);

 public Q_SLOTS:
  // As a job of the workbench. The dialog stays open and says what was written; the job outlives it.
  void export_chosen();

 private:
  void kind_changed();
  void say(const QString& text, QPalette::ColorRole role);
  void browse();

  Workbench& workbench_;
  WritePicture write_picture_;
  int job_ = 0;  // the export under way
  QComboBox *kind_, *fault_, *run_, *volume_, *stick_format_;
  QCheckBox* interpolated_;
  QLineEdit* file_;
  QLabel* message_;
  QPushButton *export_, *close_;
};

}  // namespace footwall::ui
