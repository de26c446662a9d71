#include "ui/model/accept_shift.h"

#include <QCoreApplication>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace footwall::ui {
namespace {

using survey::IndexPoint;
using survey::WorldPoint;

constexpr double kOnPillar = 1e-6;  // voxels

QString tr(const char* text) {
  return QCoreApplication::translate("footwall::ui", text);
}

IndexPoint between(const IndexPoint& a, const IndexPoint& b, double part) {
  return {a.i + part * (b.i - a.i), a.j + part * (b.j - a.j), a.k + part * (b.k - a.k)};
}

double distance(const IndexPoint& a, const IndexPoint& b) {
  return std::hypot(a.i - b.i, a.j - b.j, a.k - b.k);
}

// Of the winding, in index space; zero for a triangle without area.
IndexPoint unit_normal(const FaultSurface& surface, std::size_t face) {
  const survey::LatticeTriangle& t = surface.lattice[face];
  const auto edge = [&](std::size_t to) {
    return std::array{static_cast<double>(t[to].i) - t[0].i, static_cast<double>(t[to].j) - t[0].j,
                      static_cast<double>(t[to].k) - t[0].k};
  };
  const auto a = edge(1), b = edge(2);
  const IndexPoint n{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  const double length = std::hypot(n.i, n.j, n.k);
  return length > 0 ? IndexPoint{n.i / length, n.j / length, n.k / length} : IndexPoint{};
}

IndexPoint middle_of(const FaultSurface& surface, std::size_t face) {
  IndexPoint middle;
  for (const std::int32_t vertex : surface.faces[face].vertices) {
    const IndexPoint& corner = surface.places[static_cast<std::size_t>(vertex)];
    middle = {middle.i + corner.i / 3, middle.j + corner.j / 3, middle.k + corner.k / 3};
  }
  return middle;
}

// Finite, of the face as it stands, and of enough samples.
bool is_good(const FaceNumbers& offsets, std::size_t face) {
  const auto is_set = [face](const std::vector<std::uint8_t>& flags) {
    return face < flags.size() && flags[face] != 0;
  };
  return face < offsets.values.size() && std::isfinite(offsets.values[face]) && !is_set(offsets.stale) &&
         !is_set(offsets.hatched);
}

WorldPoint moved_by(const survey::Geometry& survey, const WorldPoint& node, const IndexPoint& by) {
  const WorldPoint zero = survey.world_of({0, 0, 0});
  const WorldPoint to = survey.world_of(by);
  return {node.x + to.x - zero.x, node.y + to.y - zero.y, node.z + to.z - zero.z};
}

// The point of a pillar nearest to a place: between nodes `first` and `first` + 1, or at a pillar's only
// node.
struct Foot {
  std::size_t first = 0;
  double part = 0;
  double away = 0;
};

Foot foot_on(const std::vector<IndexPoint>& line, const IndexPoint& place) {
  Foot best{0, 0, distance(line.front(), place)};
  for (std::size_t n = 0; n + 1 < line.size(); ++n) {
    const IndexPoint along{line[n + 1].i - line[n].i, line[n + 1].j - line[n].j, line[n + 1].k - line[n].k};
    const double square = along.i * along.i + along.j * along.j + along.k * along.k;
    const double reach =
        along.i * (place.i - line[n].i) + along.j * (place.j - line[n].j) + along.k * (place.k - line[n].k);
    const double part = square > 0 ? std::clamp(reach / square, 0.0, 1.0) : 0;
    const double away = distance(between(line[n], line[n + 1], part), place);
    if (away < best.away) best = {n, part, away};
  }
  return best;
}

std::vector<IndexPoint> line_of(const survey::Geometry& survey, const survey::Pillar& pillar) {
  std::vector<IndexPoint> line;
  for (const survey::PillarNode& node : pillar.nodes) line.push_back(survey.index_of(node.position));
  return line;
}

std::set<Id> pillars_around(const FaultSurface& surface, Id panel) {
  std::set<Id> pillars;
  for (const project::MeshFace& face : surface.faces) {
    if (face.panel != panel) continue;
    for (const std::int32_t vertex : face.vertices) {
      const auto place = static_cast<std::size_t>(vertex);
      if (place < surface.pillars.size() && surface.pillars[place] != 0)
        pillars.insert(surface.pillars[place]);
    }
  }
  return pillars;
}

std::size_t number_of(const FaultSurface& surface, const Item& face) {
  const auto found = std::ranges::find_if(surface.faces, [&](const project::MeshFace& one) {
    return one.panel == face.panel && one.n == face.number;
  });
  return static_cast<std::size_t>(found - surface.faces.begin());
}

}  // namespace

std::optional<Shift> shift_of_face(const survey::Geometry& survey, const std::vector<survey::Pillar>& pillars,
                                   const FaultSurface& surface, const FaceNumbers& offsets,
                                   std::size_t face) {
  if (face >= surface.faces.size() || !is_good(offsets, face) || offsets.values[face] == 0)
    return std::nullopt;
  const std::set<Id> around = pillars_around(surface, surface.faces[face].panel);
  const IndexPoint middle = middle_of(surface, face);
  struct Weighted {
    const survey::Pillar* pillar;
    Foot foot;
    double weight;
  };
  std::vector<Weighted> feet;
  for (const survey::Pillar& pillar : pillars) {
    if (!around.contains(pillar.id) || pillar.nodes.empty()) continue;
    const Foot foot = foot_on(line_of(survey, pillar), middle);
    feet.push_back({&pillar, foot, 1 / std::max(foot.away, kOnPillar)});
  }
  double sum = 0;
  for (const Weighted& one : feet) sum += one.weight;
  std::map<Id, std::pair<const survey::PillarNode*, double>> weights;
  for (const Weighted& one : feet) {
    const auto add = [&](std::size_t node, double share) {
      if (node >= one.pillar->nodes.size() || share == 0) return;
      const survey::PillarNode& at = one.pillar->nodes[node];
      weights[at.id] = {&at, one.weight / sum * share};
    };
    add(one.foot.first, 1 - one.foot.part);
    add(one.foot.first + 1, one.foot.part);
  }
  if (weights.empty()) return std::nullopt;
  double squares = 0;
  for (const auto& [id, one] : weights) squares += one.second * one.second;
  Shift shift;
  shift.voxels = offsets.values[face];
  const IndexPoint normal = unit_normal(surface, face);
  for (const auto& [id, one] : weights) {
    const double by = shift.voxels * surface.side * one.second / squares;
    shift.moved[id] = moved_by(survey, one.first->position, {by * normal.i, by * normal.j, by * normal.k});
  }
  return shift;
}

std::optional<Shift> shift_of_pillar(const survey::Geometry& survey, const survey::Pillar& pillar,
                                     const FaultSurface& surface, const FaceNumbers& offsets) {
  if (pillar.nodes.empty()) return std::nullopt;
  const std::vector<IndexPoint> line = line_of(survey, pillar);
  // 1 The faces that touch the pillar, by the node that they touch it nearest to.
  std::vector<std::set<std::size_t>> near(line.size());
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    if (!is_good(offsets, f)) continue;
    for (const std::int32_t vertex : surface.faces[f].vertices) {
      const auto place = static_cast<std::size_t>(vertex);
      if (place >= surface.pillars.size() || surface.pillars[place] != pillar.id) continue;
      const auto nearest = std::ranges::min_element(
          line, {}, [&](const IndexPoint& p) { return distance(p, surface.places[place]); });
      near[static_cast<std::size_t>(nearest - line.begin())].insert(f);
    }
  }
  // 2 Their mean offset along their mean normal.
  Shift shift;
  for (std::size_t n = 0; n < line.size(); ++n) {
    IndexPoint normal;
    double offset = 0;
    for (const std::size_t face : near[n]) {
      const IndexPoint one = unit_normal(surface, face);
      normal = {normal.i + one.i, normal.j + one.j, normal.k + one.k};
      offset += offsets.values[face] / static_cast<double>(near[n].size());
    }
    const double length = std::hypot(normal.i, normal.j, normal.k);
    if (!(length > 0) || offset == 0) continue;
    const double by = offset * surface.side / length;
    const survey::PillarNode& node = pillar.nodes[n];
    shift.moved[node.id] = moved_by(survey, node.position, {by * normal.i, by * normal.j, by * normal.k});
    if (std::abs(offset) > std::abs(shift.voxels)) shift.voxels = offset;
  }
  return shift.moved.empty() ? std::nullopt : std::optional(std::move(shift));
}

