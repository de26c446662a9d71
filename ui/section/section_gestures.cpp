// What mouse and keys do over a section. Picking is asked first; what it does not take pans, selects or
// steps.
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainterPath>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "ui/section/section_canvas.h"

namespace footwall::ui {
namespace {

constexpr double kTravel = 4;  // pixels before anything moves
constexpr double kZoomOfPixel = 1.01;
constexpr double kNotch = 120;  // of a wheel, in eighths of a degree

std::chrono::milliseconds time_of(const QInputEvent& event) {
  return std::chrono::milliseconds(event.timestamp());
}

Qt::CursorShape cursor_of(PointerShape shape) {
  switch (shape) {
    case PointerShape::kArrow:
      return Qt::ArrowCursor;
    case PointerShape::kMoveNode:
      return Qt::SizeAllCursor;
    case PointerShape::kDeleteNode:
      return Qt::ForbiddenCursor;
    case PointerShape::kPen:
    case PointerShape::kAddNode:
    case PointerShape::kCross:
      return Qt::CrossCursor;
    case PointerShape::kHand:
      return Qt::OpenHandCursor;
  }
  return Qt::ArrowCursor;
}

}  // namespace

Pointer SectionCanvas::pointer_of(const QPointF& at, Qt::KeyboardModifiers modifiers, Qt::MouseButton button,
                                  std::chrono::milliseconds time) {
  const PlanePoint p = view_.to_plane(at);
  const PlaneSize& size = view_.frame().size;
  const FaultShapes::Hit found = shapes_.hit(at, view_);
  Pointer pointer;
  pointer.x = at.x();
  pointer.y = at.y();
  pointer.place = index_of(section_, p);
  pointer.section = section_;
  pointer.on_section = message().isEmpty() && view_.area().contains(at) && p.u >= -0.5 && p.v >= -0.5 &&
                       p.u <= size.width - 0.5 && p.v <= size.height - 0.5;
  pointer.under = found.item;
  pointer.segment = found.item.kind == Item::Kind::kPillar ? found.segment : -1;
  pointer.modifiers = modifiers;
  pointer.button = button;
  pointer.time = time;
  return pointer;
}

void SectionCanvas::point_at(const Pointer& pointer) {
  bench_.display.set_cursor(pointer.on_section ? std::optional(pointer.place) : std::nullopt);
  // A click that ends a line selects nothing.
  if (hold_ == Hold::kNone) bench_.selection.hover(draws_line() ? Item() : pointer.under);
}

void SectionCanvas::show_pointer_shape() {
  if (hold_ == Hold::kPan) {
    setCursor(Qt::ClosedHandCursor);
  } else if (space_) {
    setCursor(Qt::OpenHandCursor);
  } else if (draws_line()) {
    setCursor(Qt::CrossCursor);
  } else {
    setCursor(cursor_of(bench_.picking.shape()));
  }
}

void SectionCanvas::mousePressEvent(QMouseEvent* event) {
  const Pointer pointer = pointer_of(event->position(), event->modifiers(), event->button(), time_of(*event));
  if (hold_ != Hold::kNone) return;  // a second button changes nothing
  pressed_at_ = last_at_ = event->position();
  pressed_ = pointer;
  far_ = false;
  const bool left = event->button() == Qt::LeftButton;
  const MouseAction does =
      left && space_ ? MouseAction::kPan
                     : action_of(bench_.mouse.preset().section, event->button(), event->modifiers());
  if (does == MouseAction::kPan) {
    hold_ = Hold::kPan;
  } else if (does == MouseAction::kZoom) {
    hold_ = Hold::kZoom;
  } else if (left && draws_line()) {
    hold_ = Hold::kLine;
    line_begins_ = !bench_.line.first();
    if (line_begins_ && pointer.on_section) bench_.line.put(pointer.place);
  } else if (bench_.picking.press(pointer)) {
    hold_ = Hold::kPicking;
    stroke_here_ = true;
  } else if (left) {
    hold_ = Hold::kSelect;
  } else {
    event->ignore();
  }
  show_pointer_shape();
}

void SectionCanvas::mouseMoveEvent(QMouseEvent* event) {
  mouse_inside_ = true;
  const QPointF at = event->position();
  far_ = far_ || QLineF(at, pressed_at_).length() >= kTravel;
  const Pointer pointer = pointer_of(at, event->modifiers(), Qt::NoButton, time_of(*event));
  point_at(pointer);
  switch (hold_) {
    case Hold::kPan:
      if (far_) {
        view_.pan(at - last_at_);
        last_at_ = at;
        view_moved();
      }
      return;
    case Hold::kZoom:
      if (far_) {
        view_.zoom(pressed_at_, std::pow(kZoomOfPixel, last_at_.y() - at.y()));
        last_at_ = at;
        view_moved();
      }
      return;
    case Hold::kSelect:
      if (!far_) return;
      if (pressed_.modifiers.testFlag(Qt::ShiftModifier)) {
        if (selecting_.isEmpty()) selecting_ << pressed_at_;
        selecting_ << at;
      } else {
        selecting_ = QPolygonF(QRectF(pressed_at_, at).normalized());
      }
      update();
      return;
    case Hold::kLine:
      return;  // is drawn to the cursor
    case Hold::kNone:
    case Hold::kPicking:
      if (!space_) bench_.picking.move(pointer);
      show_pointer_shape();
      return;
  }
}

void SectionCanvas::mouseReleaseEvent(QMouseEvent* event) {
  const Hold held = hold_;
  const bool is_its_end = event->button() == pressed_.button;
  if (held == Hold::kNone || !is_its_end) return;
  hold_ = Hold::kNone;
  const Pointer pointer = pointer_of(event->position(), event->modifiers(), event->button(), time_of(*event));
  if (held == Hold::kPicking) {
    bench_.picking.release(pointer);
    stroke_here_ = false;
  } else if (held == Hold::kSelect) {
    const QPolygonF region = std::exchange(selecting_, {});
    if (region.size() > 2) {
      select_within(region, event->modifiers().testFlag(Qt::ControlModifier));
    } else {
      select_under(pressed_);
    }
    update();
  } else if (held == Hold::kLine && (far_ || !line_begins_)) {
    bench_.line.put(pointer.place);
  }
  point_at(pointer);
  show_pointer_shape();
}

void SectionCanvas::mouseDoubleClickEvent(QMouseEvent* event) {
  if (hold_ != Hold::kNone) return;
  const Pointer pointer = pointer_of(event->position(), event->modifiers(), event->button(), time_of(*event));
  if (!space_ && !draws_line() && bench_.picking.double_click(pointer)) return;
  mousePressEvent(event);
}

void SectionCanvas::leaveEvent(QEvent*) {
  mouse_inside_ = false;
  bench_.display.set_cursor(std::nullopt);
  if (hold_ == Hold::kNone) {
    bench_.selection.hover({});
    bench_.picking.leave();
  }
}

void SectionCanvas::wheelEvent(QWheelEvent* event) {
  // Some platforms turn Shift+wheel into a sideways one.
  const double delta = event->angleDelta().y() != 0 ? event->angleDelta().y() : event->angleDelta().x();
  if (delta == 0 || !message().isEmpty()) return;
  event->accept();
  const bool other = event->modifiers().testFlag(Qt::ControlModifier);
  if (!event->modifiers().testFlag(Qt::ShiftModifier) && bench_.mouse.preset().wheel_steps != other) {
    // Away from the hand is on; a pad turns it in parts of a notch.
    wheel_turned_ += delta;
    const double notches = std::trunc(wheel_turned_ / kNotch);
    wheel_turned_ -= notches * kNotch;
    if (notches != 0) step(static_cast<std::int64_t>(notches) * bench_.picking.step_lines());
    return;
  }
  const double factor = std::pow(1.2, delta / kNotch);
  if (event->modifiers().testFlag(Qt::ShiftModifier) && view_.frame().vertical) {
    view_.stretch(event->position(), factor);
  } else {
    view_.zoom(event->position(), factor);
  }
  view_moved();
}

void SectionCanvas::select_under(const Pointer& pointer) {
  if (pointer.under) {
    bench_.selection.select(pointer.under, pointer.modifiers.testFlag(Qt::ControlModifier));
  } else if (!pointer.modifiers.testFlag(Qt::ControlModifier)) {
    bench_.selection.clear();
  }
}

// Pillars whose nodes on and near this section, as far as pillars are drawn, all lie in the region; of the
// others single nodes on the section. What a pillar has far from here is not seen and does not count. A fault
// without pillars, as surfaces are imported, counts where all of its cut lies in the region.
void SectionCanvas::select_within(const QPolygonF& region, bool extend) {
  const double near = bench_.display.fade_distance();
  std::set<Id> faults, pillars, nodes;
  const auto is_inside = [&](const PlanePoint& at) {
    return region.containsPoint(view_.to_pixels(at), Qt::OddEvenFill);
  };
  for (const Fault& fault : bench_.document.faults()) {
    if (!bench_.display.is_visible({.kind = Item::Kind::kFault, .id = fault.record.id})) continue;
    const std::vector<CutSegment>& cut = shapes_.of(fault.record.id).cut;
    if (fault.pillars.empty() && !cut.empty() && std::ranges::all_of(cut, [&](const CutSegment& segment) {
          return is_inside(segment[0]) && is_inside(segment[1]);
        })) {
      faults.insert(fault.record.id);
    }
    for (const ShapedPillar& pillar : shapes_.of(fault.record.id).pillars) {
      std::size_t here = 0, caught = 0;
      std::set<Id> inside;
      for (const ShapedNode& node : pillar.nodes) {
        if (!node.on_section() && !(std::abs(node.distance) < near)) continue;
        ++here;
        if (!is_inside(node.at)) continue;
        ++caught;
        if (node.on_section()) inside.insert(node.id);
      }
      if (caught != 0 && caught == here) {
        pillars.insert(pillar.id);
      } else {
        nodes.merge(inside);
      }
    }
  }
  const bool lasso = pressed_.modifiers.testFlag(Qt::ShiftModifier);
  Selection& selection = bench_.selection;
  if (lasso && !extend)
    return selection.select_by_lasso(std::move(faults), std::move(pillars), std::move(nodes));
  selection.select_all(std::move(faults), std::move(pillars), std::move(nodes), extend);
}

bool SectionCanvas::type_jump(const QKeyEvent& event) {
  const QString text = event.text();
  const bool plain = !(event.modifiers() & (Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier));
  const bool is_slice = section_.kind == Section::Kind::kSlice;
  const bool fits = plain && text.size() == 1 && section_.kind != Section::Kind::kLine &&
                    ((text[0] >= u'0' && text[0] <= u'9') || (text[0] == u'-' && jump_.isEmpty()) ||
                     (text[0] == u'.' && is_slice && !jump_.contains(u'.')));
  if (fits && jump_.size() < 12) {
    jump_ += text;
  } else if (jump_.isEmpty()) {
    return false;
  } else if (event.key() == Qt::Key_Backspace) {
    jump_.chop(1);
  } else if (event.key() == Qt::Key_Escape) {
    jump_.clear();
  } else if (event.key() == Qt::Key_Return || event.key() == Qt::Key_Enter) {
    jump();
  } else {
    return false;
  }
  update();
  return true;
}

// To the nearest line or sample there is.
void SectionCanvas::jump() {
  bool is_number = false;
  const double wanted = std::exchange(jump_, {}).toDouble(&is_number);
  if (!is_number || !exists_ || !bench_.document.survey()) return;
  const survey::Geometry& survey = *bench_.document.survey();
  double first = survey.z0, step = survey.interval;
  if (section_.kind == Section::Kind::kInline) {
    first = survey.inlines.first;
    step = survey.inlines.step;
  } else if (section_.kind == Section::Kind::kCrossline) {
    first = survey.crosslines.first;
    step = survey.crosslines.step;
  }
  Section to = section_;
  constexpr double kFar = 1 << 24;
  to.index = std::llround(std::clamp((wanted - first) / step, -kFar, kFar));
  bench_.display.move_section(shown_, stepped(to, 0, survey));
}

bool SectionCanvas::move_by_key(const QKeyEvent& event) {
  if (event.modifiers() & (Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier)) return false;
  const bool shift = event.modifiers().testFlag(Qt::ShiftModifier);
  const std::int64_t lines = shift ? 1 : bench_.picking.step_lines();
  const QPointF page(view_.area().width() / 10, view_.area().height() / 10);
  QPointF pan;
  double zoom = 1;
  switch (event.key()) {
    case Qt::Key_X:
      step(lines);
      return true;
    case Qt::Key_Z:
      step(-lines);
      return true;
    case Qt::Key_PageDown:
      step(10 * lines);
      return true;
    case Qt::Key_PageUp:
      step(-10 * lines);
      return true;
    case Qt::Key_Home:
      fit(shift);
      return true;
    case Qt::Key_F:
      frame_selection();
      return true;
    case Qt::Key_Left:
      pan = {page.x(), 0};
      break;
    case Qt::Key_Right:
      pan = {-page.x(), 0};
      break;
    case Qt::Key_Up:
      pan = {0, page.y()};
      break;
    case Qt::Key_Down:
      pan = {0, -page.y()};
      break;
    case Qt::Key_Plus:
    case Qt::Key_Equal:
      zoom = 1.2;
      break;
    case Qt::Key_Minus:
      zoom = 1 / 1.2;
      break;
    default:
      return false;
  }
  view_.pan(pan);
  if (zoom != 1) view_.zoom(view_.area().center(), zoom);
  view_moved();
  return true;
}

// Before the window's shortcuts get them: what is a key of this view.
bool SectionCanvas::event(QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride) {
    const auto& key = *static_cast<QKeyEvent*>(event);
    const bool plain = !(key.modifiers() & (Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier));
    constexpr std::array kOwn{Qt::Key_X,    Qt::Key_Z,     Qt::Key_PageDown, Qt::Key_PageUp, Qt::Key_Home,
                              Qt::Key_F,    Qt::Key_Left,  Qt::Key_Right,    Qt::Key_Up,     Qt::Key_Down,
                              Qt::Key_Plus, Qt::Key_Minus, Qt::Key_Equal,    Qt::Key_Space};
    const bool digit = key.key() >= Qt::Key_0 && key.key() <= Qt::Key_9;
    const bool ends_jump =
        !jump_.isEmpty() && (key.key() == Qt::Key_Return || key.key() == Qt::Key_Enter ||
                             key.key() == Qt::Key_Escape || key.key() == Qt::Key_Backspace);
    const bool ends_selecting = hold_ == Hold::kSelect && key.key() == Qt::Key_Escape;
    if (plain && (digit || ends_jump || ends_selecting || std::ranges::find(kOwn, key.key()) != kOwn.end())) {
      event->accept();
      return true;
    }
  }
  return QWidget::event(event);
}

