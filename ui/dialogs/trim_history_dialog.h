// What a limit by age would drop of the history, and the dropping: only when the user says so, having seen
// how much.
#pragma once
#include <QCheckBox>
#include <QDialog>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>
#include <optional>
#include <string>

#include "ui/model/workbench.h"

namespace footwall::ui {

// Days that the history of this project is to be kept for, where the user has said; a reminder, nothing drops
// by itself.
std::optional<int> history_keep_days(const project::Project& project);
// The moment that many days ago, as HistoryStep::when.
std::string days_ago(int days);

class TrimHistoryDialog final : public QDialog {
  Q_OBJECT

 public:
  explicit TrimHistoryDialog(Workbench& workbench, QWidget* parent = nullptr);

  // "12 of 40 steps, 0.3 of 1.2 MiB, would go."
  QString message() const { return message_->text(); }

 public Q_SLOTS:
  // As a job; the dialog closes.
  void trim();

 private:
  void look();

  Workbench& workbench_;
  QSpinBox* days_;
  QCheckBox* remind_;
  QLabel* message_;
  QPushButton* trim_;
};

}  // namespace footwall::ui
