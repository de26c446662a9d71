#include "storage/project/detail/surface_table.h"

#include <fmt/format.h>
#include <cmath>

#include "storage/project/detail/names.h"
#include "storage/project/detail/packing.h"

namespace footwall::project::detail {
namespace {

constexpr std::size_t kVertexBytes = sizeof(survey::WorldPoint);
constexpr std::size_t kTriangleBytes = 3 * sizeof(std::int32_t);
static_assert(kVertexBytes == 24);

void check_shape(const survey::Surface& surface, ErrorCode code) {
  const auto vertices = static_cast<std::int64_t>(surface.vertices.size());
  for (const survey::WorldPoint& v : surface.vertices) {
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) {
      throw Error(code, fmt::format("surface '{}' has a vertex that is not finite", surface.name));
    }
  }
  for (const auto& triangle : surface.triangles) {
    for (const std::int32_t corner : triangle) {
      if (corner < 0 || corner >= vertices) {
        throw Error(code, fmt::format("surface '{}' has a triangle with vertex {} of {}", surface.name,
                                      corner, vertices));
      }
    }
  }
}

SurfaceRecord record_from(const Query& row) {
  SurfaceRecord record;
  record.id = row.integer(0);
  record.name = row.text(1);
  record.kind = row.text(2);
  record.vertices = row.integer(3);
  record.triangles = row.integer(4);
  record.fault = row.integer(5);
  record.units.horizontal = row.text(6);
  record.units.vertical = row.text(7);
  return record;
}

}  // namespace

std::string SurfaceTable::sql(std::string_view text) const {
  return fmt::format(fmt::runtime(text), family_ == Family::kSurface ? "surface" : "truth");
}

// The truth belongs to no fault and is in the survey's units; its table has no columns for them.
std::string SurfaceTable::select(std::string_view where) const {
  const bool surface = family_ == Family::kSurface;
  return fmt::format("SELECT id, name, kind, vertices, triangles, {} FROM {} {}",
                     surface ? "fault, horizontal_unit, vertical_unit" : "0, '', ''",
                     surface ? "surface" : "truth", where);
}

std::vector<SurfaceRecord> SurfaceTable::all() const {
  std::vector<SurfaceRecord> surfaces;
  Query row(database_, select("ORDER BY id"));
  while (row.next()) surfaces.push_back(record_from(row));
  return surfaces;
}

SurfaceRecord SurfaceTable::find(std::int64_t id) const {
  Query row(database_, select("WHERE id = ?"), id);
  if (!row.next()) throw Error(ErrorCode::kNotFound, fmt::format("there is no surface with id {}", id));
  return record_from(row);
}

std::optional<SurfaceRecord> SurfaceTable::of_fault(std::int64_t fault) const {
  Query row(database_, select("WHERE fault = ? AND fault <> 0"), fault);
  if (!row.next()) return std::nullopt;
  return record_from(row);
}

survey::Surface SurfaceTable::read(std::int64_t id) const {
  const SurfaceRecord record = find(id);
  Query row(database_, sql("SELECT data FROM {} WHERE id = ?"), id);
  require(row.next(), "a surface vanished while it was read");
  const std::string what = fmt::format("surface '{}'", record.name);
  constexpr std::int64_t kMost = kLargestValue;
  if (record.vertices < 0 || record.triangles < 0 || record.vertices > kMost || record.triangles > kMost) {
    throw Error(ErrorCode::kCorrupt, fmt::format("{} claims {} vertices and {} triangles", what,
                                                 record.vertices, record.triangles));
  }
  const auto vertices = static_cast<std::size_t>(record.vertices);
  const auto triangles = static_cast<std::size_t>(record.triangles);
  const Bytes bytes = uncompressed(row.view(0), vertices * kVertexBytes + triangles * kTriangleBytes, what);
  std::span<const std::byte> rest(bytes);
  survey::Surface surface;
  surface.name = record.name;
  surface.vertices = taken<survey::WorldPoint>(rest, vertices);
  surface.triangles = taken<std::array<std::int32_t, 3>>(rest, triangles);
  check_shape(surface, ErrorCode::kCorrupt);
  return surface;
}

void SurfaceTable::insert(const survey::Surface& surface, const SurfaceRecord& record) {
  check_name("surface", surface.name);
  check_text("a surface's kind", record.kind);
  check_shape(surface, ErrorCode::kInvalid);
  Bytes bytes;
  append(bytes, std::span<const survey::WorldPoint>(surface.vertices));
  append(bytes, std::span<const std::array<std::int32_t, 3>>(surface.triangles));
  const Bytes data = compressed(bytes);
  Query(database_, sql("INSERT INTO {}(id, name, kind, vertices, triangles, data) VALUES(?, ?, ?, ?, ?, ?)"),
        record.id, surface.name, record.kind, static_cast<std::int64_t>(surface.vertices.size()),
        static_cast<std::int64_t>(surface.triangles.size()), data)
      .run();
  if (family_ == Family::kTruth) return;
  Query(database_, "UPDATE surface SET fault = ?, horizontal_unit = ?, vertical_unit = ? WHERE id = ?",
        record.fault, record.units.horizontal, record.units.vertical, record.id)
      .run();
}

void SurfaceTable::rename(std::int64_t id, const std::string& name) {
  check_name("surface", name);
  find(id);
  Query(database_, sql("UPDATE {} SET name = ? WHERE id = ?"), name, id).run();
}

void SurfaceTable::remove(std::int64_t id) {
  find(id);
  Query(database_, sql("DELETE FROM {} WHERE id = ?"), id).run();
}

}  // namespace footwall::project::detail
