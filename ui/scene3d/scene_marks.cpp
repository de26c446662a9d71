// Pillars, nodes, frames, outlines and what lies flat on the scene.
#include <QCoreApplication>
#include <algorithm>
#include <cmath>

#include "ui/scene3d/mixed_colour.h"
#include "ui/scene3d/scene_drawing.h"

namespace footwall::ui {
namespace {

using render::Vec3;
using render::Vec3f;

}  // namespace

DrawingMarks SceneDrawing::pillar_marks(Id fault, bool loose) const {
  DrawingMarks marks;
  const Fault* record = workbench_.document.fault(fault);
  if (record == nullptr || !flat_) return marks;
  QColor own(QString::fromStdString(record->record.colour));
  if (!own.isValid()) own = colours_.text;
  const Selection& selection = workbench_.selection;
  const Item& hovered = selection.hovered();
  const bool bare = !meshes_.has(fault);  // its pillars are all there is to see
  for (const survey::Pillar& pillar : workbench_.document.shown_pillars(fault)) {
    const bool picked = selection.pillars().contains(pillar.id) ||
                        (loose && pillar.id != 0 && pillar.id == workbench_.picking.active_pillar());
    const bool hot = hovered.kind == Item::Kind::kPillar && hovered.id == pillar.id;
    QColor colour = loose ? mixed(own, QColor(Qt::white), 0.45) : own.lighter(115);
    if (picked) colour = QColor(Qt::white);
    if (hot) colour = colours_.accent;
    if (pillar.kind == survey::PillarKind::kInterpolated && !picked) colour.setAlphaF(0.6F);
    const float width = hot ? 3.0F : picked ? 2.4F : loose ? 1.8F : 1.2F;
    std::optional<Vec3f> last;
    for (const survey::PillarNode& node : pillar.nodes) {
      const Vec3 scene = flat_->scene_of(node.position);
      const Vec3f at(scene);
      if (last) marks.lines.push_back({*last, at, rgba_of(colour), width});
      last = at;
      if (!loose && !bare && !picked) continue;
      const bool node_picked = selection.nodes().contains(node.id);
      const bool node_hot = hovered.kind == Item::Kind::kNode && hovered.id == node.id;
      const QColor fill = node_picked ? colours_.accent : QColor(Qt::white);
      const QColor rim = node_picked ? QColor(Qt::white) : own.darker(140);
      const float diameter = node_hot || node_picked ? 11.0F : picked ? 9.0F : 7.5F;
      marks.dots.push_back({at, rgba_of(fill), rgba_of(rim), diameter});
    }
  }
  return marks;
}

void SceneDrawing::add_frame_lines(std::vector<Line>& lines, Id plane) const {
  if (!frame_) return;
  for (const Display::ShownSection& shown : workbench_.display.sections()) {
    if (shown.id != plane || !shown.in_scene) continue;
    const PlanePlace place = place_of(shown.section, *frame_);
    const std::array<Vec3, 4> corners{place.origin, place.origin + place.across,
                                      place.origin + place.across + place.down, place.origin + place.down};
    const bool hot = plane == hot_plane_;
    QColor colour = hot ? colours_.accent : colours_.dim;
    if (!hot) colour.setAlphaF(0.7F);
    for (std::size_t n = 0; n < 4; ++n) {
      lines.push_back({Vec3f(corners[n]), Vec3f(corners[(n + 1) % 4]), rgba_of(colour), hot ? 2.5F : 1.2F});
    }
  }
}

void SceneDrawing::add_face_lines(std::vector<Line>& lines, const Item& face, const QColor& colour,
                                  float width) const {
  const FaultGeometry* mesh = meshes_.geometry(face.id);
  if (mesh == nullptr || !workbench_.display.is_visible({.kind = Item::Kind::kFault, .id = face.id})) return;
  const auto& faces = mesh->surface().faces;
  // By panel, then number.
  const auto found = std::ranges::lower_bound(faces, std::pair(face.panel, face.number), {},
                                              [](const auto& f) { return std::pair<Id, int>(f.panel, f.n); });
  if (found == faces.end() || found->panel != face.panel || found->n != face.number) return;
  const auto at = static_cast<std::size_t>(found - faces.begin());
  for (std::size_t n = 0; n < 3; ++n) {
    lines.push_back({mesh->positions()[mesh->corners()[3 * at + n]],
                     mesh->positions()[mesh->corners()[3 * at + (n + 1) % 3]], rgba_of(colour), width});
  }
}

void SceneDrawing::add_pillar_lines(std::vector<Line>& lines, const survey::Pillar& pillar,
                                    const QColor& colour, float width) const {
  for (std::size_t n = 1; n < pillar.nodes.size(); ++n) {
    lines.push_back({Vec3f(flat_of(pillar.nodes[n - 1].position)), Vec3f(flat_of(pillar.nodes[n].position)),
                     rgba_of(colour), width});
  }
}

void SceneDrawing::refresh_static_marks() {
  if (!std::exchange(static_marks_old_, false)) return;
  const std::set<Id> loose = loose_faults();
  DrawingMarks all;
  for (const Id fault : shown_faults()) {
    if (loose.contains(fault)) continue;
    DrawingMarks marks = pillar_marks(fault, false);
    all.lines.insert(all.lines.end(), marks.lines.begin(), marks.lines.end());
    all.dots.insert(all.dots.end(), marks.dots.begin(), marks.dots.end());
  }
  pillars_.set(*gl_, all.lines);
  nodes_.set(*gl_, all.dots);
}

void SceneDrawing::refresh_camera_marks(const Pass& pass, const QSizeF& view, TextImages& texts) {
  std::vector<Line> lines;
  std::vector<Sprite> labels;
  if (frame_) {
    BoxMarks box = box_marks(*frame_, pass.camera, view, colours_, texts);
    lines = std::move(box.lines);
    labels = std::move(box.labels);
  }
  box_.set(*gl_, lines);
  labels_.set(*gl_, labels);
}

void SceneDrawing::refresh_loose_marks() {
  if (!std::exchange(loose_marks_old_, false)) return;
  DrawingMarks marks;
  const std::set<Id> shown = shown_faults();
  const std::set<Id> loose = loose_faults();
  for (const Id fault : loose) {
    if (!shown.contains(fault)) continue;
    const DrawingMarks own = pillar_marks(fault, true);
    marks.lines.insert(marks.lines.end(), own.lines.begin(), own.lines.end());
    marks.dots.insert(marks.dots.end(), own.dots.begin(), own.dots.end());
  }
  std::set<Id> outlined = workbench_.selection.faults();
  outlined.insert(loose.begin(), loose.end());
  std::size_t faces = 0;
  for (const Id fault : outlined) {
    const FaultGeometry* mesh = meshes_.geometry(fault);
    if (mesh == nullptr || !shown.contains(fault)) continue;
    faces += mesh->face_count();
    if (faces > 4 * kLooseTriangles) break;
    const std::vector<Vec3f>& outline = mesh->outline();
    for (std::size_t n = 0; n + 1 < outline.size(); n += 2) {
      marks.lines.push_back({outline[n], outline[n + 1], rgba_of(colours_.accent), 1.6F});
    }
  }
  const Item& current = workbench_.selection.current();
  if (current.kind == Item::Kind::kFace) add_face_lines(marks.lines, current, colours_.accent, 4.0F);
  // Faintly through what is before it, too: planes meet where the tour shows a face.
  std::vector<Line> through;
  if (current.kind == Item::Kind::kFace) {
    QColor faint = colours_.accent;
    faint.setAlphaF(0.75F);
    add_face_lines(through, current, faint, 2.0F);
  }
  through_lines_.set(*gl_, through);
  const auto flat_point = [this](const survey::IndexPoint& p) { return Vec3f(flat_->scene_of(p)); };
  const std::vector<survey::IndexPoint>& stroke = workbench_.picking.stroke();
  for (std::size_t n = 1; flat_ && n < stroke.size(); ++n) {
    marks.lines.push_back({flat_point(stroke[n - 1]), flat_point(stroke[n]), rgba_of(colours_.accent), 2.0F});
  }
  loose_lines_.set(*gl_, marks.lines);
  loose_dots_.set(*gl_, marks.dots);
}

void SceneDrawing::refresh_flat(const QSizeF& view, TextImages& texts, double pixel, bool with_state) {
  std::vector<Sprite> sprites;
  const auto add = [&](const QImage& image, const QPointF& at) {
    sprites.push_back(
        {image, Vec3f(static_cast<float>(at.x()), static_cast<float>(at.y()), 0), {0, 0}, true});
  };
  if (bar_) {
    const QImage image = colour_bar_image(*bar_, colours_, font_, pixel);
    const QSizeF size = image.deviceIndependentSize();
    add(image, {view.width() - size.width() - 12, view.height() - size.height() - 12});
  }
  if (frame_) {
    const render::Camera now = camera.camera(view);
    const double right = now.right.y;
    const double up = now.up.y;
    const double length = std::hypot(right, up);
    if (length > 0.05) {
      const QImage arrow =
          north_arrow_image(std::atan2(right, up) * 180 / M_PI, length, colours_, font_, pixel);
      add(arrow, {14, view.height() - arrow.deviceIndependentSize().height() - 10});
    }
  } else {
    const auto tr = [](const char* words) { return QCoreApplication::translate("SceneView", words); };
    const std::array<QImage, 2> lines{
        texts.of(tr("Nothing to show yet"), colours_.text, true),
        texts.of(tr("Import a SEG-Y volume (File > Import) or drop one here"), colours_.dim)};
    double y = view.height() / 2 - lines[0].deviceIndependentSize().height();
    for (const QImage& line : lines) {
      const QSizeF size = line.deviceIndependentSize();
      add(line, {(view.width() - size.width()) / 2, y});
      y += size.height();
    }
  }
  if (with_state && frame_ && hot_plane_ != 0) {
    for (const Display::ShownSection& shown : workbench_.display.sections()) {
      if (shown.id != hot_plane_ || !shown.in_scene) continue;
      const PlanePlace place = place_of(shown.section, *frame_);
      QPointF at;
      const QImage& image = texts.of(title_of(shown.section, frame_->geometry()), colours_.accent, true);
      if (project_to(camera.camera(view), view, place.origin + place.across * 0.5, &at)) {
        add(image, at - QPointF(image.deviceIndependentSize().width() / 2,
                                image.deviceIndependentSize().height() + 4));
      }
    }
  }
  if (const double share = std::min(picture_share, shape_share); with_state && share < 1) {
    QImage line(QSize(std::max(1, static_cast<int>(view.width() * pixel * std::max(0.06, share))),
                      static_cast<int>(std::ceil(2 * pixel))),
                QImage::Format_RGBA8888_Premultiplied);
    line.setDevicePixelRatio(pixel);
    line.fill(colours_.accent);
    add(line, {0, 0});
  }
  flat_sprites_.set(*gl_, sprites);
}

}  // namespace footwall::ui
