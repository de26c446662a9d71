// What the Fault menu does to what is selected: each one edit of the document, named for the history. Each
// returns false where the project refused (Document::failed has said why) or there was nothing to do.
#pragma once
#include <QString>
#include <array>
#include <map>
#include <optional>
#include <set>

#include "ui/model/document.h"

namespace footwall::ui {

// The pillars that belong to no fault yet live in a fault of this name, which is never triangulated.
inline constexpr const char* kUnassigned = "unassigned";
bool is_unassigned(const Fault& fault);

// A name not yet taken, "F1", "F2", ..., and a colour that differs from the others in lightness as well as
// hue.
QString next_fault_name(const Document& document);
QString next_fault_colour(const Document& document);

Id new_fault(Document& document);  // 0: refused
bool rename_fault(Document& document, Id fault, const QString& name);
bool set_fault_colour(Document& document, const std::set<Id>& faults, const QString& colour);
bool lock_faults(Document& document, const std::set<Id>& faults, bool locked);
bool delete_items(Document& document, const std::set<Id>& faults, const std::set<Id>& pillars,
                  const std::set<Id>& nodes);
bool merge_faults(Document& document, Id into, const std::set<Id>& others);
// The pillars form a new fault.
Id split_fault(Document& document, const std::set<Id>& pillars);
bool assign_pillars(Document& document, const std::set<Id>& pillars, Id fault);
bool reverse_pillars(Document& document, const std::set<Id>& pillars);
// Each pillar's nodes in the order in which they lie between its two ends, which are as far apart as any;
// from the end that is nearer to the node that was first. Lengths as in resample_by_spacing.
bool reorder_pillars(Document& document, const std::set<Id>& pillars);
// Each inner node a third of the way to the middle of its neighbours.
bool smooth_pillars(Document& document, const std::set<Id>& pillars);
// As many nodes, evenly spaced along each pillar.
bool resample_pillars(Document& document, const std::set<Id>& pillars, int nodes);
// Nodes evenly spaced along each pillar, as near to `metres` apart as whole gaps allow; its ends stay.
// Heights of a time survey by half the project's velocity; without one, 1 ms counts as 1 m, as it is drawn.
bool resample_by_spacing(Document& document, const std::set<Id>& pillars, double metres);
bool accept_pillars(Document& document, const std::set<Id>& pillars);

// Turned about the vertical through `centre` by degrees clockwise seen from above, scaled about it, then
// moved; world units. Whole pillars where faults or pillars are given, single nodes where nodes are.
struct Transform {
  survey::WorldPoint move{};
  double rotate_degrees = 0;
  std::array<double, 3> scale{1, 1, 1};
  std::optional<survey::WorldPoint> centre{};  // unset: the middle of what is moved
};
// Node -> where it would stand: for showing it before it is done.
std::map<Id, survey::WorldPoint> transformed(const Document& document, const std::set<Id>& faults,
                                             const std::set<Id>& pillars, const std::set<Id>& nodes,
                                             const Transform& transform);
bool transform_items(Document& document, const std::set<Id>& faults, const std::set<Id>& pillars,
                     const std::set<Id>& nodes, const Transform& transform);

}  // namespace footwall::ui
