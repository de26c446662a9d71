#include "ui/model/fault_commands.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "storage/project/fault_colours.h"

namespace footwall::ui {
namespace {

using survey::WorldPoint;

constexpr double kMetreAMillisecond = 2000;  // m/s
constexpr double kMostGaps = 9999;           // of a resampled pillar

QString tr(const char* text) {
  return QCoreApplication::translate("footwall::ui", text);
}

QString name_of(const Document& document, Id fault) {
  const Fault* found = document.fault(fault);
  return found == nullptr ? QString() : QString::fromStdString(found->record.name);
}

// "Delete pillar", or "Delete 3 pillars".
QString counted(const char* one, const char* several, std::size_t count) {
  return count == 1 ? tr(one) : tr(several).arg(count);
}

std::vector<WorldPoint> positions_of(const survey::Pillar& pillar) {
  std::vector<WorldPoint> positions;
  for (const survey::PillarNode& node : pillar.nodes) positions.push_back(node.position);
  return positions;
}

WorldPoint between(const WorldPoint& a, const WorldPoint& b, double part) {
  return {a.x + part * (b.x - a.x), a.y + part * (b.y - a.y), a.z + part * (b.z - a.z)};
}

double distance(const WorldPoint& a, const WorldPoint& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

std::vector<WorldPoint> smoothed(const std::vector<WorldPoint>& nodes) {
  std::vector<WorldPoint> result = nodes;
  for (std::size_t n = 1; n + 1 < nodes.size(); ++n) {
    result[n] = between(nodes[n], between(nodes[n - 1], nodes[n + 1], 0.5), 1.0 / 3);
  }
  return result;
}

// `count` nodes at even lengths by `metric`.
template <class Length>
std::vector<WorldPoint> resampled(const std::vector<WorldPoint>& nodes, int count, const Length& metric) {
  std::vector<double> along{0};
  for (std::size_t n = 1; n < nodes.size(); ++n)
    along.push_back(along.back() + metric(nodes[n - 1], nodes[n]));
  std::vector<WorldPoint> result;
  std::size_t segment = 0;
  for (int n = 0; n < count; ++n) {
    const double wanted = along.back() * n / (count - 1);
    while (segment + 2 < nodes.size() && along[segment + 1] < wanted) ++segment;
    const double length = along[segment + 1] - along[segment];
    result.push_back(
        between(nodes[segment], nodes[segment + 1], length > 0 ? (wanted - along[segment]) / length : 0));
  }
  result.front() = nodes.front();
  result.back() = nodes.back();
  return result;
}

// World positions in metres each way: for lengths that heights take part in.
struct Metres {
  double horizontal = 1, vertical = 1;
  WorldPoint operator()(const WorldPoint& p) const {
    return {horizontal * p.x, horizontal * p.y, vertical * p.z};
  }
};

// Heights of a time survey by half the project's velocity. Unset without a survey, or (told) where the
// project cannot be read.
std::optional<Metres> metres_of(Document& document) {
  if (!document.survey()) return std::nullopt;
  double velocity = kMetreAMillisecond;
  try {
    const auto stored = document.project().setting("velocity");
    const double known = stored ? QString::fromStdString(*stored).toDouble() : 0;
    if (known > 0 && std::isfinite(known)) velocity = known;
  } catch (const Error& error) {
    Q_EMIT document.failed(QString::fromStdString(error.message()), QString::fromStdString(error.hint()));
    return std::nullopt;
  }
  return Metres{document.survey()->horizontal_metres(1), document.survey()->vertical_metres(1, velocity)};
}

// The nodes' ids in the order of their feet on the line between the pillar's ends. An end: the node farthest
// from the first; the other: the node farthest from that one.
std::vector<Id> from_end_to_end(const std::vector<survey::PillarNode>& nodes, const Metres& metres) {
  const auto farthest_from = [&](const WorldPoint& from) {
    return metres(std::ranges::max(nodes, {}, [&](const survey::PillarNode& node) {
                    return distance(metres(node.position), from);
                  }).position);
  };
  const WorldPoint last = farthest_from(metres(nodes.front().position)), first = farthest_from(last);
  const WorldPoint way{last.x - first.x, last.y - first.y, last.z - first.z};
  std::vector<std::pair<double, Id>> along;
  for (const survey::PillarNode& node : nodes) {
    const WorldPoint p = metres(node.position);
    along.emplace_back((p.x - first.x) * way.x + (p.y - first.y) * way.y + (p.z - first.z) * way.z, node.id);
  }
  std::ranges::stable_sort(along, {}, &std::pair<double, Id>::first);
  std::vector<Id> order;
  order.reserve(along.size());
  for (const auto& [foot, id] : along) order.push_back(id);
  return order;
}

// Each pillar's nodes put through `change`, as one edit.
bool reshape(Document& document, const QString& name, const std::set<Id>& pillars,
             const std::function<std::vector<WorldPoint>(const std::vector<WorldPoint>&)>& change) {
  return document.edit(name, [&](project::Interpretation& now) {
    for (const Id pillar : pillars) {
      const std::vector<WorldPoint> before = positions_of(now.pillar(pillar));
      const std::vector<WorldPoint> after = change(before);
      if (after != before) now.set_nodes(pillar, after);
    }
  });
}

// A fault with a free name and colour, and what else is to happen to it, as one edit; 0: refused. words: of
// the history, with a place for the name.
Id make_fault(Document& document, const QString& words,
              const std::function<void(project::Interpretation&, Id)>& then) {
  const QString name = next_fault_name(document);
  const QString colour = next_fault_colour(document);
  Id made = 0;
  document.edit(words.arg(name), [&](project::Interpretation& now) {
    made = now.add_fault(name.toStdString());
    now.set_fault_property(made, "colour", colour.toStdString());
    then(now, made);
  });
  return document.fault(made) == nullptr ? 0 : made;
}

// What a transform moves: nodes by pillar, each node once.
std::map<Id, std::set<Id>> nodes_of(const Document& document, const std::set<Id>& faults,
                                    const std::set<Id>& pillars, const std::set<Id>& nodes) {
  std::map<Id, std::set<Id>> chosen;
  for (const Fault& fault : document.faults()) {
    for (const survey::Pillar& pillar : fault.pillars) {
      const bool whole = faults.contains(fault.record.id) || pillars.contains(pillar.id);
      // An interpolated pillar follows its parents; moved with its fault it must not become the interpreter's
      // own.
      if (faults.contains(fault.record.id) && !pillars.contains(pillar.id) &&
          pillar.kind == survey::PillarKind::kInterpolated) {
        continue;
      }
      for (const survey::PillarNode& node : pillar.nodes) {
        if (whole || nodes.contains(node.id)) chosen[pillar.id].insert(node.id);
      }
    }
  }
  return chosen;
}

}  // namespace

bool is_unassigned(const Fault& fault) {
  return fault.record.name == kUnassigned;
}

QString next_fault_name(const Document& document) {
  for (int n = 1;; ++n) {
    QString name = QStringLiteral("F%1").arg(n);
    const bool taken = std::ranges::any_of(
        document.faults(), [&](const Fault& fault) { return fault.record.name == name.toStdString(); });
    if (!taken) return name;
  }
}

QString next_fault_colour(const Document& document) {
  std::vector<project::FaultRecord> records;
  for (const Fault& fault : document.faults()) records.push_back(fault.record);
  return QString::fromStdString(project::FaultColours(records).next());
}

Id new_fault(Document& document) {
  return make_fault(document, tr("New fault %1"), [](project::Interpretation&, Id) {});
}

bool rename_fault(Document& document, Id fault, const QString& name) {
  return document.edit(
      tr("Rename %1 to %2").arg(name_of(document, fault), name),
      [&](project::Interpretation& now) { now.rename_fault(fault, name.trimmed().toStdString()); });
}

bool set_fault_colour(Document& document, const std::set<Id>& faults, const QString& colour) {
  return document.edit(counted("Colour of a fault", "Colour of %1 faults", faults.size()),
                       [&](project::Interpretation& now) {
                         for (const Id fault : faults)
                           now.set_fault_property(fault, "colour", colour.toStdString());
                       });
}

bool lock_faults(Document& document, const std::set<Id>& faults, bool locked) {
  const QString name = locked ? counted("Lock fault", "Lock %1 faults", faults.size())
                              : counted("Unlock fault", "Unlock %1 faults", faults.size());
  return document.edit(name, [&](project::Interpretation& now) {
    for (const Id fault : faults) now.set_fault_property(fault, "locked", locked ? "true" : "false");
  });
}

bool delete_items(Document& document, const std::set<Id>& faults, const std::set<Id>& pillars,
                  const std::set<Id>& nodes) {
  if (faults.empty() && pillars.empty() && nodes.empty()) return false;
  const QString name = !faults.empty()    ? counted("Delete fault", "Delete %1 faults", faults.size())
                       : !pillars.empty() ? counted("Delete pillar", "Delete %1 pillars", pillars.size())
                                          : counted("Delete node", "Delete %1 nodes", nodes.size());
  return document.edit(name, [&](project::Interpretation& now) {
    // Nodes first, then pillars, then faults: what is chosen twice is there when its turn comes. A pillar
    // goes with its last node, its interpolated children with it.
    std::map<Id, std::size_t> left;
    std::set<Id> emptied;
    for (const Id node : nodes) {
      const Id pillar = now.pillar_of_node(node);
      if (pillars.contains(pillar) || faults.contains(now.fault_of_pillar(pillar))) continue;
      if (!left.contains(pillar)) left[pillar] = now.pillar(pillar).nodes.size();
      if (--left[pillar] == 0) {
        emptied.insert(pillar);
      } else {
        now.delete_node(node);
      }
    }
    emptied.insert(pillars.begin(), pillars.end());
    std::set<Id> gone;
    for (const Id pillar : emptied) {
      if (gone.contains(pillar) || faults.contains(now.fault_of_pillar(pillar))) continue;
      for (const survey::Pillar& other : now.pillars(now.fault_of_pillar(pillar))) {
        if (other.parent_a == pillar || other.parent_b == pillar) gone.insert(other.id);
      }
      now.delete_pillar(pillar);
    }
    for (const Id fault : faults) now.delete_fault(fault);
  });
}

bool merge_faults(Document& document, Id into, const std::set<Id>& others) {
  return document.edit(tr("Merge into %1").arg(name_of(document, into)), [&](project::Interpretation& now) {
    for (const Id other : others) {
      if (other == into) continue;
      std::vector<Id> pillars;
      for (const survey::Pillar& pillar : now.pillars(other)) pillars.push_back(pillar.id);
      now.assign_pillars(pillars, into);
      now.delete_fault(other);
    }
  });
}

Id split_fault(Document& document, const std::set<Id>& pillars) {
  if (pillars.empty()) return 0;
  return make_fault(document, tr("Split off %1"), [&](project::Interpretation& now, Id made) {
    now.assign_pillars(std::vector<Id>(pillars.begin(), pillars.end()), made);
  });
}

bool assign_pillars(Document& document, const std::set<Id>& pillars, Id fault) {
  const QString name = pillars.size() == 1
                           ? tr("Move pillar to %1").arg(name_of(document, fault))
                           : tr("Move %1 pillars to %2").arg(pillars.size()).arg(name_of(document, fault));
  return document.edit(name, [&](project::Interpretation& now) {
    now.assign_pillars(std::vector<Id>(pillars.begin(), pillars.end()), fault);
  });
}

bool reverse_pillars(Document& document, const std::set<Id>& pillars) {
  return document.edit(counted("Reverse pillar", "Reverse %1 pillars", pillars.size()),
                       [&](project::Interpretation& now) {
                         for (const Id pillar : pillars) now.reverse_pillar(pillar);
                       });
}

bool reorder_pillars(Document& document, const std::set<Id>& pillars) {
  const std::optional<Metres> metres = metres_of(document);
  if (!metres) return false;
  std::map<Id, std::vector<Id>> orders;
  for (const Id id : pillars) {
    const survey::Pillar* pillar = document.pillar(id);
    if (pillar == nullptr) continue;
    std::vector<Id> order = from_end_to_end(pillar->nodes, *metres);
    if (!std::ranges::equal(order, pillar->nodes, {}, {}, &survey::PillarNode::id))
      orders[id] = std::move(order);
  }
  if (orders.empty()) return false;
  return document.edit(counted("Reorder nodes of a pillar", "Reorder nodes of %1 pillars", orders.size()),
                       [&](project::Interpretation& now) {
                         for (const auto& [id, order] : orders) now.reorder_nodes(id, order);
                       });
}

bool smooth_pillars(Document& document, const std::set<Id>& pillars) {
  return reshape(document, counted("Smooth pillar", "Smooth %1 pillars", pillars.size()), pillars, smoothed);
}

bool resample_pillars(Document& document, const std::set<Id>& pillars, int nodes) {
  if (nodes < 2) return false;
  return reshape(document, counted("Resample pillar", "Resample %1 pillars", pillars.size()), pillars,
                 [nodes](const std::vector<WorldPoint>& before) {
                   return before.size() < 2 ? before : resampled(before, nodes, distance);
                 });
}

bool resample_by_spacing(Document& document, const std::set<Id>& pillars, double metres) {
  const std::optional<Metres> scale = metres_of(document);
  if (!(metres > 0) || !scale) return false;
  const auto metric = [&](const WorldPoint& a, const WorldPoint& b) {
    return distance((*scale)(a), (*scale)(b));
  };
  return reshape(document, counted("Resample pillar", "Resample %1 pillars", pillars.size()), pillars,
                 [&](const std::vector<WorldPoint>& before) {
                   if (before.size() < 2) return before;
                   double length = 0;
                   for (std::size_t n = 1; n < before.size(); ++n) length += metric(before[n - 1], before[n]);
                   const double gaps = std::clamp(std::round(length / metres), 1.0, kMostGaps);
                   return resampled(before, static_cast<int>(gaps) + 1, metric);
                 });
}

bool accept_pillars(Document& document, const std::set<Id>& pillars) {
  return document.edit(counted("Accept pillar", "Accept %1 pillars", pillars.size()),
                       [&](project::Interpretation& now) {
                         for (const Id pillar : pillars) {
                           if (now.pillar(pillar).kind == survey::PillarKind::kInterpolated)
                             now.accept_pillar(pillar);
                         }
                       });
}

std::map<Id, WorldPoint> transformed(const Document& document, const std::set<Id>& faults,
                                     const std::set<Id>& pillars, const std::set<Id>& nodes,
                                     const Transform& transform) {
  std::map<Id, WorldPoint> before;
  for (const auto& [pillar, chosen] : nodes_of(document, faults, pillars, nodes)) {
    for (const survey::PillarNode& node : document.pillar(pillar)->nodes) {
      if (chosen.contains(node.id)) before[node.id] = node.position;
    }
  }
  WorldPoint centre;
  if (transform.centre) {
    centre = *transform.centre;
  } else {
    double count = 0;
    for (const auto& [node, position] : before) centre = between(centre, position, 1 / ++count);
  }
  // Clockwise seen from above: from north (y) towards east (x).
  const double angle = transform.rotate_degrees * std::numbers::pi / 180;
  const double cosine = std::cos(angle);
  const double sine = std::sin(angle);
  const bool only_moves = transform.rotate_degrees == 0 && transform.scale == std::array<double, 3>{1, 1, 1};
  std::map<Id, WorldPoint> after;
  for (const auto& [node, p] : before) {
    const double x = p.x - centre.x;
    const double y = p.y - centre.y;
    const double z = p.z - centre.z;
    // A mere move is exact.
    after[node] = only_moves
                      ? WorldPoint{p.x + transform.move.x, p.y + transform.move.y, p.z + transform.move.z}
                      : WorldPoint{centre.x + transform.scale[0] * (cosine * x + sine * y) + transform.move.x,
                                   centre.y + transform.scale[1] * (cosine * y - sine * x) + transform.move.y,
                                   centre.z + transform.scale[2] * z + transform.move.z};
  }
  return after;
}

bool transform_items(Document& document, const std::set<Id>& faults, const std::set<Id>& pillars,
                     const std::set<Id>& nodes, const Transform& transform) {
  const std::map<Id, WorldPoint> moved = transformed(document, faults, pillars, nodes, transform);
  if (moved.empty()) return false;
  const bool only_moves = transform.rotate_degrees == 0 && transform.scale == std::array<double, 3>{1, 1, 1};
  return document.edit(only_moves ? tr("Move selection") : tr("Transform selection"),
                       [&](project::Interpretation& now) {
                         for (const auto& [node, to] : moved) now.move_node(node, to);
                       });
}

}  // namespace footwall::ui
