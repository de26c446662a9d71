// Memory for messages, kept from one extraction to the next, and touched before there is a message in it: to
// receive into fresh pages takes several times as long.
#pragma once
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace footwall::extract {

// Bytes that grow.
class Room {
 public:
  // What is in it is lost where it grows. Throws std::bad_alloc.
  std::span<std::byte> of(std::size_t bytes);

 private:
  std::unique_ptr<std::byte[]> bytes_;
  std::size_t size_ = 0;
};

// What one message holds.
template <typename T>
struct Message {
  std::span<T> items;
  std::span<std::byte> bytes() const { return std::as_writable_bytes(items); }
  std::size_t size() const { return items.size(); }
};

// One message of each kind with each other rank. Rooms of a kind hold one type of items.
class MessageRooms {
 public:
  static constexpr std::size_t kKinds = 4;
  // What is in them is not defined. Good until the next message of this kind with this rank. Throws
  // std::bad_alloc.
  template <typename T>
  Message<T> of(std::size_t kind, std::size_t rank, std::size_t count) {
    if (rooms_.size() <= rank) rooms_.resize(rank + 1);
    const std::span<std::byte> bytes = rooms_[rank].at(kind).of(count * sizeof(T));
    return {{reinterpret_cast<T*>(bytes.data()), count}};
  }

 private:
  std::vector<std::array<Room, kKinds>> rooms_;
};

template <typename T>
using MessagePerRank = std::vector<Message<T>>;

}  // namespace footwall::extract
