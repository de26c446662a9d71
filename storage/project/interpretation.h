// Everything that changes faults, pillars, nodes and imported surfaces. Only Project::edit() hands one out;
// it is valid inside that call alone. Positions are world positions, kept as picked (doubles, never rounded).
//
// Interpolated pillars follow their two parents: after the caller's function every interpolated pillar with a
// moved parent is made anew in the same edit (Project::set_regenerator; by default the straight line between
// the parents at equal normalised length). Editing an interpolated pillar makes it interpreted and cuts the
// link; deleting a parent deletes its interpolated children, which would otherwise claim what nobody picked.
//
// All functions throw Error: kNotFound for an id that is not there, kInvalid for a value that cannot be used
// (not finite, empty or taken name, locked fault), kIo; the whole edit is then rolled back.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "storage/project/records.h"

namespace footwall::project {

namespace detail {
class EditState;
}

class Interpretation {
 public:
  explicit Interpretation(detail::EditState& state) : state_(state) {}
  Interpretation(const Interpretation&) = delete;
  Interpretation& operator=(const Interpretation&) = delete;

  // Reading, as it stands inside this edit.
  std::vector<FaultRecord> faults() const;
  FaultRecord fault(std::int64_t fault) const;
  std::int64_t fault_id(const std::string& name) const;
  std::vector<survey::Pillar> pillars(std::int64_t fault) const;
  survey::Pillar pillar(std::int64_t pillar) const;
  std::int64_t fault_of_pillar(std::int64_t pillar) const;
  std::int64_t pillar_of_node(std::int64_t node) const;

  // Faults.
  std::int64_t add_fault(const std::string& name);
  void rename_fault(std::int64_t fault, const std::string& name);
  void delete_fault(std::int64_t fault);
  // property: colour (#rrggbb), interpreter, status, note, locked ("true"/"false"), tie_tolerance (voxels, >=
  // 0).
  void set_fault_property(std::int64_t fault, std::string_view property, const std::string& value);
  // Replaces the chart that triangulations use; the mesh becomes stale.
  void set_chart(std::int64_t fault, const Bytes& chart);

  // Pillars; at least one node each. Returns the pillar with its ids.
  survey::Pillar add_pillar(std::int64_t fault, survey::PillarKind kind,
                            std::span<const survey::WorldPoint> nodes);
  // The same with links: the ids in `pillar` are ignored, kind, parents and parameter are kept. An
  // interpolated pillar needs two different parents in the same fault and 0 < parameter < 1.
  survey::Pillar add_pillar(std::int64_t fault, const survey::Pillar& pillar);
  void delete_pillar(std::int64_t pillar);
  void move_pillar(std::int64_t pillar, const survey::WorldPoint& by);
  // The pillars belong to this fault from now on, with their ids. Interpolated ones go along without being
  // named where both parents do, and are removed where only one does; one that is named without its parents
  // becomes interpreted. A fault that has lost its last pillar stays.
  void assign_pillars(std::span<const std::int64_t> pillars, std::int64_t fault);
  // The same nodes, last first.
  void reverse_pillar(std::int64_t pillar);
  // The same nodes in this order of their ids.
  void reorder_nodes(std::int64_t pillar, std::span<const std::int64_t> nodes);
  // Replaces all nodes (ids are kept as far as there are as many); an interpolated pillar becomes
  // interpreted.
  void set_nodes(std::int64_t pillar, std::span<const survey::WorldPoint> nodes);
  // Moves a pillar onto the fault: kind becomes snapped, the former positions are kept.
  void snap_pillar(std::int64_t pillar, std::span<const survey::WorldPoint> nodes);
  // The positions before the snap; empty for pillars that were not snapped.
  std::vector<survey::WorldPoint> former_positions(std::int64_t pillar) const;
  // Makes an interpolated pillar interpreted as it stands.
  void accept_pillar(std::int64_t pillar);

  // Nodes. `at` is the position of the new node in the pillar, 0 = first, number of nodes = last.
  std::int64_t insert_node(std::int64_t pillar, std::int64_t at, const survey::WorldPoint& position);
  void move_node(std::int64_t node, const survey::WorldPoint& position);
  // Refuses a pillar's last node: delete the pillar instead.
  void delete_node(std::int64_t node);

  // Imported surfaces. One with `fault` is that fault's shape: the fault must have no pillars and no other
  // surface; it then takes no pillars, and deleting it deletes the surface.
  std::int64_t add_surface(const survey::Surface& surface, const std::string& kind, std::int64_t fault = 0,
                           const SurfaceUnits& units = {});
  // The surface that is this fault's shape.
  std::optional<SurfaceRecord> surface_of(std::int64_t fault) const;
  void rename_surface(std::int64_t surface, const std::string& name);
  void delete_surface(std::int64_t surface);

 private:
  detail::EditState& state_;
};

}  // namespace footwall::project
