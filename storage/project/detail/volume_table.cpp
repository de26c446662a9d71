#include "storage/project/detail/volume_table.h"

#include <fmt/format.h>
#include <limits>

#include "storage/base/error.h"
#include "storage/base/hash.h"
#include "storage/project/detail/names.h"

namespace footwall::project::detail {
namespace {

double real_or_nan(const Query& row, int column) {
  return row.optional_real(column).value_or(std::numeric_limits<double>::quiet_NaN());
}

VolumeRecord from(const Query& row) {
  VolumeRecord v;
  v.id = row.integer(0);
  v.name = row.text(1);
  v.file = row.text(2);
  v.dims = {row.integer(3), row.integer(4), row.integer(5)};
  v.origin = {row.integer(6), row.integer(7), row.integer(8)};
  v.bytes = row.integer(9);
  v.checksum = row.text(10);
  v.min = real_or_nan(row, 11);
  v.max = real_or_nan(row, 12);
  v.mean = real_or_nan(row, 13);
  v.stddev = real_or_nan(row, 14);
  v.max_abs = real_or_nan(row, 15);
  v.null_count = row.integer(16);
  v.live_traces = row.integer(17);
  v.null_value = row.optional_real(18);
  v.role = row.text(19);
  v.source = row.text(20);
  v.provenance = row.text(21);
  return v;
}

void check(const VolumeRecord& v) {
  check_name("volume", v.name);
  if (v.file.empty()) throw Error(ErrorCode::kInvalid, fmt::format("volume '{}' names no file", v.name));
  for (int axis = 0; axis < 3; ++axis) {
    if (v.dims[axis] < 1 || v.dims[axis] > (1 << 23)) {
      throw Error(ErrorCode::kInvalid,
                  fmt::format("volume '{}' has {} x {} x {} samples; 1 to 2^23 on each axis", v.name,
                              v.dims[0], v.dims[1], v.dims[2]));
    }
  }
  hash_from_hex(v.checksum);
}

}  // namespace

std::vector<VolumeRecord> VolumeTable::all() const {
  std::vector<VolumeRecord> volumes;
  Query row(database_,
            "SELECT id, name, file, inlines, crosslines, samples, origin_i, origin_j, origin_k, bytes, "
            "checksum, min,"
            " max, mean, stddev, max_abs, null_count, live_traces, null_value, role, source, provenance"
            " FROM volume ORDER BY id");
  while (row.next()) volumes.push_back(from(row));
  return volumes;
}

VolumeRecord VolumeTable::find(const std::string& name) const {
  const auto volumes = all();
  if (volumes.empty()) {
    throw Error(ErrorCode::kNotFound, "the project has no volume", "footwall import volume brings one in");
  }
  if (name.empty()) return volumes.front();
  std::vector<std::string> names;
  for (const VolumeRecord& volume : volumes) {
    if (volume.name == name) return volume;
    names.push_back(volume.name);
  }
  throw Error(ErrorCode::kNotFound, fmt::format("there is no volume '{}'", name),
              "there is " + listed(names));
}

std::int64_t VolumeTable::add(const VolumeRecord& v) {
  check(v);
  if (Query taken(database_, "SELECT 1 FROM volume WHERE name = ?", v.name); taken.next()) {
    throw Error(ErrorCode::kInvalid, fmt::format("there is already a volume '{}'", v.name),
                "choose another name");
  }
  const std::int64_t id = database_.integer("SELECT coalesce(max(id), 0) + 1 FROM volume");
  Query(
      database_,
      "INSERT INTO volume(id, name, file, inlines, crosslines, samples, origin_i, origin_j, origin_k, bytes,"
      " checksum, min, max, mean, stddev, max_abs, null_count, live_traces, null_value, role, source, "
      "provenance)"
      " VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
      id, v.name, v.file, v.dims[0], v.dims[1], v.dims[2], v.origin[0], v.origin[1], v.origin[2], v.bytes,
      v.checksum, v.min, v.max, v.mean, v.stddev, v.max_abs, v.null_count, v.live_traces, v.null_value,
      v.role, v.source, v.provenance)
      .run();
  return id;
}

void VolumeTable::update(const VolumeRecord& v) {
  check(v);
  if (Query taken(database_, "SELECT 1 FROM volume WHERE name = ? AND id <> ?", v.name, v.id); taken.next()) {
    throw Error(ErrorCode::kInvalid, fmt::format("there is already a volume '{}'", v.name),
                "choose another name");
  }
  Query updated(
      database_,
      "UPDATE volume SET name = ?, file = ?, inlines = ?, crosslines = ?, samples = ?, origin_i = ?,"
      " origin_j = ?, origin_k = ?, bytes = ?, checksum = ?, min = ?, max = ?, mean = ?, stddev = ?,"
      " max_abs = ?, null_count = ?, live_traces = ?, null_value = ?, role = ?, source = ?, provenance = ?"
      " WHERE id = ? RETURNING id",
      v.name, v.file, v.dims[0], v.dims[1], v.dims[2], v.origin[0], v.origin[1], v.origin[2], v.bytes,
      v.checksum, v.min, v.max, v.mean, v.stddev, v.max_abs, v.null_count, v.live_traces, v.null_value,
      v.role, v.source, v.provenance, v.id);
  if (!updated.next()) throw Error(ErrorCode::kNotFound, fmt::format("there is no volume with id {}", v.id));
}

void VolumeTable::remove(std::int64_t id) {
  Query removed(database_, "DELETE FROM volume WHERE id = ? RETURNING id", id);
  if (!removed.next()) throw Error(ErrorCode::kNotFound, fmt::format("there is no volume with id {}", id));
}

}  // namespace footwall::project::detail
