#include "engine/service/client/detail/left_calls.h"

#include <mutex>
#include <utility>
#include <vector>

namespace footwall::service {

void keep_until_over(std::unique_ptr<LeftCall> call) {
  // Of the whole process, and never destroyed: gRPC's threads may still use what is in here when the program
  // ends.
  static auto& mutex = *new std::mutex;
  static auto& kept = *new std::vector<std::unique_ptr<LeftCall>>;
  std::vector<std::unique_ptr<LeftCall>> over;
  const std::scoped_lock lock(mutex);
  std::vector<std::unique_ptr<LeftCall>> still;
  for (std::unique_ptr<LeftCall>& one : kept) (one->is_over() ? over : still).push_back(std::move(one));
  kept = std::move(still);
  kept.push_back(std::move(call));
}

}  // namespace footwall::service
