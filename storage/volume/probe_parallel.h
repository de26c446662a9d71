// A small proof that parallel HDF5 works in a folder: all ranks write one file together and read it back.
#pragma once
#include <mpi.h>

#include <filesystem>
#include <string>

namespace footwall::volume {

struct HdfVersions {
  std::string compiled;  // of the headers, e.g. "1.10.8"
  std::string running;   // of the library
};
HdfVersions hdf5_versions();

// Collective. Writes `file` (which must not exist) through MPI-IO, collectively, a block of a megabyte for
// each rank, closes it, reads on each rank the block of the next one, and compares; removes the file. Throws
// the same Error on all ranks: kIo where it cannot be made, kCorrupt where other values come back than were
// written.
void probe_parallel_hdf5(MPI_Comm comm, const std::filesystem::path& file);

}  // namespace footwall::volume
