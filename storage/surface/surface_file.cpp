#include "storage/surface/surface_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "storage/volume/hdf5_handle.h"

namespace footwall::surface {
namespace {

using volume::Handle;

[[noreturn]] void not_ours(const std::filesystem::path& path, const std::string& why) {
  throw Error(ErrorCode::kFormat, fmt::format("{} is not a Footwall surface: {}", path.string(), why));
}

// A plain dataset of three values in each row; empty extents are read without asking HDF5 for bytes.
template <class T>
std::vector<T> rows_of(hid_t file, const char* name, hid_t type, const std::filesystem::path& path) {
  const Handle dataset = volume::open_dataset(file, name, path);
  const Handle space(H5Dget_space(dataset.id()), H5Sclose);
  hsize_t extent[2] = {0, 0};
  if (H5Sget_simple_extent_ndims(space.id()) != 2 ||
      H5Sget_simple_extent_dims(space.id(), extent, nullptr) != 2 || extent[1] != 3) {
    not_ours(path, fmt::format("{} does not have three columns", name));
  }
  // Its bytes must be in the file, so that a few bytes cannot ask for any amount of memory.
  const Handle stored(H5Dget_type(dataset.id()), H5Tclose);
  const std::uint64_t file_bytes = std::filesystem::file_size(path);
  const std::uint64_t row_bytes = 3 * H5Tget_size(stored.id());
  if (extent[0] > file_bytes || H5Dget_storage_size(dataset.id()) < extent[0] * row_bytes ||
      extent[0] * row_bytes > file_bytes) {
    not_ours(path, fmt::format("{} is longer than the file", name));
  }
  std::vector<T> values(static_cast<std::size_t>(extent[0] * 3));
  if (!values.empty() && H5Dread(dataset.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    volume::throw_hdf5(ErrorCode::kCorrupt, fmt::format("{} of {} cannot be read", name, path.string()));
  return values;
}

bool has(hid_t file, const char* name) {
  return H5Lexists(file, name, H5P_DEFAULT) > 0;
}

}  // namespace

StoredSurface read_surface(const std::filesystem::path& path) {
  const volume::Hdf5Use hdf5;
  std::error_code failure;
  if (!std::filesystem::is_regular_file(path, failure))
    throw Error(ErrorCode::kNotFound, fmt::format("there is no file {}", path.string()));
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  const Handle file = volume::open_file_read_only(path, access.id());
  const auto version = volume::read_attribute(file.id(), "footwall_surface", path);
  if (!version) not_ours(path, "it has no attribute footwall_surface");
  if (*version != kVersion) {
    throw Error(ErrorCode::kUnsupported,
                fmt::format("{} has version {} of surface files; this program reads {}", path.string(),
                            *version, kVersion),
                "use a newer Footwall");
  }
  StoredSurface surface;
  surface.description = volume::read_attribute(file.id(), "description", path).value_or("{}");
  {
    const Handle positions = volume::open_dataset(file.id(), "/positions", path);
    const Handle type(H5Dget_type(positions.id()), H5Tclose);
    surface.world = H5Tget_size(type.id()) == sizeof(double);
  }
  surface.positions = rows_of<double>(file.id(), "/positions", H5T_NATIVE_DOUBLE, path);
  if (has(file.id(), "/normals"))
    surface.normals = rows_of<float>(file.id(), "/normals", H5T_NATIVE_FLOAT, path);
  surface.triangles = rows_of<std::uint32_t>(file.id(), "/triangles", H5T_NATIVE_UINT32, path);
  const std::size_t vertices = surface.positions.size() / 3;
  if (!surface.normals.empty() && surface.normals.size() != surface.positions.size())
    not_ours(path, "it has not one normal for each vertex");
  if (std::any_of(surface.triangles.begin(), surface.triangles.end(),
                  [&](std::uint32_t vertex) { return vertex >= vertices; })) {
    not_ours(path, "a triangle names a vertex that is not there");
  }
  return surface;
}

}  // namespace footwall::surface
