#include "ui/model/walk.h"

#include <algorithm>
#include <cmath>

#include "engine/pillars/chart.h"

namespace footwall::ui {
namespace {

survey::IndexPoint middle_of(const survey::Pillar& pillar, const survey::Geometry& survey) {
  survey::IndexPoint sum;
  for (const survey::PillarNode& node : pillar.nodes) {
    const survey::IndexPoint p = survey.index_of(node.position);
    sum = {sum.i + p.i, sum.j + p.j, sum.k + p.k};
  }
  const double n = std::max(1.0, static_cast<double>(pillar.nodes.size()));
  return {sum.i / n, sum.j / n, sum.k / n};
}

// The fault that is walked through: that of the current item, else the active or the selected one.
const Fault* fault_of(const Document& document, const Selection& selection) {
  const Item& now = selection.current();
  if (now.kind == Item::Kind::kPillar) return document.fault_of_pillar(now.id);
  if (now.kind == Item::Kind::kNode) return document.fault_of_node(now.id);
  if (const Fault* active = document.fault(selection.active_fault())) return active;
  return selection.faults().empty() ? nullptr : document.fault(*selection.faults().begin());
}

const survey::Pillar* pillar_of_node(const Fault& fault, Id node) {
  const auto found = std::ranges::find_if(fault.pillars, [node](const survey::Pillar& pillar) {
    return std::ranges::find(pillar.nodes, node, &survey::PillarNode::id) != pillar.nodes.end();
  });
  return found == fault.pillars.end() ? nullptr : &*found;
}

// The pillar that is selected, or whose node is; 0 where none is.
Id pillar_now(const Fault& fault, const Item& now) {
  if (now.kind == Item::Kind::kPillar) return now.id;
  if (now.kind != Item::Kind::kNode) return 0;
  const survey::Pillar* pillar = pillar_of_node(fault, now.id);
  return pillar == nullptr ? 0 : pillar->id;
}

// The id `by` places from the one given, around the end; from one that is not there the first or the last.
Id beside(const std::vector<Id>& ids, Id id, int by) {
  const auto found = std::ranges::find(ids, id);
  if (found == ids.end()) return by > 0 ? ids.front() : ids.back();
  const auto count = static_cast<std::ptrdiff_t>(ids.size());
  return ids[static_cast<std::size_t>((found - ids.begin() + by + count) % count)];
}

}  // namespace

std::vector<Id> pillars_along(const Fault& fault, const survey::Geometry& survey) {
  std::vector<pillars::PillarInput> inputs;
  std::vector<Id> ids;
  for (const survey::Pillar& pillar : fault.pillars) {
    pillars::PillarInput& input = inputs.emplace_back();
    input.id = pillar.id;
    for (const survey::PillarNode& node : pillar.nodes) input.nodes.push_back(survey.index_of(node.position));
    ids.push_back(pillar.id);
  }
  const auto chart = pillars::fit_chart_across(inputs);
  if (!chart) return ids;
  std::map<Id, double> places;
  for (const survey::Pillar& pillar : fault.pillars) {
    const pillars::ChartPoint p = chart->from_index(middle_of(pillar, survey));
    places[pillar.id] = p.strike * chart->along[1] - p.dip * chart->along[0];
  }
  std::ranges::stable_sort(ids, {}, [&places](Id id) { return places.at(id); });
  return ids;
}

Item next_pillar(const Document& document, const Selection& selection, int by) {
  const Fault* fault = fault_of(document, selection);
  if (fault == nullptr || fault->pillars.empty() || !document.survey()) return {};
  const std::vector<Id> ids = pillars_along(*fault, *document.survey());
  return {.kind = Item::Kind::kPillar, .id = beside(ids, pillar_now(*fault, selection.current()), by)};
}

Item next_node(const Document& document, const Selection& selection, int by) {
  const Fault* fault = fault_of(document, selection);
  if (fault == nullptr || fault->pillars.empty() || !document.survey()) return {};
  const Item& now = selection.current();
  Id in = pillar_now(*fault, now);
  if (in == 0) in = pillars_along(*fault, *document.survey()).front();
  const survey::Pillar* pillar = document.pillar(in);
  if (pillar == nullptr || pillar->nodes.empty()) return {};
  std::vector<Id> ids;
  for (const survey::PillarNode& node : pillar->nodes) ids.push_back(node.id);
  return {.kind = Item::Kind::kNode, .id = beside(ids, now.kind == Item::Kind::kNode ? now.id : 0, by)};
}

void bring_sections_to(Display& display, const survey::Geometry& survey, const survey::IndexPoint& place) {
  const auto sections = display.sections();
  for (const Display::ShownSection& shown : sections) {
    if (!shown.linked || shown.section.kind == Section::Kind::kLine) continue;
    Section moved = shown.section;
    moved.index = std::llround(moved.kind == Section::Kind::kInline      ? place.i
                               : moved.kind == Section::Kind::kCrossline ? place.j
                                                                         : place.k);
    display.move_section(shown.id, stepped(moved, 0, survey));
  }
}

std::optional<survey::IndexPoint> place_of(const Document& document, const Item& item) {
  if (!document.survey()) return std::nullopt;
  if (item.kind == Item::Kind::kPillar) {
    const survey::Pillar* pillar = document.pillar(item.id);
    if (pillar != nullptr && !pillar->nodes.empty()) return middle_of(*pillar, *document.survey());
  }
  if (item.kind != Item::Kind::kNode) return std::nullopt;
  const Fault* fault = document.fault_of_node(item.id);
  const survey::Pillar* pillar = fault == nullptr ? nullptr : pillar_of_node(*fault, item.id);
  if (pillar == nullptr) return std::nullopt;
  const auto node = std::ranges::find(pillar->nodes, item.id, &survey::PillarNode::id);
  return document.survey()->index_of(node->position);
}

}  // namespace footwall::ui
