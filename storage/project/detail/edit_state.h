// What one edit has touched so far, and what follows from it before the commit.
#pragma once
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "storage/project/detail/fault_table.h"
#include "storage/project/detail/id_counter.h"
#include "storage/project/detail/surface_table.h"
#include "storage/project/project.h"

namespace footwall::project::detail {

class EditState {
 public:
  explicit EditState(Database& db);

  // Throws kInternal once the edit is over or its transaction is lost; kInvalid for a locked fault.
  void require_open() const;
  FaultRecord editable(std::int64_t fault) const;
  // The fault's row, or its shape, differs: see stamp().
  void touched(std::int64_t fault) { touched_.insert(fault); }
  void reshaped(std::int64_t fault);
  // The pillar's nodes differ: its interpolated children follow.
  void moved(std::int64_t pillar) { moved_.insert(pillar); }
  void removed(std::int64_t pillar) { removed_.push_back(pillar); }
  void close() { open_ = false; }
  // The names in use, read once an edit: whoever adds, renames or deletes keeps them in step. (Asking the
  // tables for every new name took minutes for a file of 20,000 faults.)
  std::set<std::string>& fault_names();
  std::set<std::string>& surface_names();

  // Step 1 after the caller's function: makes interpolated pillars anew whose parents moved.
  void regenerate(const Regenerator& regenerator);
  // Step 2: date and a new revision for the faults that changed.
  void stamp(EditResult& result);

  Database& database;
  IdCounter ids;
  FaultTable faults;
  SurfaceTable surfaces;

 private:
  bool open_ = true;
  std::optional<std::set<std::string>> fault_names_, surface_names_;
  std::set<std::int64_t> touched_;
  std::set<std::int64_t> reshaped_;
  std::set<std::int64_t> moved_;
  std::vector<std::int64_t> removed_;
  std::vector<std::int64_t> regenerated_;
};

// Throws kInvalid naming the number that is not finite.
void check_position(const survey::WorldPoint& position);

// Between the parents at equal normalised length, with as many nodes as the child has: what stands in while
// nobody has set a regenerator.
std::vector<std::vector<survey::WorldPoint>> ruled(const FaultRecord& fault,
                                                   std::span<const survey::Pillar> pillars,
                                                   std::span<const survey::Pillar> children);

}  // namespace footwall::project::detail
