// A run of EXTRACT-ALL with its choices: which volume, which faults, a name; strategy and ranks under
// "advanced".
#pragma once
#include <QComboBox>
#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QSpinBox>
#include <QToolButton>
#include <vector>

#include "ui/dialogs/run_job.h"

namespace footwall::ui {

class RunDialog final : public QDialog {
  Q_OBJECT

 public:
  // The selected faults, where there are several, else the active one, and the volume shown come first.
  explicit RunDialog(Workbench& workbench, QWidget* parent = nullptr);

  tasks::ExtractOptions options() const;

 Q_SIGNALS:
  // Of the job; the dialog is closed.
  void started(int job);

 public Q_SLOTS:
  void run();

 private:
  QWidget* advanced();

  void offer_selected();

  Workbench& workbench_;
  std::vector<Id> selected_;  // as they were when it opened
  QComboBox *volume_, *fault_, *exchange_, *balance_;
  QLineEdit* name_;
  QSpinBox* ranks_;
  QToolButton* more_;
  QLabel* message_;
};

}  // namespace footwall::ui
