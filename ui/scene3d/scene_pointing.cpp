// What lies under a pixel.
#include <algorithm>
#include <cmath>

#include "ui/scene3d/scene_private.h"

namespace footwall::ui {
namespace {

using render::Vec3;

constexpr double kNodeCatch = 11;  // pixels
constexpr double kPillarCatch = 6;
constexpr double kFrameCatch = 5;
constexpr double kOnSection = 0.5;  // voxels between a node and the section that it lies on
constexpr double kBehind =
    0.01;  // share of the distance by which a node may lie behind a surface and be seen

double distance_to(const QPointF& p, const QPointF& a, const QPointF& b) {
  const QPointF along = b - a;
  const double length2 = QPointF::dotProduct(along, along);
  const double t = length2 > 0 ? std::clamp(QPointF::dotProduct(p - a, along) / length2, 0.0, 1.0) : 0;
  const QPointF off = p - a - along * t;
  return std::hypot(off.x(), off.y());
}

Ray flattened(const Ray& ray, double heights) {
  return {{ray.from.x, ray.from.y, ray.from.z / heights}, {ray.along.x, ray.along.y, ray.along.z / heights}};
}

}  // namespace

// False where the picture of the fault's box tells that nothing of it is caught at the pixel.
bool SceneView::Private::may_be_near(Id fault, const QPointF& pixel, const render::Camera& camera) const {
  const FaultGeometry* mesh = drawing.geometry(fault);
  if (mesh == nullptr || workbench.document.is_provisional(fault)) return true;
  const render::Bounds& box = mesh->bounds();
  QRectF seen;
  for (unsigned n = 0; n < 8; ++n) {
    QPointF at;
    const Vec3 corner{(n & 1U) != 0 ? box.hi.x : box.lo.x, (n & 2U) != 0 ? box.hi.y : box.lo.y,
                      ((n & 4U) != 0 ? box.hi.z : box.lo.z) * drawing.heights()};
    if (!project_to(camera, size(), corner, &at)) return true;
    seen = n == 0 ? QRectF(at, QSizeF(0.1, 0.1)) : seen.united(QRectF(at, QSizeF(0.1, 0.1)));
  }
  return seen.adjusted(-kNodeCatch, -kNodeCatch, kNodeCatch, kNodeCatch).contains(pixel);
}

// Nodes and pillars of visible faults near the pixel that are seen: none lies farther than `nearest` along
// the view, or for a node than what is seen at its own pixel.
std::optional<SceneView::Private::Mark> SceneView::Private::mark_at(const QPointF& pixel,
                                                                    double nearest) const {
  const render::Camera camera = drawing.seen();
  const double heights = drawing.heights();
  const survey::Geometry& survey = drawing.frame()->geometry();
  std::optional<Mark> best;
  double best_node = kNodeCatch;
  double best_pillar = kPillarCatch;
  const bool has_active = workbench.selection.active_fault() != 0;
  for (const Id fault : drawing.shown_faults()) {
    // Nodes are caught where they are drawn: of the active fault, of picked pillars, of faults without faces.
    const bool nodes_shown =
        fault == workbench.selection.active_fault() || drawing.geometry(fault) == nullptr || !has_active;
    if (!may_be_near(fault, pixel, camera)) continue;
    for (const survey::Pillar& pillar : workbench.document.shown_pillars(fault)) {
      bool has_last = false;
      QPointF last;
      double last_depth = 0;
      for (std::size_t n = 0; n < pillar.nodes.size(); ++n) {
        const Vec3 flat = drawing.flat_of(pillar.nodes[n].position);
        const Vec3 at{flat.x, flat.y, flat.z * heights};
        const double depth = dot(at - camera.eye, camera.forward);
        QPointF here;
        if (!project_to(camera, size(), at, &here)) {
          has_last = false;
          continue;
        }
        const QPointF off = here - pixel;
        const double away = std::hypot(off.x(), off.y());
        const auto is_seen = [&] {
          return depth <= nearest * (1 + kBehind) || depth <= depth_at(here, camera) * (1 + kBehind);
        };
        if ((nodes_shown || workbench.selection.pillars().contains(pillar.id)) && away < best_node &&
            is_seen()) {
          best_node = away;
          best = Mark{.item = {.kind = Item::Kind::kNode, .id = pillar.nodes[n].id},
                      .nodes = {survey.index_of(pillar.nodes[n].position)}};
        }
        if (has_last && best_node == kNodeCatch && std::min(depth, last_depth) <= nearest * (1 + kBehind)) {
          const double beside = distance_to(pixel, last, here);
          if (beside < best_pillar) {
            best_pillar = beside;
            best = Mark{.item = {.kind = Item::Kind::kPillar, .id = pillar.id},
                        .segment = static_cast<int>(n) - 1,
                        .nodes = {survey.index_of(pillar.nodes[n - 1].position),
                                  survey.index_of(pillar.nodes[n].position)}};
          }
        }
        last = here;
        has_last = true;
        last_depth = depth;
      }
    }
  }
  return best;
}

// Where the ray under a pixel meets a section; nothing beside it.
std::optional<PlaneHit> SceneView::Private::hit_on(const Section& section, const QPointF& pixel) const {
  const render::SceneFrame& frame = *drawing.frame();
  return hit_of(drawing.camera.ray(pixel, size()), place_of(section, frame),
                size_of(section, frame.geometry()));
}

// A node or pillar that lies on a section is moved on that one, also where its fault's faces stand before
// the section or the mouse is just beside it. Of several sections the nearest.
void SceneView::Private::put_on_its_section(const Mark& mark, const QPointF& pixel, Under* under) const {
  bool found = false;
  double nearest = INFINITY;
  for (const Display::ShownSection& shown : workbench.display.sections()) {
    const PlaneSize size = size_of(shown.section, drawing.frame()->geometry());
    const auto lies_on = [&](const survey::IndexPoint& node) {
      const PlanePoint at = plane_of(shown.section, node);
      return std::abs(distance_from(shown.section, node)) <= kOnSection && at.u >= -0.5 && at.v >= -0.5 &&
             at.u <= size.width - 0.5 && at.v <= size.height - 0.5;
    };
    if (!shown.in_scene || !std::ranges::all_of(mark.nodes, lies_on)) continue;
    const auto hit = hit_on(shown.section, pixel);
    if (hit ? hit->distance > nearest : found) continue;
    found = true;
    if (hit) nearest = hit->distance;
    under->hit = under->on_plane = true;
    under->plane = shown.id;
    under->place = hit ? index_of(shown.section, hit->at) : mark.nodes.front();
  }
}

Id SceneView::Private::frame_at(const QPointF& pixel) const {
  if (!drawing.frame()) return 0;
  const render::Camera camera = drawing.seen();
  Id best = 0;
  double nearest = kFrameCatch;
  for (const Display::ShownSection& shown : workbench.display.sections()) {
    if (!shown.in_scene || shown.section.kind == Section::Kind::kLine) continue;
    const PlanePlace place = place_of(shown.section, *drawing.frame());
    const std::array<Vec3, 5> corners{place.origin, place.origin + place.across,
                                      place.origin + place.across + place.down, place.origin + place.down,
                                      place.origin};
    for (std::size_t n = 0; n < 4; ++n) {
      QPointF a, b;
      if (!project_to(camera, size(), corners[n], &a) || !project_to(camera, size(), corners[n + 1], &b))
        continue;
      const double away = distance_to(pixel, a, b);
      if (away >= nearest) continue;
      nearest = away;
      best = shown.id;
    }
  }
  return best;
}

SceneView::Under SceneView::under(const QPointF& pixel) const {
  Under result;
  const SceneDrawing& drawing = d_->drawing;
  if (!drawing.frame()) return result;
  const render::SceneFrame& frame = *drawing.frame();
  const Ray ray = drawing.camera.ray(pixel, d_->size());
  double nearest = INFINITY;
  for (const Display::ShownSection& shown : d_->workbench.display.sections()) {
    if (!shown.in_scene) continue;
    const PlaneSize size = size_of(shown.section, frame.geometry());
    const auto hit = hit_of(ray, place_of(shown.section, frame), size);
    if (!hit || hit->distance >= nearest) continue;
    nearest = hit->distance;
    result.hit = result.on_plane = true;
    result.plane = shown.id;
    result.place = index_of(shown.section, hit->at);
    result.item = {.kind = Item::Kind::kSection, .id = shown.id};
  }
  const Ray flat = flattened(ray, drawing.heights());
  for (const Id fault : drawing.shown_faults()) {
    const FaultGeometry* mesh = drawing.geometry(fault);
    if (mesh == nullptr || mesh->face_count() == 0) continue;
    const render::Vec3f lo(mesh->bounds().lo), hi(mesh->bounds().hi);
    if (!entry_of(flat, lo, hi, nearest)) continue;
    const auto hit = mesh->tree().first_hit(flat, nearest);
    if (!hit) continue;
    nearest = hit->distance;
    const project::MeshFace& face = mesh->surface().faces[static_cast<std::size_t>(hit->face)];
    result.hit = true;
    result.on_plane = false;
    result.plane = 0;
    result.item = {.kind = Item::Kind::kFace, .id = fault, .panel = face.panel, .number = face.n};
    const Vec3 at = ray.from + ray.along * hit->distance;
    result.place = index_at(at);
  }
  for (const IsosurfaceLook& look : drawing.shown_shapes()) {
    const auto hit = drawing.shape(look.id)->tree.first_hit(flat, nearest);
    if (!hit) continue;
    nearest = hit->distance;
    result.hit = true;
    result.on_plane = false;
    result.plane = 0;
    result.item = {.kind = Item::Kind::kIsosurface, .id = look.id};
    result.place = index_at(ray.from + ray.along * hit->distance);
  }
  // Along the view's axis, as depths of nodes are.
  const render::Camera camera = drawing.seen();
  const double depth =
      std::isfinite(nearest) ? dot(ray.from + ray.along * nearest - camera.eye, camera.forward) : INFINITY;
  if (const auto mark = d_->mark_at(pixel, depth)) {
    result.item = mark->item;
    result.segment = mark->segment;
    d_->put_on_its_section(*mark, pixel, &result);
  } else if (const Id plane = d_->frame_at(pixel)) {
    result.on_frame = true;
    result.on_plane = false;
    result.plane = plane;
    result.item = {.kind = Item::Kind::kSection, .id = plane};
  }
  return result;
}

survey::IndexPoint SceneView::index_at(const render::Vec3& scene) const {
  const render::SceneFrame& frame = *d_->drawing.frame();
  const survey::Geometry& g = frame.geometry();
  // The frame is an affine map of index space: solve for the three indices.
  const Vec3 zero = frame.scene_of(survey::IndexPoint{0, 0, 0});
  const Vec3 a = frame.scene_of(survey::IndexPoint{1, 0, 0}) - zero;
  const Vec3 b = frame.scene_of(survey::IndexPoint{0, 1, 0}) - zero;
  const Vec3 c = frame.scene_of(survey::IndexPoint{0, 0, 1}) - zero;
  const Vec3 p = scene - zero;
  const double det = dot(a, cross(b, c));
  const auto limited = [](double value, std::int64_t count) {
    return std::clamp(value, -0.5, static_cast<double>(count) - 0.5);
  };
  return {limited(dot(p, cross(b, c)) / det, g.inlines.count),
          limited(dot(p, cross(c, a)) / det, g.crosslines.count),
          limited(dot(p, cross(a, b)) / det, g.samples)};
}

std::optional<QPointF> SceneView::pixel_of(const survey::IndexPoint& place) const {
  QPointF at;
  if (!d_->drawing.frame() ||
      !project_to(d_->drawing.seen(), d_->size(), d_->drawing.frame()->scene_of(place), &at)) {
    return {};
  }
  return at;
}

Pointer SceneView::Private::pointer_of(const Under& under, const QPointF& pixel, Qt::MouseButton button,
                                       Qt::KeyboardModifiers modifiers, ulong time) const {
  Pointer pointer;
  pointer.x = pixel.x();
  pointer.y = pixel.y();
  pointer.place = under.place;
  pointer.modifiers = modifiers;
  pointer.button = button;
  pointer.time = std::chrono::milliseconds(time);
  if (under.item.kind != Item::Kind::kSection) pointer.under = under.item;
  pointer.segment = under.segment;
  if (pressed_on && drawing.frame()) {
    const auto hit = hit_on(*pressed_on, pixel);
    pointer.section = *pressed_on;
    pointer.on_section = hit.has_value();
    if (hit) pointer.place = index_of(*pressed_on, hit->at);
    return pointer;
  }
  pointer.on_frame = under.on_frame;
  for (const Display::ShownSection& shown : workbench.display.sections()) {
    if (shown.id != under.plane || under.plane == 0) continue;
    pointer.section = shown.section;
    pointer.on_section = under.on_plane;
  }
  return pointer;
}

}  // namespace footwall::ui
