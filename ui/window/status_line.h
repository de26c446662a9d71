// The line at the bottom: where the mouse is and the value there, and at the right what the next click would
// do, and Enter where it accepts a shift.
#pragma once
#include <QString>
#include <QWidget>
#include <vector>

#include "ui/model/workbench.h"

namespace footwall::ui {

// "412", "733", "1238.0 ms" ...: the words of the read-out with those that are dim.
struct ReadOut {
  QString text;
  bool dim = false;
  friend bool operator==(const ReadOut&, const ReadOut&) = default;
};
// place: index space. value: NaN where there is none; name: of the volume.
std::vector<ReadOut> read_out(const survey::Geometry& survey, const survey::IndexPoint& place,
                              const QString& name, double value);
// The sample under the place in what the sections have read; NaN where it is not among that.
double value_at(const Workbench& workbench, const survey::IndexPoint& place);

class StatusLine final : public QWidget {
  Q_OBJECT

 public:
  explicit StatusLine(QWidget* parent = nullptr);
  // Null: no project.
  void show_workbench(Workbench* workbench);
  QString text() const;  // of the left side
  QString hint() const { return hint_; }
  QSize sizeHint() const override { return {400, 26}; }
  QSize minimumSizeHint() const override { return {100, 26}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void refresh();
  void refresh_shift();

  Workbench* workbench_ = nullptr;
  std::vector<ReadOut> words_;
  QString shift_;  // what Enter would do, where it would do something
  QString hint_;
};

}  // namespace footwall::ui
