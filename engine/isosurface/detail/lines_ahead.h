// Lines of the cache that will be read soon, in any order, asked for a few at a time between other work.
#pragma once
#include <hwy/cache_control.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace footwall::isosurface::detail {

class LinesAhead {
 public:
  // Room for `lines` more; they count once add() is called. Addresses need not be good ones.
  const float** room(std::size_t lines) {
    if (lines_.size() < count_ + lines) lines_.resize(2 * (count_ + lines));
    return lines_.data() + count_;
  }
  void add(std::size_t lines) { count_ += lines; }

  // Asks for so many of them, or those that are left.
  void ask(std::size_t lines) {
    const std::size_t end = std::min(next_ + lines, count_);
    for (; next_ < end; ++next_) hwy::Prefetch(lines_[next_]);
  }
  // Asks for all that are left, and forgets them.
  void ask_all() {
    ask(count_);
    count_ = next_ = 0;
  }

 private:
  std::vector<const float*> lines_;
  std::size_t next_ = 0;
  std::size_t count_ = 0;
};

}  // namespace footwall::isosurface::detail
