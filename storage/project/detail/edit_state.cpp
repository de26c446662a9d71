#include "storage/project/detail/edit_state.h"

#include <fmt/format.h>
#include <cmath>

#include "storage/project/detail/clock.h"

namespace footwall::project::detail {

EditState::EditState(Database& db)
    : database(db), ids(db), faults(db), surfaces(db, SurfaceTable::Family::kSurface) {}

void EditState::require_open() const {
  require(open_, "an Interpretation was used after its edit");
  // SQLite rolls back by itself when the disk is full; what came after it would be an edit of its own.
  if (!database.in_transaction()) {
    throw Error(ErrorCode::kIo, "the edit was rolled back because the project could not be written",
                "free some space on the disk");
  }
}

FaultRecord EditState::editable(std::int64_t fault) const {
  require_open();
  FaultRecord record = faults.find(fault);
  if (record.locked) {
    throw Error(ErrorCode::kInvalid, fmt::format("fault '{}' is locked", record.name), "unlock it first");
  }
  return record;
}

std::set<std::string>& EditState::fault_names() {
  if (!fault_names_) {
    fault_names_.emplace();
    for (FaultRecord& fault : faults.all()) fault_names_->insert(std::move(fault.name));
  }
  return *fault_names_;
}

std::set<std::string>& EditState::surface_names() {
  if (!surface_names_) {
    surface_names_.emplace();
    for (SurfaceRecord& surface : surfaces.all()) surface_names_->insert(std::move(surface.name));
  }
  return *surface_names_;
}

void EditState::reshaped(std::int64_t fault) {
  touched_.insert(fault);
  reshaped_.insert(fault);
}

void EditState::regenerate(const Regenerator& regenerator) {
  std::map<std::int64_t, std::set<std::int64_t>> followers;  // by fault
  for (const std::int64_t pillar : moved_) {
    for (const std::int64_t child : faults.children(pillar)) {
      followers[faults.fault_of_pillar(child)].insert(child);
    }
  }
  for (const auto& [fault, wanted] : followers) {
    const auto pillars = faults.pillars(fault);
    std::vector<survey::Pillar> children;
    for (const survey::Pillar& pillar : pillars) {
      if (wanted.contains(pillar.id)) children.push_back(pillar);
    }
    const FaultRecord record = faults.find(fault);
    const auto lines =
        regenerator ? regenerator(record, pillars, children) : ruled(record, pillars, children);
    require(lines.size() == children.size(), "the regenerator must give one polyline per child");
    for (std::size_t c = 0; c < children.size(); ++c) {
      require(!lines[c].empty(), "the regenerator must give at least one node");
      std::vector<survey::PillarNode>& nodes = children[c].nodes;
      nodes.resize(lines[c].size());
      for (std::size_t n = 0; n < nodes.size(); ++n) {
        check_position(lines[c][n]);
        if (nodes[n].id == 0) nodes[n].id = ids.next("pillar_node");
        nodes[n].position = lines[c][n];
      }
      faults.set_nodes(children[c].id, nodes);
      regenerated_.push_back(children[c].id);
    }
    reshaped(fault);
  }
}

void EditState::stamp(EditResult& result) {
  const std::string now = now_text();
  for (const std::int64_t fault : touched_) {
    if (!faults.exists(fault)) continue;  // deleted in this very edit
    FaultRecord record = faults.find(fault);
    record.modified = now;
    if (reshaped_.contains(fault)) {
      record.revision = ids.next("revision");
      result.faults.push_back(fault);
    }
    faults.update(record);
  }
  result.regenerated = regenerated_;
  result.removed = removed_;
}

void check_position(const survey::WorldPoint& p) {
  if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) return;
  throw Error(ErrorCode::kInvalid, fmt::format("the position ({}, {}, {}) is not finite", p.x, p.y, p.z));
}

}  // namespace footwall::project::detail
