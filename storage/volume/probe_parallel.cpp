#include "storage/volume/probe_parallel.h"

#include <fmt/format.h>

#include <vector>

#include "storage/volume/hdf5_handle.h"
#include "storage/volume/mpi_agreement.h"

namespace footwall::volume {
namespace {

constexpr hsize_t kValues = 1U << 18;  // a megabyte for each rank

// What rank `rank` writes at place n: different for every rank and place.
float value_at(int rank, hsize_t n) {
  return static_cast<float>(rank * 7919 + static_cast<int>(n % 65521));
}

// The ranks' blocks, one after another.
class Blocks {
 public:
  Blocks(hid_t file, int ranks, bool fresh) {
    const hsize_t extent = kValues * static_cast<hsize_t>(ranks);
    space_ = {H5Screate_simple(1, &extent, nullptr), H5Sclose};
    const hid_t id =
        fresh ? H5Dcreate2(file, "probe", H5T_IEEE_F32LE, space_.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)
              : H5Dopen2(file, "probe", H5P_DEFAULT);
    dataset_ = {id, H5Dclose};
    memory_ = {H5Screate_simple(1, &kValues, nullptr), H5Sclose};
    transfer_ = {H5Pcreate(H5P_DATASET_XFER), H5Pclose};
  }
  bool write(int rank, const std::vector<float>& values) {
    return select(rank) && H5Dwrite(dataset_.id(), H5T_NATIVE_FLOAT, memory_.id(), space_.id(),
                                    transfer_.id(), values.data()) >= 0;
  }
  bool read(int rank, std::vector<float>& values) {
    return select(rank) && H5Dread(dataset_.id(), H5T_NATIVE_FLOAT, memory_.id(), space_.id(), transfer_.id(),
                                   values.data()) >= 0;
  }

 private:
  bool select(int rank) {
    const hsize_t start = kValues * static_cast<hsize_t>(rank);
    return dataset_ && H5Pset_dxpl_mpio(transfer_.id(), H5FD_MPIO_COLLECTIVE) >= 0 &&
           H5Sselect_hyperslab(space_.id(), H5S_SELECT_SET, &start, nullptr, &kValues, nullptr) >= 0;
  }
  Handle space_, memory_, transfer_, dataset_;
};

void require_good(bool good, const std::string& doing, const std::filesystem::path& file) {
  if (!good) {
    throw Error(ErrorCode::kIo,
                fmt::format("parallel HDF5 cannot {} {}: {}", doing, file.string(), last_hdf5_reason()),
                "choose a folder on a file system that all ranks reach");
  }
}

}  // namespace

HdfVersions hdf5_versions() {
  unsigned major = 0;
  unsigned minor = 0;
  unsigned release = 0;
  H5get_libversion(&major, &minor, &release);
  return {fmt::format("{}.{}.{}", H5_VERS_MAJOR, H5_VERS_MINOR, H5_VERS_RELEASE),
          fmt::format("{}.{}.{}", major, minor, release)};
}

void probe_parallel_hdf5(MPI_Comm parent, const std::filesystem::path& path) {
  quiet_hdf5();
  const OwnCommunicator comm(parent);
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_mpio(access.id(), comm.get(), MPI_INFO_NULL);
  std::vector<float> values(kValues);

  // HDF5 fails on all ranks or on one alone; every step agrees before the next one communicates.
  Handle file;
  const auto step = [&](const std::function<void()>& f) { agree(comm, outcome_of(f)); };
  const auto opened = [&](bool fresh) {
    const hid_t id = fresh ? H5Fcreate(path.c_str(), H5F_ACC_EXCL, H5P_DEFAULT, access.id())
                           : H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id());
    step([&] {
      file = Handle(id, H5Fclose);
      require_good(static_cast<bool>(file), fresh ? "make" : "open", path);
    });
  };
  // 1. Written together.
  opened(true);
  bool good = false;
  {
    for (hsize_t n = 0; n < kValues; ++n) values[n] = value_at(comm.rank(), n);
    Blocks blocks(file.id(), comm.size(), true);
    good = blocks.write(comm.rank(), values);
  }
  good = file.reset() && good;
  step([&] { require_good(good, "write", path); });

  // 2. Read together, each rank what its neighbour wrote.
  const int neighbour = (comm.rank() + 1) % comm.size();
  opened(false);
  {
    Blocks blocks(file.id(), comm.size(), false);
    good = blocks.read(neighbour, values);
  }
  good = file.reset() && good;
  if (comm.rank() == 0) {
    std::error_code ignored;  // the folder goes as a whole
    std::filesystem::remove(path, ignored);
  }
  step([&] {
    require_good(good, "read", path);
    for (hsize_t n = 0; n < kValues; ++n) {
      if (values[n] == value_at(neighbour, n)) continue;
      throw Error(ErrorCode::kCorrupt,
                  fmt::format("{}: rank {} wrote {} and rank {} read {}", path.string(), neighbour,
                              value_at(neighbour, n), comm.rank(), values[n]),
                  "this file system does not keep what parallel programs write; choose another folder");
    }
  });
}

}  // namespace footwall::volume
