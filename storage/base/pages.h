// Memory that starts on a page, as reads and writes past the page cache want it.
#pragma once
#include <cstddef>
#include <memory>

namespace footwall {

inline constexpr std::size_t kPageBytes = 4096;  // also where the machine's own pages are larger

struct FreePages {
  void operator()(void* memory) const;
};
using Pages = std::unique_ptr<std::byte[], FreePages>;
// At least `bytes`, whole pages, not initialised. Throws kMemory.
Pages allocate_pages(std::size_t bytes);

}  // namespace footwall
