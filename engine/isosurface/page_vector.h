// Room for large arrays that are written once from end to end: not initialised, on huge pages where the
// system has them, kept when the size shrinks.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>

namespace footwall::isosurface {

struct ReleasePages {
  std::size_t bytes = 0;
  void operator()(std::byte* memory) const;
};
using PageRoom = std::unique_ptr<std::byte, ReleasePages>;
// At least `bytes`, not initialised, advised as huge pages from 2 MiB on. Throws Error kMemory.
PageRoom page_room(std::size_t bytes);
// The same with the first `used` bytes of `room`; from 2 MiB on they are moved by page tables, not copied.
PageRoom larger_room(PageRoom room, std::size_t used, std::size_t bytes);

template <class T>
class PageVector {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  // What was there is lost if the room has to grow.
  void resize_uninitialised(std::size_t size) {
    if (size * sizeof(T) > room_.get_deleter().bytes || room_ == nullptr) room_ = page_room(size * sizeof(T));
    size_ = size;
  }
  // What was there stays. The room doubles when it has to grow, and soon takes whole huge pages.
  void grow(std::size_t size) {
    const std::size_t bytes = size * sizeof(T);
    if (bytes > room_bytes() || room_ == nullptr) {
      const std::size_t doubled = std::max({bytes, 2 * room_bytes(), std::size_t{1} << 16});
      const std::size_t wanted =
          doubled > std::size_t{1} << 16 ? std::max(doubled, std::size_t{2} << 20) : doubled;
      room_ = larger_room(std::move(room_), size_ * sizeof(T), wanted);
    }
    size_ = size;
  }
  void release() {
    room_.reset();
    size_ = 0;
  }
  T* data() { return reinterpret_cast<T*>(room_.get()); }
  const T* data() const { return reinterpret_cast<const T*>(room_.get()); }
  T& operator[](std::size_t n) { return data()[n]; }
  const T& operator[](std::size_t n) const { return data()[n]; }
  std::span<T> all() { return {data(), size_}; }
  std::span<const T> all() const { return {data(), size_}; }
  std::size_t room_bytes() const { return room_ == nullptr ? 0 : room_.get_deleter().bytes; }

 private:
  PageRoom room_;
  std::size_t size_ = 0;
};

}  // namespace footwall::isosurface
