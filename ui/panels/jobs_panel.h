// What takes longer than a second: how far it is, how long it will take, and a cross that cancels it.
#pragma once
#include <QScrollArea>
#include <vector>

#include "ui/model/jobs.h"

class QLabel;
class QVBoxLayout;

namespace footwall::ui {

class JobRow;

class JobsPanel final : public QScrollArea {
  Q_OBJECT

 public:
  explicit JobsPanel(std::vector<Jobs*> jobs, QWidget* parent = nullptr);

 private:
  void list_jobs();

  std::vector<Jobs*> jobs_;
  std::vector<JobRow*> rows_;
  QWidget* body_ = nullptr;
  QVBoxLayout* column_ = nullptr;
  QLabel* nothing_ = nullptr;
};

// "1.2 s left", "3 min left"; empty for a time that is not known.
QString time_left_text(const QVariant& seconds);

}  // namespace footwall::ui
