// The mouse and the keys: orbit, pan, zoom, planes that are dragged by their frame; what is left is for
// Picking.
#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "ui/scene3d/scene_private.h"

namespace footwall::ui {
namespace {

using render::Vec3;

constexpr double kTravel = 4;  // pixels before anything moves
constexpr double kZoomOfPixel = 1.01;
constexpr double kZoomOfNotch = 0.85;

}  // namespace

void SceneView::Private::show_pointer() {
  if (mouse == Mouse::kOrbit || mouse == Mouse::kPan || mouse == Mouse::kZoom || mouse == Mouse::kPlane)
    return;
  Qt::CursorShape shape = Qt::ArrowCursor;
  switch (workbench.picking.shape()) {
    case PointerShape::kArrow:
      break;
    case PointerShape::kCross:
    case PointerShape::kAddNode:
    case PointerShape::kPen:
      shape = Qt::CrossCursor;
      break;
    case PointerShape::kMoveNode:
      shape = Qt::SizeAllCursor;
      break;
    case PointerShape::kDeleteNode:
      shape = Qt::ForbiddenCursor;
      break;
    case PointerShape::kHand:
      shape = Qt::OpenHandCursor;
      break;
  }
  if (view.cursor().shape() != shape) view.setCursor(shape);
}

void SceneView::Private::hover(const QPointF& pixel, const QMouseEvent& event) {
  const Under below = view.under(pixel);
  const Pointer pointer = pointer_of(below, pixel, Qt::NoButton, event.modifiers(), event.timestamp());
  workbench.picking.move(pointer);
  const bool is_at_place = pressed_on ? pointer.on_section : below.hit;
  workbench.display.set_cursor(is_at_place ? std::optional(pointer.place) : std::nullopt);
  // A plane is hovered by its frame alone: it fills much of the picture.
  if (!pressed_on) workbench.selection.hover(pointer.under);
  drawing.set_hot_plane(pointer.on_frame ? below.plane : 0);
  show_pointer();
  view.update();
}

void SceneView::Private::begin_plane_drag(Id plane_id, const QPointF& pixel) {
  for (const Display::ShownSection& shown : workbench.display.sections()) {
    if (shown.id != plane_id) continue;
    const PlanePlace place = place_of(shown.section, *drawing.frame());
    const Ray ray = drawing.camera.ray(pixel, size());
    // The plane's point nearest to the ray under the mouse; the frame is where it was caught.
    const Vec3 normal = cross(place.across, place.down);
    const double towards = dot(ray.along, normal);
    const Vec3 middle = place.origin + (place.across + place.down) * 0.5;
    plane_grip = std::abs(towards) > 1e-3 * length(normal)
                     ? ray.from + ray.along * (dot(place.origin - ray.from, normal) / towards)
                     : ray.from + ray.along * dot(middle - ray.from, ray.along);
    const auto at = [&](std::int64_t index) {
      Section section = shown.section;
      section.index = index;
      return place_of(section, *drawing.frame()).origin;
    };
    plane_step = at(1) - at(0);
    plane_index = shown.section.index;
    plane = plane_id;
    mouse = Mouse::kPlane;
    drawing.set_loose_plane(plane_id);
    drawing.set_hot_plane(plane_id);
    return;
  }
}

// Steps from the grip, where the line of the plane's way comes nearest to the ray under the mouse.
double SceneView::Private::along_step(const QPointF& pixel) const {
  const Ray ray = drawing.camera.ray(pixel, size());
  const double ss = dot(plane_step, plane_step);
  const double sr = dot(plane_step, ray.along);
  const double det = ss - sr * sr;
  if (det < 1e-6 * ss) return 0;  // it would move along the view
  const Vec3 off = ray.from - plane_grip;
  return (dot(plane_step, off) - sr * dot(ray.along, off)) / det;
}

void SceneView::Private::drag_plane(const QPointF& pixel) {
  for (const Display::ShownSection& shown : workbench.display.sections()) {
    if (shown.id != plane) continue;
    const double steps = along_step(pixel);
    if (!std::isfinite(steps)) return;
    Section section = shown.section;
    section.index = plane_index;
    constexpr double kFar = 1 << 24;
    const auto by = static_cast<std::int64_t>(std::llround(std::clamp(steps, -kFar, kFar)));
    workbench.display.move_section(plane, stepped(section, by, drawing.frame()->geometry()));
    return;
  }
}

void SceneView::Private::put_plane_back() {
  mouse = Mouse::kNone;
  drawing.set_hot_plane(0);
  for (const Display::ShownSection& shown : workbench.display.sections()) {
    if (shown.id != plane) continue;
    Section section = shown.section;
    section.index = plane_index;
    return workbench.display.move_section(plane, section);
  }
}

void SceneView::mousePressEvent(QMouseEvent* event) {
  Private& d = *d_;
  if (d.mouse != Private::Mouse::kNone) return;  // a second button changes nothing
  d.pressed_at = d.last_at = event->position();
  d.pressed_button = event->button();
  d.travelled = false;
  const bool left = event->button() == Qt::LeftButton;
  const bool shift = event->modifiers().testFlag(Qt::ShiftModifier);
  const bool navigating = left && (event->modifiers().testFlag(Qt::AltModifier) || d.space_held);
  const MouseAction does =
      navigating ? (shift ? MouseAction::kPan : MouseAction::kOrbit)
                 : action_of(d.workbench.mouse.preset().scene, event->button(), event->modifiers());
  if (does != MouseAction::kNone) {
    d.mouse = does == MouseAction::kPan    ? Private::Mouse::kPan
              : does == MouseAction::kZoom ? Private::Mouse::kZoom
                                           : Private::Mouse::kOrbit;
    setCursor(Qt::ClosedHandCursor);
    return;
  }
  const Under below = under(event->position());
  if (left && below.on_frame) return d.begin_plane_drag(below.plane, event->position());
  const Pointer pointer =
      d.pointer_of(below, event->position(), event->button(), event->modifiers(), event->timestamp());
  if (d.workbench.picking.press(pointer)) {
    d.mouse = Private::Mouse::kPicking;
    d.pressed_on = pointer.section;
  } else if (left) {
    d.mouse = Private::Mouse::kPressed;
    d.lasso = shift;
  }
}

void SceneView::mouseMoveEvent(QMouseEvent* event) {
  Private& d = *d_;
  d.drawing.has_mouse = true;
  const QPointF at = event->position();
  const QPointF by = at - d.last_at;
  const QPointF since = at - d.pressed_at;
  if (d.mouse != Private::Mouse::kNone && std::hypot(since.x(), since.y()) >= kTravel) d.travelled = true;
  switch (d.mouse) {
    case Private::Mouse::kOrbit:
      if (!d.travelled) return;
      d.drawing.camera.orbit(by.x(), by.y());
      d.camera_moved();
      break;
    case Private::Mouse::kPan:
      if (!d.travelled) return;
      d.drawing.camera.pan(by.x(), by.y(), d.size());
      d.camera_moved();
      break;
    case Private::Mouse::kZoom:
      if (d.travelled) d.zoom_at(d.pressed_at, std::pow(kZoomOfPixel, by.y()));
      break;
    case Private::Mouse::kPlane:
      if (d.travelled) d.drag_plane(at);
      break;
    case Private::Mouse::kPressed:
      if (d.travelled) d.mouse = Private::Mouse::kSelecting;
      [[fallthrough]];
    case Private::Mouse::kSelecting:
      if (d.travelled) d.extend_selecting(at);
      break;
    case Private::Mouse::kPicking:
    case Private::Mouse::kNone:
      d.hover(at, *event);
      break;
  }
  d.last_at = at;
}

void SceneView::mouseReleaseEvent(QMouseEvent* event) {
  Private& d = *d_;
  if (event->button() != d.pressed_button) return;
  const auto was = std::exchange(d.mouse, Private::Mouse::kNone);
  const Under below = under(event->position());
  const Pointer pointer =
      d.pointer_of(below, event->position(), event->button(), event->modifiers(), event->timestamp());
  d.pressed_on.reset();
  if (was == Private::Mouse::kPicking) {
    d.workbench.picking.release(pointer);
  } else if (was == Private::Mouse::kSelecting) {
    const QPolygonF region = d.selecting;
    d.stop_selecting();
    if (region.size() > 2) d.select_within(region, event->modifiers().testFlag(Qt::ControlModifier));
  } else if (was == Private::Mouse::kPressed) {
    const bool marks = below.item.kind == Item::Kind::kNode || below.item.kind == Item::Kind::kPillar ||
                       below.item.kind == Item::Kind::kFace || below.item.kind == Item::Kind::kIsosurface;
    const bool extend = event->modifiers().testFlag(Qt::ControlModifier);
    if (marks) {
      d.workbench.selection.select(below.item, extend);
    } else if (!extend) {
      d.workbench.selection.clear();
    }
  } else if (was == Private::Mouse::kPlane) {
    d.drawing.set_hot_plane(below.on_frame ? below.plane : 0);
    update();
  }
  d.show_pointer();
}

void SceneView::mouseDoubleClickEvent(QMouseEvent* event) {
  const Under below = under(event->position());
  const Pointer pointer =
      d_->pointer_of(below, event->position(), event->button(), event->modifiers(), event->timestamp());
  if (!d_->workbench.picking.double_click(pointer)) mousePressEvent(event);
}

void SceneView::Private::zoom_at(const QPointF& pixel, double factor) {
  if (!drawing.frame()) return;
  OrbitCamera& camera = drawing.camera;
  // Beside everything, the plane through the target.
  const Ray ray = camera.ray(pixel, size());
  const Under below = view.under(pixel);
  const render::Camera seen = drawing.seen();
  const double towards = dot(ray.along, seen.forward);
  Vec3 at = ray.from + ray.along * (dot(camera.target() - ray.from, seen.forward) / towards);
  if (below.hit) {
    const Vec3 hit = drawing.frame()->scene_of(below.place);
    at = ray.from + ray.along * (dot(hit - ray.from, seen.forward) / towards);
  }
  camera.zoom(factor, at);
  camera_moved();
}

void SceneView::wheelEvent(QWheelEvent* event) {
  const double notches = event->angleDelta().y() / 120.0;
  if (notches == 0) return;
  d_->zoom_at(event->position(), std::pow(kZoomOfNotch, notches));
  event->accept();
}

// Before the window's shortcuts get them: Esc while a box or lasso is drawn or a plane is dragged, and what
// the window's own actions send here as keys (F, Home), which would find their way back to these actions for
// ever.
bool SceneView::event(QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride) {
    const auto& key = *static_cast<QKeyEvent*>(event);
    const bool has_hold = d_->mouse == Private::Mouse::kSelecting || d_->mouse == Private::Mouse::kPlane;
    const bool lets_go = has_hold && key.key() == Qt::Key_Escape;
    const bool own =
        key.modifiers() == Qt::NoModifier && (key.key() == Qt::Key_F || key.key() == Qt::Key_Home);
    if (lets_go || own) {
      event->accept();
      return true;
    }
  }
  return GlWidget::event(event);
}

