#include "storage/project/interpretation.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "storage/base/error.h"
#include "storage/base/text.h"
#include "storage/project/detail/clock.h"
#include "storage/project/detail/edit_state.h"
#include "storage/project/detail/names.h"
#include "storage/project/detail/packing.h"

namespace footwall::project {
namespace {

using survey::PillarKind;

// Refuses values that a later reader could not use, before anything of the call is written.
void check_nodes(std::span<const survey::WorldPoint> nodes) {
  if (nodes.empty()) throw Error(ErrorCode::kInvalid, "a pillar needs at least one node");
  for (const survey::WorldPoint& node : nodes) detail::check_position(node);
}

void check_free(detail::EditState& state, const std::string& name) {
  detail::check_name("fault", name);
  if (state.fault_names().contains(name)) {
    throw Error(ErrorCode::kInvalid, fmt::format("there is already a fault '{}'", name),
                "choose another name");
  }
}

std::string checked_colour(const std::string& value) {
  const bool good = value.size() == 7 && value[0] == '#' &&
                    value.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
  if (!good) throw Error(ErrorCode::kInvalid, fmt::format("'{}' is no colour", value), "write it as #rrggbb");
  return value;
}

bool checked_flag(const std::string& value) {
  if (value == "true" || value == "1") return true;
  if (value == "false" || value == "0") return false;
  throw Error(ErrorCode::kInvalid, fmt::format("'{}' is neither true nor false", value));
}

double checked_tolerance(const std::string& value) {
  const auto number = text::number(value);
  if (!number || !std::isfinite(*number) || *number < 0) {
    throw Error(ErrorCode::kInvalid, fmt::format("'{}' is no tie tolerance", value),
                "give voxels, 0 or more");
  }
  return *number;
}

// A hand on an interpolated pillar makes it the interpreter's own.
void cut_link(detail::EditState& state, survey::Pillar& pillar) {
  if (pillar.kind != PillarKind::kInterpolated) return;
  pillar.kind = PillarKind::kInterpreted;
  pillar.parent_a = pillar.parent_b = 0;
  pillar.parameter = 0;
  state.faults.update(pillar);
}

// What every change of a pillar's nodes needs first and last.
survey::Pillar begin_change(detail::EditState& state, std::int64_t pillar) {
  survey::Pillar found = state.faults.pillar(pillar);
  state.editable(state.faults.fault_of_pillar(pillar));
  cut_link(state, found);
  return found;
}

void end_change(detail::EditState& state, std::int64_t pillar) {
  state.moved(pillar);
  state.reshaped(state.faults.fault_of_pillar(pillar));
}

void write_nodes(detail::EditState& state, survey::Pillar& pillar,
                 std::span<const survey::WorldPoint> positions) {
  pillar.nodes.resize(positions.size());
  for (std::size_t n = 0; n < positions.size(); ++n) {
    if (pillar.nodes[n].id == 0) pillar.nodes[n].id = state.ids.next("pillar_node");
    pillar.nodes[n].position = positions[n];
  }
  state.faults.set_nodes(pillar.id, pillar.nodes);
  end_change(state, pillar.id);
}

void refuse_pillars_on_surface(const detail::EditState& state, const FaultRecord& fault) {
  if (!state.surfaces.of_fault(fault.id)) return;
  throw Error(ErrorCode::kInvalid,
              fmt::format("fault '{}' is an imported surface and takes no pillars", fault.name),
              "pick them on a fault of their own");
}

void check_links(const detail::EditState& state, std::int64_t fault, const survey::Pillar& pillar) {
  if (pillar.kind != PillarKind::kInterpolated) {
    if (pillar.parent_a == 0 && pillar.parent_b == 0) return;
    throw Error(ErrorCode::kInvalid, "only an interpolated pillar has parents");
  }
  if (pillar.parent_a == pillar.parent_b || !(pillar.parameter > 0) || !(pillar.parameter < 1)) {
    throw Error(ErrorCode::kInvalid,
                "an interpolated pillar needs two parents and a parameter between 0 and 1");
  }
  for (const std::int64_t parent : {pillar.parent_a, pillar.parent_b}) {
    if (state.faults.fault_of_pillar(parent) != fault) {
      throw Error(ErrorCode::kInvalid, fmt::format("pillar {} belongs to another fault", parent));
    }
    if (state.faults.pillar(parent).kind == PillarKind::kInterpolated) {
      throw Error(ErrorCode::kInvalid, fmt::format("pillar {} is interpolated itself", parent),
                  "interpolate between picked ones");
    }
  }
}

}  // namespace

std::vector<FaultRecord> Interpretation::faults() const {
  return state_.faults.all();
}
FaultRecord Interpretation::fault(std::int64_t fault) const {
  return state_.faults.find(fault);
}
std::int64_t Interpretation::fault_id(const std::string& name) const {
  return state_.faults.find(name).id;
}
std::vector<survey::Pillar> Interpretation::pillars(std::int64_t fault) const {
  return state_.faults.pillars(fault);
}
survey::Pillar Interpretation::pillar(std::int64_t pillar) const {
  return state_.faults.pillar(pillar);
}
std::int64_t Interpretation::fault_of_pillar(std::int64_t pillar) const {
  return state_.faults.fault_of_pillar(pillar);
}
std::int64_t Interpretation::pillar_of_node(std::int64_t node) const {
  return state_.faults.pillar_of_node(node);
}

std::int64_t Interpretation::add_fault(const std::string& name) {
  state_.require_open();
  check_free(state_, name);
  FaultRecord fault;
  fault.id = state_.ids.next("fault");
  fault.name = name;
  fault.modified = detail::now_text();
  state_.faults.insert(fault);
  state_.fault_names().insert(name);
  state_.reshaped(fault.id);
  return fault.id;
}

void Interpretation::rename_fault(std::int64_t fault, const std::string& name) {
  FaultRecord record = state_.editable(fault);
  if (record.name == name) return;
  check_free(state_, name);
  state_.fault_names().erase(record.name);
  state_.fault_names().insert(name);
  record.name = name;
  state_.faults.update(record);
  state_.touched(fault);
}

void Interpretation::delete_fault(std::int64_t fault) {
  const FaultRecord record = state_.editable(fault);
  if (const auto surface = state_.surfaces.of_fault(fault)) delete_surface(surface->id);
  state_.faults.remove(fault);
  state_.fault_names().erase(record.name);
}

void Interpretation::set_fault_property(std::int64_t fault, std::string_view property,
                                        const std::string& value) {
  FaultRecord record = property == "locked" ? state_.faults.find(fault) : state_.editable(fault);
  state_.require_open();
  if (property == "colour") {
    record.colour = checked_colour(value);
  } else if (property == "locked") {
    record.locked = checked_flag(value);
  } else if (property == "tie_tolerance") {
    record.tie_tolerance = checked_tolerance(value);
    state_.reshaped(fault);
  } else if (property == "interpreter" || property == "status" || property == "note") {
    detail::check_text(fmt::format("a fault's {}", property), value);
    (property == "interpreter" ? record.interpreter
     : property == "status"    ? record.status
                               : record.note) = value;
  } else {
    throw Error(ErrorCode::kInvalid, fmt::format("a fault has no property '{}'", property),
                "there is colour, interpreter, status, note, locked, tie_tolerance");
  }
  state_.faults.update(record);
  state_.touched(fault);
}

void Interpretation::set_chart(std::int64_t fault, const Bytes& chart) {
  FaultRecord record = state_.editable(fault);
  record.chart = chart;
  state_.faults.update(record);
  state_.reshaped(fault);
}

survey::Pillar Interpretation::add_pillar(std::int64_t fault, PillarKind kind,
                                          std::span<const survey::WorldPoint> nodes) {
  survey::Pillar pillar;
  pillar.kind = kind;
  for (const survey::WorldPoint& node : nodes) pillar.nodes.push_back({0, node});
  return add_pillar(fault, pillar);
}

survey::Pillar Interpretation::add_pillar(std::int64_t fault, const survey::Pillar& given) {
  refuse_pillars_on_surface(state_, state_.editable(fault));
  survey::Pillar pillar = given;
  if (pillar.nodes.empty()) throw Error(ErrorCode::kInvalid, "a pillar needs at least one node");
  for (const survey::PillarNode& node : pillar.nodes) detail::check_position(node.position);
  check_links(state_, fault, pillar);
  pillar.id = state_.ids.next("pillar");
  for (survey::PillarNode& node : pillar.nodes) node.id = state_.ids.next("pillar_node");
  state_.faults.insert(fault, pillar);
  state_.reshaped(fault);
  return pillar;
}

void Interpretation::delete_pillar(std::int64_t pillar) {
  const std::int64_t fault = state_.faults.fault_of_pillar(pillar);
  state_.editable(fault);
  for (const std::int64_t child : state_.faults.children(pillar)) {
    state_.faults.remove_pillar(child);
    state_.removed(child);
  }
  state_.faults.remove_pillar(pillar);
  state_.reshaped(fault);
}

void Interpretation::move_pillar(std::int64_t pillar, const survey::WorldPoint& by) {
  detail::check_position(by);
  std::vector<survey::WorldPoint> positions;
  for (const survey::PillarNode& node : state_.faults.pillar(pillar).nodes) {
    positions.push_back({node.position.x + by.x, node.position.y + by.y, node.position.z + by.z});
  }
  set_nodes(pillar, positions);
}

void Interpretation::assign_pillars(std::span<const std::int64_t> pillars, std::int64_t fault) {
  refuse_pillars_on_surface(state_, state_.editable(fault));
  std::set<std::int64_t> moved;
  for (const std::int64_t pillar : pillars) {
    const std::int64_t from = state_.faults.fault_of_pillar(pillar);
    state_.editable(from);
    if (from != fault) moved.insert(pillar);
  }
  // 1. Named interpolated pillars whose parents stay are the interpreter's own now.
  for (const std::int64_t pillar : moved) {
    survey::Pillar row = state_.faults.pillar(pillar);
    if (!moved.contains(row.parent_a) || !moved.contains(row.parent_b)) cut_link(state_, row);
  }
  // 2. Children go with both parents, or end.
  std::set<std::int64_t> children;
  for (const std::int64_t pillar : moved) {
    for (const std::int64_t child : state_.faults.children(pillar)) children.insert(child);
  }
  for (const std::int64_t child : children) {
    const survey::Pillar row = state_.faults.pillar(child);
    if (moved.contains(row.parent_a) && moved.contains(row.parent_b)) {
      moved.insert(child);
    } else {
      state_.reshaped(state_.faults.fault_of_pillar(child));
      state_.faults.remove_pillar(child);
      state_.removed(child);
    }
  }
  // 3. The rows.
  for (const std::int64_t pillar : moved) {
    state_.reshaped(state_.faults.fault_of_pillar(pillar));
    state_.faults.assign(pillar, fault);
  }
  if (!moved.empty()) state_.reshaped(fault);
}

void Interpretation::reverse_pillar(std::int64_t pillar) {
  survey::Pillar changed = begin_change(state_, pillar);
  std::ranges::reverse(changed.nodes);
  state_.faults.set_nodes(pillar, changed.nodes);
  end_change(state_, pillar);
}

void Interpretation::reorder_nodes(std::int64_t pillar, std::span<const std::int64_t> nodes) {
  survey::Pillar changed = begin_change(state_, pillar);
  std::map<std::int64_t, survey::PillarNode> former;
  for (const survey::PillarNode& node : changed.nodes) former[node.id] = node;
  changed.nodes.clear();
  for (const std::int64_t node : nodes) {
    const auto found = former.extract(node);
    if (found.empty()) break;
    changed.nodes.push_back(found.mapped());
  }
  if (changed.nodes.size() != nodes.size() || !former.empty()) {
    throw Error(ErrorCode::kInvalid,
                fmt::format("the new order of pillar {} does not name each of its nodes once", pillar));
  }
  state_.faults.set_nodes(pillar, changed.nodes);
  end_change(state_, pillar);
}

void Interpretation::set_nodes(std::int64_t pillar, std::span<const survey::WorldPoint> nodes) {
  check_nodes(nodes);
  survey::Pillar changed = begin_change(state_, pillar);
  write_nodes(state_, changed, nodes);
}

void Interpretation::snap_pillar(std::int64_t pillar, std::span<const survey::WorldPoint> nodes) {
  check_nodes(nodes);
  survey::Pillar changed = begin_change(state_, pillar);
  if (changed.kind != PillarKind::kSnapped) {
    std::vector<survey::WorldPoint> former;
    for (const survey::PillarNode& node : changed.nodes) former.push_back(node.position);
    state_.faults.set_former(pillar, detail::packed(former));
    changed.kind = PillarKind::kSnapped;
    state_.faults.update(changed);
  }
  write_nodes(state_, changed, nodes);
}

std::vector<survey::WorldPoint> Interpretation::former_positions(std::int64_t pillar) const {
  const Bytes bytes = state_.faults.former(pillar);
  const std::size_t count = bytes.size() / sizeof(survey::WorldPoint);
  detail::require_size(fmt::format("the former positions of pillar {}", pillar), bytes.size(),
                       static_cast<std::int64_t>(count), sizeof(survey::WorldPoint));
  std::span<const std::byte> rest(bytes);
  return detail::taken<survey::WorldPoint>(rest, count);
}

void Interpretation::accept_pillar(std::int64_t pillar) {
  begin_change(state_, pillar);
  state_.reshaped(state_.faults.fault_of_pillar(pillar));
}

std::int64_t Interpretation::insert_node(std::int64_t pillar, std::int64_t at,
                                         const survey::WorldPoint& position) {
  detail::check_position(position);
  const auto count = static_cast<std::int64_t>(state_.faults.pillar(pillar).nodes.size());
  if (at < 0 || at > count) {
    throw Error(ErrorCode::kInvalid,
                fmt::format("pillar {} has {} nodes: a new one cannot stand at {}", pillar, count, at),
                fmt::format("give 0 to {}", count));
  }
  begin_change(state_, pillar);
  const std::int64_t node = state_.ids.next("pillar_node");
  state_.faults.insert_node(pillar, at, {node, position});
  end_change(state_, pillar);
  return node;
}

void Interpretation::move_node(std::int64_t node, const survey::WorldPoint& position) {
  detail::check_position(position);
  const std::int64_t pillar = state_.faults.pillar_of_node(node);
  begin_change(state_, pillar);
  state_.faults.move_node({node, position});
  end_change(state_, pillar);
}

void Interpretation::delete_node(std::int64_t node) {
  const std::int64_t pillar = state_.faults.pillar_of_node(node);
  if (state_.faults.pillar(pillar).nodes.size() == 1) {
    throw Error(ErrorCode::kInvalid, fmt::format("node {} is the last of pillar {}", node, pillar),
                "delete the pillar instead");
  }
  begin_change(state_, pillar);
  state_.faults.remove_node(pillar, node);
  end_change(state_, pillar);
}

namespace {
void check_free_surface(detail::EditState& state, const std::string& name) {
  if (state.surface_names().contains(name)) {
    throw Error(ErrorCode::kInvalid, fmt::format("there is already a surface '{}'", name),
                "choose another name");
  }
}
}  // namespace

std::int64_t Interpretation::add_surface(const survey::Surface& surface, const std::string& kind,
                                         std::int64_t fault_id, const SurfaceUnits& units) {
  state_.require_open();
  check_free_surface(state_, surface.name);
  if (fault_id != 0) {
    const FaultRecord fault = state_.editable(fault_id);
    if (!state_.faults.pillars(fault.id).empty() || state_.surfaces.of_fault(fault.id)) {
      throw Error(ErrorCode::kInvalid, fmt::format("fault '{}' has a shape already", fault.name),
                  "give the surface a fault of its own");
    }
    state_.reshaped(fault.id);
  }
  SurfaceRecord record;
  record.id = state_.ids.next("surface");
  record.kind = kind;
  record.fault = fault_id;
  record.units = units;
  state_.surfaces.insert(surface, record);
  state_.surface_names().insert(surface.name);
  return record.id;
}

std::optional<SurfaceRecord> Interpretation::surface_of(std::int64_t fault) const {
  return state_.surfaces.of_fault(fault);
}

void Interpretation::rename_surface(std::int64_t surface, const std::string& name) {
  state_.require_open();
  const std::string former = state_.surfaces.find(surface).name;
  if (former == name) return;
  check_free_surface(state_, name);
  state_.surfaces.rename(surface, name);
  state_.surface_names().erase(former);
  state_.surface_names().insert(name);
}

void Interpretation::delete_surface(std::int64_t surface) {
  state_.require_open();
  const SurfaceRecord record = state_.surfaces.find(surface);
  if (record.fault != 0) {
    state_.editable(record.fault);
    state_.reshaped(record.fault);
  }
  state_.surfaces.remove(surface);
  state_.surface_names().erase(record.name);
}

}  // namespace footwall::project
