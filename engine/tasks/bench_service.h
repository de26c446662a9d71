// What the user of a running engine waits for: from the call on the client to the answer on the client, over
// the socket. `footwall bench service`.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/session/launch.h"
#include "storage/base/job_context.h"

namespace footwall::tasks {

struct ServiceBench {
  session::LaunchOptions launch;       // ranks 0: 2
  std::int64_t faces = 10000;          // of the model, at least
  std::int64_t moves = 10000;          // of one vertex, timed one by one; at least 1
  std::int64_t memory_moves = 100000;  // with those before: how many until memory is looked at again
  std::int64_t many_faces = 1000;      // touched by a large batch
  int batches = 100;                   // large ones; at least 1
  std::int64_t volume_bytes = std::int64_t{1} << 30;  // of the served project; 0: not measured
  int starts = 3;                                     // of `serve`, after one that does not count
  int rings = 500;
  int pictures = 20;  // 0: not measured
  double idle_seconds = 5;
};

struct ServiceFigure {
  std::string name;            // for programs: "move_p99"
  std::string what;            // in words
  double value = 0;            // the one that the goal is about
  std::string unit;            // "ms", "s", "MiB", "% of a core"
  std::optional<double> goal;  // to stay below; none: for information
  std::string more;            // other figures of the same, in words
};

// Starts engines of its own, in a folder that is removed. Before times count, the numbers of all faces on the
// client are those of a fresh engine of one rank (check.h), and after the last move again; pictures are those
// of one rank. Throws kInternal where they are not, kUsage for amounts that cannot be, what the engine
// throws, kCancelled.
std::vector<ServiceFigure> bench_service(const ServiceBench& bench, const JobContext& job);

}  // namespace footwall::tasks
