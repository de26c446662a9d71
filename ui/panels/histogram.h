// How values are spread, those of a fault's faces or a volume's samples, with handles for the range that the
// colours run over.
#pragma once
#include <QWidget>
#include <optional>
#include <vector>

namespace footwall::ui {

// Numbers of values in equal bins from low to high; what is not finite is left out, what lies beyond counts
// at the ends.
std::vector<int> bins_of(const std::vector<double>& values, double low, double high, int count);

class Histogram final : public QWidget {
  Q_OBJECT

 public:
  explicit Histogram(QWidget* parent = nullptr);

  // range: the one that colours run over now.
  void show_values(const std::vector<double>& values, std::optional<std::pair<double, double>> range);
  // The same of values that were counted already: heights of equal bins between from and to.
  void show_bars(std::vector<double> heights, double from, double to, std::pair<double, double> range);
  // Where the colours begin and end, also while a handle is dragged.
  void set_range(double low, double high);
  bool is_empty() const { return bins_.empty(); }
  std::pair<double, double> range() const { return {low_, high_}; }

  QSize sizeHint() const override { return {200, 84}; }
  QSize minimumSizeHint() const override { return {80, 84}; }

 Q_SIGNALS:
  void range_changed(double low, double high);  // while a handle is dragged, or moved with the arrow keys
  void range_reset();                           // by a double-click

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  double x_of(double value) const;
  double value_at(double x) const;
  void move_handle(double value);

  std::vector<double> bins_;
  double from_ = 0, to_ = 1;   // of the axis
  double low_ = 0, high_ = 1;  // of the colours
  int handle_ = 0;             // the one dragged, or moved last: 0 low, 1 high
  bool dragging_ = false;
};

}  // namespace footwall::ui
