// What a job would need, told without running it: `extract --dry-run`.
#pragma once
#include <string>
#include <vector>

#include "engine/session/job.h"
#include "engine/session/launch.h"

namespace footwall::tasks {

struct Forecast {
  std::vector<std::string> command;
  std::string launcher;  // why this one
  int ranks = 1, threads = 1;
  std::int64_t faces = 0;
  std::int64_t voxels = 0;
  bool voxels_exact = true;       // else from an even sample of faces
  double load_max_over_mean = 1;  // of the voxels in each rank's part of the survey, by face centroids
  // Bytes that the rank with the most needs.
  struct Memory {
    std::int64_t program = 0;   // the program itself, MPI and HDF5
    std::int64_t bricks = 0;    // its part of the volume with a halo
    std::int64_t reading = 0;   // what is read at once, on its way to the bricks
    std::int64_t mesh = 0;      // all faces, on every rank
    std::int64_t exchange = 0;  // partial sums or voxels, sent and received, and the results at rank 0
    std::int64_t total() const { return program + bricks + reading + mesh + exchange; }
  } memory;
  std::int64_t bytes_to_read = 0;  // by all ranks: whole chunks, halos included
  struct {
    double start = 0, read = 0, compute = 0, write = 0;
    double total() const { return start + read + compute + write; }
  } seconds;
  std::string based_on;  // what the seconds are based on, in words
};

// `cores`: processors that the ranks will share; 0 = one for each of their threads. Reads a piece of the
// volume and folds the faces in it for at most about half a second. Throws what VolumeReader throws, kMemory,
// kCancelled.
Forecast forecast(const session::Job& job, const session::LaunchOptions& launch,
                  const std::filesystem::path& job_path, int cores, const JobContext& context);

}  // namespace footwall::tasks
