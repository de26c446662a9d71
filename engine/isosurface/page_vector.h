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

inline constexpr std::size_t kHugePage = std::size_t{2} << 20;

struct ReleasePages {
  std::size_t bytes = 0;
  void operator()(std::byte* memory) const;
};
using PageRoom = std::unique_ptr<std::byte, ReleasePages>;
// At least `bytes`, not initialised, advised as huge pages from 2 MiB on. Throws Error kMemory.
PageRoom page_room(std::size_t bytes);
// The same with the first `used` bytes of `room`; from 2 MiB on they are moved by page tables, not copied.
PageRoom larger_room(PageRoom room, std::size_t used, std::size_t bytes);
// Makes `room` one of `bytes`, from 2 MiB on, with the memory that it had (not what was in it) and addresses
// for the rest. False, and `room` as it was, where the system does not give that many.
bool reserve_room(std::size_t bytes, PageRoom& room);
// An advice: what cannot be made now is made when it is written. At the beginning of a huge page.
void make_huge_page(std::byte* at);
// Gives huge pages beyond the first `used` bytes back.
void trim_room(std::size_t used, PageRoom& room);

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
      room_ = larger_room(std::move(room_), std::exchange(size_, 0) * sizeof(T), wanted);
    }
    size_ = size;
  }
  // Makes room for `size` without touching it, so that it costs addresses only; growing up to there moves
  // nothing. What was there is lost. False where the system refuses.
  bool reserve(std::size_t size) {
    const std::size_t bytes = size * sizeof(T);
    const std::size_t before = room_bytes();
    size_ = 0;
    if (bytes <= before) return true;
    if (!reserve_room(bytes, room_)) return false;
    touched_ = std::max(touched_, before);
    is_reserved_ = true;
    return true;
  }
  // After reserve(): gives the addresses back that never held anything.
  void trim() {
    if (!std::exchange(is_reserved_, false)) return;
    trim_room(std::max(size_ * sizeof(T), std::exchange(touched_, 0)), room_);
  }
  // Has the system make huge page n of the room. Other threads may write there meanwhile.
  void make_page(std::size_t n) { make_huge_page(room_.get() + n * kHugePage); }
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
  std::size_t touched_ = 0;  // bytes of the room before reserve()
  bool is_reserved_ = false;
};

}  // namespace footwall::isosurface
