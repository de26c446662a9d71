// A loop over faces on the threads of one rank, with cancel, progress and one exception at the end.
#pragma once
#include <omp.h>

#include <atomic>
#include <exception>
#include <string>

#include "storage/base/job_context.h"

namespace footwall::extract {

// How long the listener of a job waits for news at the most: what it is told is also its time to look for a
// cancel from elsewhere.
inline constexpr double kReportSeconds = 0.02;

// Calls visit(thread, n) for n in [0, count); the order is not fixed. The first exception ends the loop and
// is thrown to the caller. Looks at cancel before every face; reports progress from the calling thread.
template <typename Visit>
void parallel_faces(std::size_t count, int threads, const JobContext& job, std::string_view phase,
                    Visit&& visit) {
  std::atomic<std::size_t> next{0};
  std::atomic<bool> failed{false};
  std::exception_ptr first;
#pragma omp parallel num_threads(threads)
  {
    const int thread = omp_get_thread_num();
    std::size_t reported = 0;
    double since = thread == 0 ? omp_get_wtime() : 0;
    try {
      for (std::size_t n = next++; n < count && !failed.load(std::memory_order_relaxed); n = next++) {
        job.check();
        visit(static_cast<std::size_t>(thread), n);
        if (thread != 0) continue;
        const double now = omp_get_wtime();
        if (n >= reported + count / 50 + 256 || now > since + kReportSeconds) {
          reported = n;
          since = now;
          job.report(static_cast<double>(n) / static_cast<double>(count), phase,
                     std::to_string(n) + " of " + std::to_string(count) + " faces");
        }
      }
    } catch (...) {
#pragma omp critical(footwall_parallel_faces)
      if (!failed.exchange(true)) first = std::current_exception();
    }
  }
  if (first) std::rethrow_exception(first);
}

}  // namespace footwall::extract
