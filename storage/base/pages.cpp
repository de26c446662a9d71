#include "storage/base/pages.h"

#include <fmt/format.h>

#include <cstdlib>

#include "storage/base/error.h"

namespace footwall {

void FreePages::operator()(void* memory) const {
  std::free(memory);
}

Pages allocate_pages(std::size_t bytes) {
  void* memory = std::aligned_alloc(kPageBytes, (bytes + kPageBytes - 1) / kPageBytes * kPageBytes);
  if (memory == nullptr) {
    throw Error(ErrorCode::kMemory, fmt::format("there is no memory for a buffer of {} MiB", bytes >> 20));
  }
  return Pages(static_cast<std::byte*>(memory));
}

}  // namespace footwall
