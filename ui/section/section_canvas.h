// The drawing surface of a section view: samples, axes and faults in two kept layers, and over them what
// moves.
//
// base: samples, grid, axes, scale. still: base and all faults that stand still. A move of the mouse, a step
// of a drag or of the linked cursor copies `still` and draws what moves; nothing else is made again.
#pragma once
#include <QPixmap>
#include <QPolygonF>
#include <QPushButton>
#include <QTimer>
#include <QWidget>
#include <optional>

#include "ui/model/workbench.h"
#include "ui/section/fault_shapes.h"
#include "ui/section/view_transform.h"

namespace footwall::ui {

class SectionCanvas final : public QWidget {
  Q_OBJECT

 public:
  // shown: of Display::sections().
  SectionCanvas(Workbench& bench, Id shown, QWidget* parent = nullptr);

  const ViewTransform& view() const { return view_; }
  const Section& section() const { return section_; }
  // The samples on the screen; null while there are none.
  const std::shared_ptr<const SectionSamples>& samples() const { return samples_; }
  // What the message in the middle says where there is nothing to show; else empty.
  QString message() const;

  void step(std::int64_t lines);
  void fit(bool true_proportions = false);
  void frame_selection();
  // As `view().part()` told earlier; false, and no change, for numbers that no view has.
  bool show_part(const ShownPart& part);
  // The number being typed for a jump, with its kind of line; empty where none is.
  QString jump_text() const { return jump_; }

  // How often each layer was made, for tests and benches.
  int base_redraws() const { return base_redraws_; }
  int still_redraws() const { return still_redraws_; }
  FaultShapes::Hit hit(const QPointF& at) { return shapes_.hit(at, view_); }

 Q_SIGNALS:
  void view_changed();
  // The button of an empty view.
  void import_wanted();

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void changeEvent(QEvent* event) override;
  bool event(QEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void keyReleaseEvent(QKeyEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;

 private:
  enum class Hold { kNone, kPan, kZoom, kPicking, kSelect, kLine };

  void connect_models();
  void follow_display();
  void take_survey();
  void ask();
  void take_samples(std::shared_ptr<const SectionSamples> samples);
  void lay_out();
  void show_place(const survey::IndexPoint& place, double reach);
  void redraw_base();
  void redraw_still();
  void show_message();
  void view_moved();
  void follow_linked(const Display::LinkedView& other);
  bool draws_line() const;

  void make_base();
  void make_still();
  std::set<Id> moving_faults() const;
  FaultDrawing drawing_of(const Fault& fault) const;
  void draw_moving(QPainter& painter);
  void draw_cursor(QPainter& painter) const;
  void draw_selecting(QPainter& painter) const;
  void draw_line_under_way(QPainter& painter) const;
  void draw_jump(QPainter& painter) const;

  Pointer pointer_of(const QPointF& at, Qt::KeyboardModifiers modifiers, Qt::MouseButton button,
                     std::chrono::milliseconds time);
  void point_at(const Pointer& pointer);
  void show_pointer_shape();
  void select_under(const Pointer& pointer);
  void select_within(const QPolygonF& region, bool extend);
  bool type_jump(const QKeyEvent& event);
  void jump();
  bool move_by_key(const QKeyEvent& event);

  Workbench& bench_;
  Id shown_;
  Section section_;
  bool exists_ = false;  // still among the display's sections
  bool linked_ = true;
  double velocity_ = 0;
  ViewTransform view_;
  FaultShapes shapes_;

  std::shared_ptr<const SectionSamples> samples_;
  QString failure_, failure_hint_;
  QTimer late_;  // has said nothing for 0.2 s
  bool is_late_ = false;

  QPixmap base_, still_;
  bool base_is_old_ = true, still_is_old_ = true;
  std::set<Id> still_without_;
  int base_redraws_ = 0, still_redraws_ = 0;
  QPushButton* button_ = nullptr;

  Hold hold_ = Hold::kNone;
  bool space_ = false;
  QPointF pressed_at_, last_at_;
  Pointer pressed_;
  bool far_ = false;  // the mouse travelled 4 px since the press
  bool stroke_here_ = false;
  bool line_begins_ = false;  // with the press of now
  bool mouse_inside_ = false;
  QPolygonF selecting_;  // box or lasso under way
  QString jump_;
  double wheel_turned_ = 0;  // eighths of a degree since the last step
};

}  // namespace footwall::ui
