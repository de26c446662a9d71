// What takes longer than a second: how far it is, how long it will take, and a cross that cancels it. A click
// on a job, or Enter, shows its log below it.
#pragma once
#include <QScrollArea>
#include <set>
#include <utility>
#include <vector>

#include "ui/model/jobs.h"

class QLabel;
class QToolButton;
class QVBoxLayout;

namespace footwall::ui {

class JobRow;

class JobsPanel final : public QScrollArea {
  Q_OBJECT

 public:
  explicit JobsPanel(std::vector<Jobs*> jobs, QWidget* parent = nullptr);

 private:
  void list_jobs();
  void show_clear();

  std::vector<Jobs*> jobs_;
  std::vector<JobRow*> rows_;
  QWidget* body_ = nullptr;
  QVBoxLayout* column_ = nullptr;
  QLabel* nothing_ = nullptr;
  QToolButton* clear_ = nullptr;
  std::set<std::pair<const Jobs*, int>> open_;  // whose logs are shown, by number
};

// "1.2 s left", "3 min left"; empty for a time that is not known.
QString time_left_text(const QVariant& seconds);

}  // namespace footwall::ui
