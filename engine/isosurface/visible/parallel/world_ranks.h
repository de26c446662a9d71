// The ranks of a communicator, as a drawing of only what can be seen takes them.
#pragma once
#include <utility>

#include "engine/comm/communicator.h"
#include "engine/isosurface/visible/ranks.h"
#include "storage/base/job_context.h"

namespace footwall::isosurface {

// Errors are thrown on all ranks alike (AgreedError); kCancelled by every together() once the job of any rank
// was cancelled, so that all leave at the same point. Messages are counted in the communicator's traffic.
class WorldRanks final : public Ranks {
 public:
  explicit WorldRanks(comm::Communicator& world, JobContext job = {}) : world_(world), job_(std::move(job)) {}

  int rank() const override { return world_.rank(); }
  int size() const override { return world_.size(); }
  void together(const std::function<void()>& work) override;
  void least(std::span<render::CoarseDepth> values) override;
  void most(std::span<std::int64_t> values) override;
  void sum(std::span<std::int64_t> values) override;
  void any(std::span<std::uint64_t> bits) override;
  std::vector<std::int64_t> all(std::span<const std::int64_t> values) override;
  std::vector<std::vector<std::byte>> exchange(std::vector<std::vector<std::byte>> bytes) override;

 private:
  void reduce(void* values, std::size_t count, MPI_Datatype type, MPI_Op operation, std::size_t bytes);

  comm::Communicator& world_;
  JobContext job_;
};

}  // namespace footwall::isosurface
