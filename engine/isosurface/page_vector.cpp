#include "engine/isosurface/page_vector.h"

#include <sys/mman.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "storage/base/error.h"

namespace footwall::isosurface {
namespace {

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
// Null where the system refuses.
std::byte* map(std::size_t bytes, int flags = 0) {
  const std::size_t whole = bytes + kHugePage;
  void* const mapped =
      mmap(nullptr, whole, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | flags, -1, 0);
  if (mapped == MAP_FAILED) return nullptr;
  auto* const first = static_cast<std::byte*>(mapped);
  const std::size_t ahead =
      rounded_up(reinterpret_cast<std::size_t>(first), kHugePage) - reinterpret_cast<std::size_t>(first);
  if (ahead > 0) munmap(first, ahead);
  munmap(first + ahead + bytes, kHugePage - ahead);
  madvise(first + ahead, bytes, MADV_HUGEPAGE);  // an advice: it may be refused
  return first + ahead;
}

std::size_t room_bytes(const PageRoom& room) {
  return room == nullptr ? 0 : room.get_deleter().bytes;
}

// Both stand on the border of a huge page, so that whole tables of pages are moved; in the place of what was
// mapped there, and with it what comes behind, so that it stays one mapping and can be moved again.
bool move_pages(PageRoom& from, PageRoom& into) {
  if (mremap(from.get(), room_bytes(from), room_bytes(into), MREMAP_MAYMOVE | MREMAP_FIXED, into.get()) ==
      MAP_FAILED) {
    return false;
  }
  static_cast<void>(from.release());
  return true;
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
  const std::size_t lines = std::max(rounded_up(bytes, kLine), kLine);
  if (lines >= kHugePage) {
    const std::size_t whole = rounded_up(lines, kHugePage);
    std::byte* const memory = map(whole);
    if (memory == nullptr) refuse(bytes);
    return {memory, ReleasePages{whole}};
  }
  void* const memory = std::aligned_alloc(kLine, lines);
  if (memory == nullptr) refuse(bytes);
  return {static_cast<std::byte*>(memory), ReleasePages{lines}};
}

PageRoom larger_room(PageRoom room, std::size_t used, std::size_t bytes) {
  PageRoom larger = page_room(bytes);
  if (room_bytes(room) < kHugePage) {
    if (used > 0) std::memcpy(larger.get(), room.get(), used);
    return larger;
  }
  if (!move_pages(room, larger)) refuse(bytes);
  return larger;
}

bool reserve_room(std::size_t bytes, PageRoom& room) {
  if (bytes > PTRDIFF_MAX / 2) return false;
  if (bytes < kHugePage) {
    room = page_room(bytes);
    return true;
  }
  const std::size_t whole = rounded_up(bytes, kHugePage);
  std::byte* const memory = map(whole, MAP_NORESERVE);
  if (memory == nullptr) return false;
  PageRoom larger{memory, ReleasePages{whole}};
  if (room_bytes(room) >= kHugePage && !move_pages(room, larger)) return false;
  room = std::move(larger);
  return true;
}

void make_huge_page(std::byte* at) {
  madvise(at, kHugePage, MADV_POPULATE_WRITE);
}

void trim_room(std::size_t used, PageRoom& room) {
  const std::size_t kept = rounded_up(used, kHugePage);
  const std::size_t bytes = room_bytes(room);
  if (bytes < kHugePage || kept >= bytes) return;
  if (kept == 0) {
    room.reset();
    return;
  }
  munmap(room.get() + kept, bytes - kept);
  room.get_deleter().bytes = kept;
}

}  // namespace footwall::isosurface
