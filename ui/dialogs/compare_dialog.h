// Comparison of two runs of a fault: the choice, the rasters side by side, and their export.
#pragma once
#include <QComboBox>
#include <QDialog>
#include <QLabel>
#include <QPushButton>

#include "ui/dialogs/compare_view.h"
#include "ui/model/workbench.h"

namespace footwall::ui {

class CompareDialog final : public QDialog {
  Q_OBJECT

 public:
  // The active fault, the statistic shown and the last two runs come first.
  explicit CompareDialog(Workbench& workbench, QWidget* parent = nullptr);

  tasks::CompareChoice choice() const;
  // Null before the first comparison.
  const std::shared_ptr<const ComparedImages>& compared() const { return compared_; }
  QString message() const { return message_->text(); }
  CompareView& view() { return *view_; }
  // As jobs of the workbench (the picture at once), to a file that is replaced; the message says what was
  // written.
  void write_csv(const QString& file);
  void write_picture(const QString& file);

 public Q_SLOTS:
  // As a job; the newest wins.
  void compare();

 private:
  void fill_runs();
  void take(std::shared_ptr<const ComparedImages> compared);
  void say(const QString& text, QPalette::ColorRole role);
  void ask_file(const QString& suffix, void (CompareDialog::*write)(const QString&));

  Workbench& workbench_;
  int job_ = 0;  // the newest of this dialog's
  std::shared_ptr<const ComparedImages> compared_;
  QComboBox *fault_, *run_a_, *run_b_, *statistic_;
  CompareView* view_;
  QLabel *message_, *read_out_;
  QPushButton *compare_, *csv_, *picture_;
};

}  // namespace footwall::ui