void SectionCanvas::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Space && !event->isAutoRepeat()) {
    space_ = true;
    bench_.picking.key_press(event->key(), event->modifiers());
    show_pointer_shape();
    return;
  }
  if (event->key() == Qt::Key_Escape && hold_ == Hold::kSelect) {
    selecting_.clear();
    hold_ = Hold::kNone;
    update();
    return;
  }
  if (event->key() == Qt::Key_Escape && bench_.line.is_active()) return bench_.line.end();
  if (type_jump(*event)) return;
  if (bench_.picking.key_press(event->key(), event->modifiers())) return;
  if (move_by_key(*event)) return;
  QWidget::keyPressEvent(event);
}

void SectionCanvas::keyReleaseEvent(QKeyEvent* event) {
  if (event->isAutoRepeat()) return;
  if (event->key() == Qt::Key_Space) space_ = false;
  const bool taken = bench_.picking.key_release(event->key());
  show_pointer_shape();
  if (!taken && event->key() != Qt::Key_Space) QWidget::keyReleaseEvent(event);
}

void SectionCanvas::focusOutEvent(QFocusEvent* event) {
  space_ = false;
  bench_.picking.let_keys_go();  // their release goes elsewhere
  if (!jump_.isEmpty()) {
    jump_.clear();
    update();
  }
  show_pointer_shape();
  QWidget::focusOutEvent(event);
}

}  // namespace footwall::ui