void SceneView::keyPressEvent(QKeyEvent* event) {
  Private& d = *d_;
  if (event->key() == Qt::Key_Space && !event->isAutoRepeat()) d.space_held = true;
  if (event->key() == Qt::Key_Escape && d.mouse == Private::Mouse::kSelecting) {
    d.mouse = Private::Mouse::kNone;
    return d.stop_selecting();
  }
  if (event->key() == Qt::Key_Escape && d.mouse == Private::Mouse::kPlane) return d.put_plane_back();
  if (d.workbench.picking.key_press(event->key(), event->modifiers())) return;
  if (event->modifiers() != Qt::NoModifier && event->modifiers() != Qt::KeypadModifier) {
    return GlWidget::keyPressEvent(event);
  }
  Display& display = d.workbench.display;
  constexpr double kKeyPixels = 25;  // of a mouse that would do the same
  switch (event->key()) {
    case Qt::Key_O:
      return display.set_perspective(!display.perspective());
    case Qt::Key_E: {
      FaceLook look = display.faces();
      look.edges = !look.edges;
      return display.set_faces(look);
    }
    case Qt::Key_F:
      return frame_selection();
    case Qt::Key_Home:
      return fit();
    case Qt::Key_Left:
    case Qt::Key_Right:
      d.drawing.camera.orbit(event->key() == Qt::Key_Left ? -kKeyPixels : kKeyPixels, 0);
      return d.camera_moved();
    case Qt::Key_Up:
    case Qt::Key_Down:
      d.drawing.camera.orbit(0, event->key() == Qt::Key_Up ? -kKeyPixels : kKeyPixels);
      return d.camera_moved();
    case Qt::Key_Plus:
    case Qt::Key_Minus:
      d.drawing.camera.zoom(event->key() == Qt::Key_Plus ? 0.85 : 1 / 0.85, d.drawing.camera.target());
      return d.camera_moved();
    default:
      return GlWidget::keyPressEvent(event);
  }
}

void SceneView::keyReleaseEvent(QKeyEvent* event) {
  if (event->isAutoRepeat()) return;
  if (event->key() == Qt::Key_Space) d_->space_held = false;
  if (!d_->workbench.picking.key_release(event->key())) GlWidget::keyReleaseEvent(event);
}

// The release of keys that are held goes elsewhere.
void SceneView::focusOutEvent(QFocusEvent* event) {
  d_->space_held = false;
  d_->workbench.picking.let_keys_go();
  GlWidget::focusOutEvent(event);
}

void SceneView::leaveEvent(QEvent* event) {
  d_->drawing.has_mouse = false;
  d_->workbench.picking.leave();
  d_->workbench.display.set_cursor(std::nullopt);
  d_->workbench.selection.hover({});
  if (d_->mouse != Private::Mouse::kPlane) d_->drawing.set_hot_plane(0);
  update();
  GlWidget::leaveEvent(event);
}

}  // namespace footwall::ui
