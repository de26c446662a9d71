// A loop on several threads whose body may throw.
#pragma once
#include <omp.h>

#include <cstdint>
#include <exception>
#include <mutex>

namespace footwall::isosurface::detail {

// body(n, thread) for n = 0 .. count - 1, in any order. The first exception is thrown on, after the loop.
template <class Body>
void for_each_in_parallel(std::int64_t count, int threads, Body&& body) {
  std::exception_ptr thrown;
  std::mutex lock;
#pragma omp parallel for num_threads(threads) schedule(dynamic) if (threads > 1)
  for (std::int64_t n = 0; n < count; ++n) {
    try {
      body(n, omp_get_thread_num());
    } catch (...) {
      const std::scoped_lock held(lock);
      if (thrown == nullptr) thrown = std::current_exception();
    }
  }
  if (thrown != nullptr) std::rethrow_exception(thrown);
}

}  // namespace footwall::isosurface::detail
