#include "storage/surface/surface_writer_parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "storage/base/partial_file.h"
#include "storage/volume/chunk_output.h"
#include "storage/volume/hdf5_handle.h"
#include "storage/volume/mpi_agreement.h"
#include "storage/volume/volume_file.h"

namespace footwall::surface {
namespace {

using volume::Handle;
using volume::outcome_of;

// Where the rows of each dataset begin in the file.
struct Places {
  std::int64_t positions = 0;
  std::int64_t normals = 0;
  std::int64_t triangles = 0;
};

std::int64_t create_rows(hid_t file, const char* name, hid_t type, std::uint64_t rows) {
  const Handle dataset = volume::create_plain(file, name, type, {rows, 3});
  if (rows == 0) return 0;
  const haddr_t place = H5Dget_offset(dataset.id());
  if (place == HADDR_UNDEF)
    volume::throw_hdf5(ErrorCode::kInternal, fmt::format("HDF5 does not say where {} is", name));
  return static_cast<std::int64_t>(place);
}

Places create_file(const std::filesystem::path& path, const SurfaceSize& size,
                   const std::string& description) {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_libver_bounds(access.id(), H5F_LIBVER_V110, H5F_LIBVER_V110);
  H5Pset_file_locking(access.id(), false, true);
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.id(), false);
  Handle file(H5Fcreate(path.c_str(), H5F_ACC_EXCL, creation.id(), access.id()), H5Fclose);
  if (!file) volume::throw_hdf5(ErrorCode::kIo, fmt::format("cannot create {}", path.string()));
  volume::write_attribute(file.id(), "footwall_surface", kVersion);
  volume::write_attribute(file.id(), "description", description);
  Places places;
  places.positions =
      create_rows(file.id(), "/positions", size.world ? H5T_IEEE_F64LE : H5T_IEEE_F32LE, size.vertices);
  if (size.normals) places.normals = create_rows(file.id(), "/normals", H5T_IEEE_F32LE, size.vertices);
  places.triangles = create_rows(file.id(), "/triangles", H5T_STD_U32LE, size.triangles);
  if (!file.reset()) volume::throw_hdf5(ErrorCode::kIo, fmt::format("cannot write {}", path.string()));
  return places;
}

template <class T>
void put(const volume::ChunkOutput& output, std::int64_t place, std::uint64_t first_row,
         std::span<const T> values) {
  if (values.empty()) return;
  output.write(place + static_cast<std::int64_t>(first_row * 3 * sizeof(T)), std::as_bytes(values));
}

}  // namespace

void write_surface_parallel(MPI_Comm parent, const std::filesystem::path& path, const SurfaceSize& size,
                            const std::string& description, const SurfaceShare& share) {
  const volume::OwnCommunicator comm(parent);
  std::optional<PartialFile> file;
  std::string name;
  std::array<std::int64_t, 3> places{};
  // 1. Rank 0 makes the file.
  volume::agree(comm, outcome_of([&] {
                  if (comm.rank() != 0) return;
                  const volume::Hdf5Use hdf5;
                  file.emplace(path);
                  const Places made = create_file(file->path(), size, description);
                  places = {made.positions, made.normals, made.triangles};
                  name = file->path().string();
                }));
  volume::broadcast(comm, name);
  volume::check_mpi(MPI_Bcast(places.data(), 3, MPI_INT64_T, 0, comm.get()), "MPI_Bcast");
  // 2. Each rank writes its rows.
  volume::agree(comm, outcome_of([&] {
                  const volume::ChunkOutput output(name);
                  put(output, places[0], share.first_vertex, share.positions);
                  put(output, places[0], share.first_vertex, share.world_positions);
                  put(output, places[1], share.first_vertex, share.normals);
                  put(output, places[2], share.first_triangle, share.triangles);
                  output.flush();
                }));
  // 3. The file is whole.
  volume::agree(comm, outcome_of([&] {
                  if (file) file->commit();
                }));
}

}  // namespace footwall::surface
