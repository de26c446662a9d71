// Box and lasso in the scene: what they hold of the pillars and faults that are shown.
#include <algorithm>
#include <cmath>

#include "ui/model/fault_commands.h"
#include "ui/scene3d/scene_private.h"

namespace footwall::ui {
namespace {

using render::Vec3;

// Share of the distance by which a node may lie behind a surface and be seen: as for the mouse.
constexpr double kBehind = 0.01;
// Of a surface without pillars: corners that are looked at, and of these such that are looked for behind
// others.
constexpr std::size_t kCorners = 20'000;
constexpr std::size_t kSeenCorners = 50;

}  // namespace

void SceneView::Private::extend_selecting(const QPointF& at) {
  if (lasso) {
    if (selecting.isEmpty()) selecting << pressed_at;
    selecting << at;
  } else {
    selecting = QPolygonF(QRectF(pressed_at, at).normalized());
  }
  drawing.set_selecting(selecting);
  view.update();
}

void SceneView::Private::stop_selecting() {
  selecting.clear();
  drawing.set_selecting(selecting);
  view.update();
}

double SceneView::Private::depth_at(const QPointF& pixel, const render::Camera& camera) const {
  const render::SceneFrame& frame = *drawing.frame();
  const Ray ray = drawing.camera.ray(pixel, size());
  double nearest = INFINITY;
  for (const Display::ShownSection& shown : workbench.display.sections()) {
    if (!shown.in_scene) continue;
    const auto hit = hit_of(ray, place_of(shown.section, frame), size_of(shown.section, frame.geometry()));
    if (hit) nearest = std::min(nearest, hit->distance);
  }
  const double heights = drawing.heights();
  const Ray flat{{ray.from.x, ray.from.y, ray.from.z / heights},
                 {ray.along.x, ray.along.y, ray.along.z / heights}};
  for (const Id fault : drawing.shown_faults()) {
    const FaultGeometry* mesh = drawing.geometry(fault);
    if (mesh == nullptr || mesh->face_count() == 0) continue;
    if (!entry_of(flat, render::Vec3f(mesh->bounds().lo), render::Vec3f(mesh->bounds().hi), nearest))
      continue;
    if (const auto hit = mesh->tree().first_hit(flat, nearest)) nearest = hit->distance;
  }
  if (!std::isfinite(nearest)) return nearest;
  return dot(ray.from + ray.along * nearest - camera.eye, camera.forward);
}

// A fault whose pillars all lie in the region counts as a whole, and so does one without pillars whose
// surface does, but for the one of unassigned pillars, which is none; a pillar whose nodes all do, as a
// pillar; else single nodes. Of what nothing is seen, because it is behind something or beside the picture,
// nothing is selected: one node that is seen is enough, and no more are looked at.
void SceneView::Private::select_within(const QPolygonF& region, bool extend) {
  if (!drawing.frame()) return;
  const render::Camera camera = drawing.seen();
  const QRectF box = region.boundingRect();
  const double heights = drawing.heights();
  struct Inside {
    Id node = 0;
    QPointF pixel;
    double depth = 0;
  };
  const auto is_seen = [&](const Inside& one) {
    return view.rect().contains(one.pixel.toPoint()) &&
           one.depth <= depth_at(one.pixel, camera) * (1 + kBehind);
  };
  const auto look_at = [&](const Vec3& flat) -> std::optional<Inside> {
    const Vec3 at{flat.x, flat.y, flat.z * heights};
    QPointF pixel;
    if (!project_to(camera, size(), at, &pixel) || !box.contains(pixel)) return std::nullopt;
    if (!region.containsPoint(pixel, Qt::OddEvenFill)) return std::nullopt;
    return Inside{0, pixel, dot(at - camera.eye, camera.forward)};
  };
  const auto holds = [&](const FaultGeometry& mesh) {
    const auto& corners = mesh.positions();
    std::vector<Inside> inside;
    for (std::size_t n = 0; n < corners.size(); n += 1 + corners.size() / kCorners) {
      const auto one = look_at({corners[n].x, corners[n].y, corners[n].z});
      if (!one) return false;
      inside.push_back(*one);
    }
    for (std::size_t n = 0; n < inside.size(); n += 1 + inside.size() / kSeenCorners) {
      if (is_seen(inside[n])) return true;
    }
    return false;
  };
  const auto inside_of = [&](const survey::Pillar& pillar) {
    std::vector<Inside> inside;
    for (const survey::PillarNode& node : pillar.nodes) {
      auto one = look_at(drawing.flat_of(node.position));
      if (!one) continue;
      one->node = node.id;
      inside.push_back(*one);
    }
    return inside;
  };
  std::set<Id> faults, pillars, nodes;
  for (const Fault& fault : workbench.document.faults()) {
    if (!workbench.display.is_visible({.kind = Item::Kind::kFault, .id = fault.record.id})) continue;
    // 1 What lies inside; most faults end here.
    std::vector<std::pair<const survey::Pillar*, std::vector<Inside>>> inside;
    std::size_t count = 0, whole = 0;
    for (const survey::Pillar& pillar : workbench.document.shown_pillars(fault.record.id)) {
      if (pillar.nodes.empty()) continue;
      ++count;
      auto of = inside_of(pillar);
      if (of.size() == pillar.nodes.size()) ++whole;
      if (!of.empty()) inside.emplace_back(&pillar, std::move(of));
    }
    if (const FaultGeometry* mesh = drawing.geometry(fault.record.id);
        count == 0 && mesh != nullptr && mesh->face_count() > 0 && holds(*mesh)) {
      faults.insert(fault.record.id);
    }
    // 2 What of it is seen.
    if (count > 1 && whole == count && !is_unassigned(fault)) {
      const bool seen = std::ranges::any_of(
          inside, [&](const auto& one) { return std::ranges::any_of(one.second, is_seen); });
      if (seen) faults.insert(fault.record.id);
      continue;
    }
    for (const auto& [pillar, of] : inside) {
      if (of.size() == pillar->nodes.size()) {
        if (std::ranges::any_of(of, is_seen)) pillars.insert(pillar->id);
        continue;
      }
      for (const Inside& one : of) {
        if (is_seen(one)) nodes.insert(one.node);
      }
    }
  }
  Selection& selection = workbench.selection;
  if (lasso && !extend)
    return selection.select_by_lasso(std::move(faults), std::move(pillars), std::move(nodes));
  selection.select_all(std::move(faults), std::move(pillars), std::move(nodes), extend);
}

}  // namespace footwall::ui