std::optional<Shift> suggested_shift(const Document& document, const Surfaces& surfaces,
                                     const Selection& selection, QString* why) {
  const auto say = [why](const QString& text) {
    if (why != nullptr) *why = text;
    return std::nullopt;
  };
  const auto& survey = document.survey();
  const Item& now = selection.current();
  const bool is_face = now.kind == Item::Kind::kFace;
  if (!survey || (!is_face && selection.pillars().empty())) return say({});
  const QString unknown =
      tr("no shift is known here yet: offsets come from the engine while nothing else is to be done");
  if (is_face) {
    const Fault* fault = document.fault(now.id);
    const auto surface = surfaces.surface(now.id);
    const auto offsets = surfaces.numbers(now.id, QStringLiteral("offset_voxels"));
    if (fault == nullptr || !surface || !offsets) return say(unknown);
    if (fault->pillars.empty()) return say(tr("an imported surface has no pillars that could be moved"));
    const std::size_t face = number_of(*surface, now);
    auto shift = shift_of_face(*survey, fault->pillars, *surface, *offsets, face);
    if (shift) return shift;
    const bool good = is_good(*offsets, face);
    return say(good && offsets->values[face] == 0 ? tr("this face sits on the fault already") : unknown);
  }
  Shift all;
  bool any_known = false;
  for (const Id id : selection.pillars()) {
    const survey::Pillar* pillar = document.pillar(id);
    const Fault* fault = document.fault_of_pillar(id);
    if (pillar == nullptr || fault == nullptr) continue;
    const auto surface = surfaces.surface(fault->record.id);
    const auto offsets = surfaces.numbers(fault->record.id, QStringLiteral("offset_voxels"));
    if (!surface || !offsets) continue;
    any_known = true;
    const auto shift = shift_of_pillar(*survey, *pillar, *surface, *offsets);
    if (!shift) continue;
    all.moved.insert(shift->moved.begin(), shift->moved.end());
    if (std::abs(shift->voxels) > std::abs(all.voxels)) all.voxels = shift->voxels;
  }
  if (!all.moved.empty()) return all;
  return say(any_known ? tr("the faces around say of no node where it should go") : unknown);
}

