#include "engine/service/resident/host_memory.h"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <array>
#include <limits>

#include "storage/base/error.h"
#include "storage/base/usable_memory.h"

namespace footwall::service {

std::string in_words(std::int64_t bytes) {
  constexpr double kMiB = 1 << 20;
  const auto mebibytes = static_cast<double>(std::max<std::int64_t>(bytes, 0)) / kMiB;
  return mebibytes < 1024 ? fmt::format("{:.1f} MiB", mebibytes)
                          : fmt::format("{:.1f} GiB", mebibytes / 1024);
}

HostMemory::Short HostMemory::look(std::int64_t own) const {
  struct Rank {
    std::int64_t needed, held, free;
  };
  const Held has = held();
  const Rank mine{own, has.stays + has.kept, usable_memory().bytes};
  std::vector<Rank> all(static_cast<std::size_t>(world_.size()));
  comm::check(MPI_Allgather(&mine, 3, MPI_INT64_T, all.data(), 3, MPI_INT64_T, world_.get()),
              "MPI_Allgather");
  Short worst;
  for (std::size_t host = 0; host < all.size(); ++host) {
    if (host_of_[host] != static_cast<int>(host)) continue;
    Rank sum{0, 0, std::numeric_limits<std::int64_t>::max()};
    for (std::size_t rank = 0; rank < all.size(); ++rank) {
      if (host_of_[rank] != static_cast<int>(host)) continue;
      sum.needed += all[rank].needed;
      sum.held += all[rank].held;
      sum.free = std::min(sum.free, all[rank].free);
    }
    if (host_bytes_ > 0) sum.free = std::min(sum.free, host_bytes_ - sum.held);
    if (sum.needed - sum.free > std::max<std::int64_t>(0, worst.needed - worst.free))
      worst = {sum.needed, sum.free};
  }
  return worst;
}

void HostMemory::require_free(std::int64_t own, const std::string& what, const std::string& hint) const {
  if (look(own).needed == 0) return;
  drop();
  const Short lacking = look(own);
  world_.collectively([&] {
    if (lacking.needed == 0) return;
    throw Error(ErrorCode::kMemory,
                fmt::format("{} needs {} on this host, {} are free", what, in_words(lacking.needed),
                            in_words(lacking.free)),
                hint);
  });
}

}  // namespace footwall::service
