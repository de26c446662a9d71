#include "ui/section/fault_shapes.h"

#include <QLineF>
#include <algorithm>
#include <cmath>
#include <limits>

namespace footwall::ui {
namespace {

constexpr double kNodeReach = 11;  // pixels
constexpr double kPillarReach = 6;

double distance_to(const QLineF& line, const QPointF& p) {
  const QPointF along = line.p2() - line.p1();
  const double square = QPointF::dotProduct(along, along);
  const double part =
      square > 0 ? std::clamp(QPointF::dotProduct(p - line.p1(), along) / square, 0.0, 1.0) : 0;
  const QPointF off = p - (line.p1() + part * along);
  return std::hypot(off.x(), off.y());
}

QLineF line_of(const PlanePoint& a, const PlanePoint& b, const ViewTransform& view) {
  return {view.to_pixels(a), view.to_pixels(b)};
}

}  // namespace

void FaultShapes::set_section(const Section& section) {
  if (section == section_) return;
  section_ = section;
  shapes_.clear();
}

void FaultShapes::forget(const std::set<Id>& faults) {
  for (const Id fault : faults) shapes_.erase(fault);
}

bool FaultShapes::has_other_surface(Id fault) const {
  const auto known = shapes_.find(fault);
  return known == shapes_.end() || known->second.surface != bench_.surfaces.surface(fault);
}

const ShapedFault& FaultShapes::of(Id fault) {
  const auto [place, is_new] = shapes_.try_emplace(fault);
  ShapedFault& shape = place->second;
  const auto surface = bench_.surfaces.surface(fault);
  if (surface != shape.surface) {
    shape.surface = surface;
    shape.cut.clear();
    shape.lines.clear();
    if (surface) shape.cut = mesh_cut(section_, surface->places, surface->faces);
    shape.lines = joined(shape.cut);
  }
  if (!is_new || !bench_.document.survey()) return shape;
  const survey::Geometry& survey = *bench_.document.survey();
  for (const survey::Pillar& pillar : bench_.document.shown_pillars(fault)) {
    ShapedPillar shaped{pillar.id, pillar.kind, {}};
    shaped.nodes.reserve(pillar.nodes.size());
    for (const survey::PillarNode& node : pillar.nodes) {
      const survey::IndexPoint p = survey.index_of(node.position);
      shaped.nodes.push_back({node.id, plane_of(section_, p), distance_from(section_, p)});
    }
    shape.pillars.push_back(std::move(shaped));
  }
  return shape;
}

FaultShapes::Hit FaultShapes::hit(const QPointF& mouse, const ViewTransform& view) {
  Hit node, pillar, cut;
  double nearest_node = kNodeReach, nearest_pillar = kPillarReach, nearest_cut = kPillarReach;
  const auto is_nearer = [](double distance, double& nearest) {
    if (!(distance <= nearest)) return false;
    nearest = distance;
    return true;
  };
  for (const Fault& fault : bench_.document.faults()) {
    const Id id = fault.record.id;
    if (!bench_.display.is_visible({.kind = Item::Kind::kFault, .id = id})) continue;
    const ShapedFault& shape = of(id);
    for (const ShapedPillar& one : shape.pillars) {
      for (std::size_t n = 0; n < one.nodes.size(); ++n) {
        const ShapedNode& here = one.nodes[n];
        if (!here.on_section()) continue;
        if (is_nearer(QLineF(view.to_pixels(here.at), mouse).length(), nearest_node)) {
          node = {{.kind = Item::Kind::kNode, .id = here.id}, static_cast<int>(n)};
        }
        if (n + 1 < one.nodes.size() && one.nodes[n + 1].on_section() &&
            is_nearer(distance_to(line_of(here.at, one.nodes[n + 1].at, view), mouse), nearest_pillar)) {
          pillar = {{.kind = Item::Kind::kPillar, .id = one.id}, static_cast<int>(n)};
        }
      }
    }
    for (const CutSegment& segment : shape.cut) {
      if (is_nearer(distance_to(line_of(segment[0], segment[1], view), mouse), nearest_cut)) {
        const project::MeshFace& face = shape.surface->faces[segment.face];
        cut = {{.kind = Item::Kind::kFace, .id = id, .panel = face.panel, .number = face.n}, -1};
      }
    }
  }
  return node.item ? node : pillar.item ? pillar : cut;
}

}  // namespace footwall::ui