QString shift_hint(const Document& document, const Surfaces& surfaces, const Selection& selection) {
  const auto shift = suggested_shift(document, surfaces, selection, nullptr);
  if (!shift || document.read_only()) return {};
  const Fault* fault = document.fault(selection.active_fault());
  if (fault != nullptr && fault->record.locked) return {};
  const QString voxels = QString::number(shift->voxels, 'g', 2);
  const Item& now = selection.current();
  if (now.kind != Item::Kind::kFace) {
    return tr("Enter moves %1 nodes along the normal, by %2 voxels at most")
        .arg(shift->moved.size())
        .arg(voxels);
  }
  const auto metres = surfaces.numbers(now.id, QStringLiteral("offset"));
  const std::size_t face = number_of(*surfaces.surface(now.id), now);
  const bool metric = metres && face < metres->values.size() && std::isfinite(metres->values[face]);
  return metric ? tr("Enter moves this face by %1 m (%2 voxels) along the normal")
                      .arg(metres->values[face], 0, 'f', 1)
                      .arg(voxels)
                : tr("Enter moves this face by %1 voxels along the normal").arg(voxels);
}

bool accept_shift(Document& document, const Surfaces& surfaces, const Selection& selection) {
  if (document.read_only()) {
    Q_EMIT document.failed(tr("read-only: somebody else writes this project"), {});
    return false;
  }
  QString why;
  const auto shift = suggested_shift(document, surfaces, selection, &why);
  if (!shift) {
    Q_EMIT document.failed(why.isEmpty() ? tr("select a face or a pillar first") : why, {});
    return false;
  }
  std::set<Id> faults;
  for (const auto& [node, to] : shift->moved) faults.insert(document.fault_of_node(node)->record.id);
  const QString name =
      faults.size() == 1
          ? tr("Accept shift (%1)").arg(QString::fromStdString(document.fault(*faults.begin())->record.name))
          : tr("Accept shift");
  return document.edit(name, [&](project::Interpretation& now) {
    for (const auto& [node, to] : shift->moved) now.move_node(node, to);
  });
}

}  // namespace footwall::ui
