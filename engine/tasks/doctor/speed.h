// How fast a folder is written and read.
#pragma once
#include <cstdint>
#include <filesystem>

#include "storage/base/job_context.h"

namespace footwall::tasks {

struct Speed {
  std::int64_t bytes = 0;  // written and read
  double write_mb_s = 0;   // 10^6 bytes a second, flushed to the disk
  double read_mb_s = 0;    // not from this machine's memory, as far as the system can be asked for that
};

// Writes at most `bytes` (ends early after 10 s), reads them back and compares, removes the file. Throws kIo,
// kCorrupt where other bytes come back, kCancelled.
Speed measure_speed(const std::filesystem::path& folder, std::int64_t bytes, const JobContext& job);

// What may be written for a measurement in a folder with so much free space: a tenth of it, 256 MiB at most,
// whole blocks; 0 below 16 MiB.
std::int64_t bytes_to_measure(std::int64_t free_bytes);

}  // namespace footwall::tasks
