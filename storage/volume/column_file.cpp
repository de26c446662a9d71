#include "storage/volume/column_file.h"

#include <fmt/format.h>

#include <optional>

#include "storage/base/error.h"
#include "storage/base/hash.h"
#include "storage/base/partial_file.h"
#include "storage/volume/hdf5_handle.h"

namespace footwall::volume {
namespace {

constexpr const char* kCheck = "check";

// The types in memory and in the file.
std::pair<hid_t, hid_t> types_of(const ColumnValues& values) {
  switch (values.index()) {
    case 0:
      return {H5T_NATIVE_INT64, H5T_STD_I64LE};
    case 1:
      return {H5T_NATIVE_INT32, H5T_STD_I32LE};
    case 2:
      return {H5T_NATIVE_UINT8, H5T_STD_U8LE};
    default:
      return {H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE};
  }
}

std::int64_t width_of(const Column& column) {
  std::int64_t width = 1;
  for (const std::int64_t each : column.inner) width *= each;
  return width;
}

std::int64_t rows_of(const ColumnTable& table, const Column& column) {
  if (!column.own_rows) return table.rows;
  const std::size_t count = std::visit([](const auto& values) { return values.size(); }, column.values);
  return static_cast<std::int64_t>(count) / std::max<std::int64_t>(width_of(column), 1);
}

std::vector<hsize_t> shape_of(const Column& column, std::int64_t rows) {
  std::vector<hsize_t> shape{static_cast<hsize_t>(rows)};
  for (const std::int64_t each : column.inner) shape.push_back(static_cast<hsize_t>(each));
  return shape;
}

std::span<const std::byte> bytes_of(const Column& column) {
  return std::visit([](const auto& values) { return std::as_bytes(std::span(values)); }, column.values);
}

std::string check_of(const ColumnTable& table) {
  Hasher hasher;
  for (const Column& column : table.columns) hasher.add(bytes_of(column));
  return to_hex(hasher.value());
}

Handle access_without_locks() {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // Locks hang or fail on many cluster file systems; the file is ours alone until it is renamed.
  if (!access || H5Pset_file_locking(access.id(), false, true) < 0) {
    throw_hdf5(ErrorCode::kInternal, "cannot turn HDF5's file locking off");
  }
  return access;
}

void write_column(hid_t file, const Column& column, std::int64_t rows, const std::string& failed) {
  const auto [memory, stored] = types_of(column.values);
  const std::vector<hsize_t> shape = shape_of(column, rows);
  const Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose);
  const Handle set(
      H5Dcreate2(file, column.name.c_str(), stored, space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      H5Dclose);
  if (!set ||
      (rows > 0 && H5Dwrite(set.id(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes_of(column).data()) < 0)) {
    throw_hdf5(ErrorCode::kIo, failed, "is the disk full?");
  }
}

std::int64_t read_column(hid_t file, Column& column, const std::filesystem::path& path, const Error& odd) {
  const Handle set = open_dataset(file, column.name, path);
  const Handle space(H5Dget_space(set.id()), H5Sclose);
  const Handle type(H5Dget_type(set.id()), H5Tclose);
  const auto [memory, stored] = types_of(column.values);
  const std::size_t rank = 1 + column.inner.size();
  std::vector<hsize_t> found(rank);
  if (H5Tequal(type.id(), stored) <= 0 || H5Sget_simple_extent_ndims(space.id()) != static_cast<int>(rank) ||
      H5Sget_simple_extent_dims(space.id(), found.data(), nullptr) != static_cast<int>(rank) ||
      found[0] > (hsize_t{1} << 40) || shape_of(column, static_cast<std::int64_t>(found[0])) != found) {
    throw odd;
  }
  const auto count = static_cast<std::size_t>(found[0]) * static_cast<std::size_t>(width_of(column));
  std::visit(
      [&](auto& values) {
        const hsize_t bytes = count * sizeof values[0];
        // A dataset that was never written has a size, but holds nothing.
        if (bytes > 0 && H5Dget_storage_size(set.id()) < bytes) throw odd;
        hsize_t file_bytes = 0;
        if (H5Fget_filesize(file, &file_bytes) < 0 || bytes > file_bytes) throw odd;
        values.resize(count);
        if (count > 0 && H5Dread(set.id(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
          throw odd;
      },
      column.values);
  return static_cast<std::int64_t>(found[0]);
}

}  // namespace

void write_column_file(const ColumnTable& table, const std::filesystem::path& path) {
  const Hdf5Use hdf5;
  for (const Column& column : table.columns) {
    const std::size_t count = std::visit([](const auto& values) { return values.size(); }, column.values);
    require(static_cast<std::int64_t>(count) == rows_of(table, column) * width_of(column),
            "all rows of every column");
  }
  const std::string failed = "cannot write " + path.string();
  const std::string hint = "is the disk full, or the folder read-only?";
  PartialFile partial(path);
  const Handle access = access_without_locks();
  Handle file(H5Fcreate(partial.path().c_str(), H5F_ACC_EXCL, H5P_DEFAULT, access.id()), H5Fclose);
  if (!file) throw_hdf5(ErrorCode::kIo, failed, hint);
  for (const auto& [name, text] : table.texts) write_attribute(file.id(), name, text);
  write_attribute(file.id(), kCheck, check_of(table));
  for (const Column& column : table.columns) {
    write_column(file.id(), column, rows_of(table, column), failed);
  }
  if (!file.reset()) throw_hdf5(ErrorCode::kIo, failed, hint);
  partial.commit();
}

ColumnTable read_column_file(const std::filesystem::path& path, const ColumnTable& wanted) {
  const Hdf5Use hdf5;
  if (!std::filesystem::exists(path)) throw Error(ErrorCode::kNotFound, "there is no file " + path.string());
  const Error odd(ErrorCode::kFormat, path.string() + " is not a whole file of this kind");
  const Handle access = access_without_locks();
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose);
  if (!file) {
    H5Eclear2(H5E_DEFAULT);
    throw odd;
  }
  const auto text_of = [&](const std::string& name) {
    std::optional<std::string> text = read_attribute(file.id(), name, path);
    if (!text) throw odd;
    return *text;
  };
  try {
    ColumnTable table = wanted;
    for (auto& [name, text] : table.texts) text = text_of(name);
    std::optional<std::int64_t> rows;
    for (Column& column : table.columns) {
      const std::int64_t found = read_column(file.id(), column, path, odd);
      if (column.own_rows) continue;
      if (rows && *rows != found) throw odd;
      rows = found;
    }
    table.rows = rows.value_or(0);
    if (text_of(kCheck) != check_of(table)) {
      throw Error(ErrorCode::kCorrupt, path.string() + " was altered: its checksum differs");
    }
    return table;
  } catch (const Error& error) {
    H5Eclear2(H5E_DEFAULT);
    // What volumes call by their own name is, for a table, a file of another kind.
    if (error.code() == ErrorCode::kFormat) throw odd;
    throw;
  }
}

}  // namespace footwall::volume
