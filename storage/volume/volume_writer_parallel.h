// Writes a volume file by N ranks at once: each makes, cleans, hashes and writes the chunks of its own part.
#pragma once
#include <mpi.h>

#include <filesystem>

#include "storage/volume/volume_writer.h"

namespace footwall::volume {

// Collective over comm (duplicated; ranks need the same path and options): write_volume() by all ranks. The
// bytes of the file are those that write_volume() writes, for any number of ranks and threads.
//
// Who writes what: a volume's blocks (chunk-inlines x chunk-crosslines x all samples) in their order are cut
// into one run for each rank, equal to within a block, so that no two ranks touch the same chunk. `fill` is
// asked on every rank for the blocks of that rank's run alone, in order (on ranks beyond the number of blocks
// never), and must hold no communication. Chunks are not filtered and stand at places that follow from their
// numbers: ranks write them independently, past HDF5, as write_volume()'s threads do. HDF5's own tables are
// written by rank 0, as is what takes one pass over the whole: the hashes of the live mask and of each level
// of the min/max pyramid, and the checksum, which is the hash of all chunks' hashes. What rank 0 gets for
// them is some 0.6 % of the voxels' bytes, at the end, a row at a time.
//
// Memory of a rank: that of write_volume(), and until the end 8 bytes a chunk, 1 a trace, 12 for each 8^3
// voxels of the inlines that it touches, and 4 MiB; on rank 0 8 bytes for each chunk of the volume. The
// file's folder must be one that all ranks reach, on a file system that keeps what several machines write to
// different places of one file.
//
// Cancel on any rank, and any rank's error, stop all soon: ranks look once a block, without waiting for each
// other. Throws the same Error on all ranks, that of the lowest rank with one: as write_volume(). Then there
// is no file, and one that stood there before is as it was: the file takes its name when all chunks of all
// ranks are on the disk. A killed run leaves at most a file under a temporary name (partial_file.h), which
// no reader takes for a volume. Progress is that of all ranks together, reported by each to its own job.
// Returns the same on all ranks.
VolumeInfo write_volume_parallel(MPI_Comm comm, const std::filesystem::path& path,
                                 const WriteOptions& options, const BlockSource& fill, const JobContext& job);

}  // namespace footwall::volume
