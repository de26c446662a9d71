// The present triangulation of each fault, packed: a row of vertices and a row of faces per fault, so that a
// million triangles load in milliseconds. Derived, outside undo.
#pragma once
#include <optional>

#include "storage/project/detail/database.h"

namespace footwall::project::detail {

class MeshTable {
 public:
  explicit MeshTable(Database& database) : database_(database) {}
  // Throws kCorrupt for blobs that are not what their counts say.
  std::optional<MeshRecord> read(std::int64_t fault) const;
  std::int64_t revision(std::int64_t fault) const;  // 0 without mesh
  // Throws kInvalid for faces that name no vertex and positions that are not finite.
  void write(std::int64_t fault, const MeshRecord& mesh);
  void remove_all();

 private:
  Database& database_;
};

}  // namespace footwall::project::detail
