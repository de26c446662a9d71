// Triangle surfaces, one compressed row each: imported ones (table surface, under undo) and the true ones of
// synthetic surveys (table truth).
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "storage/project/detail/database.h"
#include "storage/survey/surface.h"

namespace footwall::project::detail {

class SurfaceTable {
 public:
  enum class Family : std::uint8_t { kSurface, kTruth };
  SurfaceTable(Database& database, Family family) : database_(database), family_(family) {}

  std::vector<SurfaceRecord> all() const;
  SurfaceRecord find(std::int64_t id) const;
  std::optional<SurfaceRecord> of_fault(std::int64_t fault) const;  // of the family kSurface
  // Throws kCorrupt for a row whose blob is not what its counts say.
  survey::Surface read(std::int64_t id) const;
  // Throws kInvalid for vertices that are not finite and triangles that name no vertex.
  // The record gives id, kind and, in the family kSurface, fault and units.
  void insert(const survey::Surface& surface, const SurfaceRecord& record);
  void rename(std::int64_t id, const std::string& name);
  void remove(std::int64_t id);

 private:
  std::string select(std::string_view where) const;
  std::string sql(std::string_view text) const;  // with the family's table for {}
  Database& database_;
  Family family_;
};

}  // namespace footwall::project::detail
