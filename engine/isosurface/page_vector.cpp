#include "engine/isosurface/page_vector.h"

#include <sys/mman.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "storage/base/error.h"

namespace footwall::isosurface {
namespace {

constexpr std::size_t kHugePage = std::size_t{2} << 20;
constexpr std::size_t kLine = 64;

std::size_t rounded_up(std::size_t bytes, std::size_t to) {
  return (bytes + to - 1) / to * to;
}

[[noreturn]] void refuse(std::size_t bytes) {
  throw Error(ErrorCode::kMemory, fmt::format("there is no room for {} MiB of a surface", bytes >> 20),
              "take a part of the volume (--box), or more ranks");
}

// Straight from the system and not through malloc(), which would put a header in front of huge pages and
// gives freed memory back when it likes. Alignment by mapping a huge page more and giving back what is over.
std::byte* map(std::size_t bytes) {
  const std::size_t whole = bytes + kHugePage;
  void* const mapped = mmap(nullptr, whole, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (mapped == MAP_FAILED) refuse(bytes);
  auto* const first = static_cast<std::byte*>(mapped);
  const std::size_t ahead =
      rounded_up(reinterpret_cast<std::size_t>(first), kHugePage) - reinterpret_cast<std::size_t>(first);
  if (ahead > 0) munmap(first, ahead);
  munmap(first + ahead + bytes, kHugePage - ahead);
  madvise(first + ahead, bytes, MADV_HUGEPAGE);  // an advice: it may be refused
  return first + ahead;
}

}  // namespace

void ReleasePages::operator()(std::byte* memory) const {
  if (bytes < kHugePage) {
    std::free(memory);
  } else {
    munmap(memory, bytes);
  }
}

PageRoom page_room(std::size_t bytes) {
  if (bytes > PTRDIFF_MAX / 2) refuse(bytes);
  if (bytes >= kHugePage) {
    const std::size_t whole = rounded_up(bytes, kHugePage);
    return {map(whole), ReleasePages{whole}};
  }
  const std::size_t whole = std::max(rounded_up(bytes, kLine), kLine);
  void* const memory = std::aligned_alloc(kLine, whole);
  if (memory == nullptr) refuse(bytes);
  return {static_cast<std::byte*>(memory), ReleasePages{whole}};
}

PageRoom larger_room(PageRoom room, std::size_t used, std::size_t bytes) {
  PageRoom larger = page_room(bytes);
  const std::size_t old_bytes = room == nullptr ? 0 : room.get_deleter().bytes;
  if (old_bytes < kHugePage) {
    if (used > 0) std::memcpy(larger.get(), room.get(), used);
    return larger;
  }
  // Both stand on the border of a huge page, so that whole tables of pages are moved.
  const std::size_t moved = rounded_up(used, kHugePage);
  if (moved > 0 &&
      mremap(room.get(), moved, moved, MREMAP_MAYMOVE | MREMAP_FIXED, larger.get()) == MAP_FAILED) {
    refuse(bytes);
  }
  std::byte* const rest = room.release() + moved;
  if (moved < old_bytes) munmap(rest, old_bytes - moved);
  return larger;
}

}  // namespace footwall::isosurface
