// Memory for what is sent or received: not filled before it is written.
#pragma once
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace footwall::extract {

template <typename T>
class MessageBuffer {
 public:
  MessageBuffer() = default;
  explicit MessageBuffer(std::size_t count)
      : items_(std::make_unique_for_overwrite<T[]>(count)), count_(count) {}

  std::size_t size() const { return count_; }
  std::span<T> items() { return {items_.get(), count_}; }
  std::span<const T> items() const { return {items_.get(), count_}; }
  std::span<std::byte> bytes() { return std::as_writable_bytes(items()); }
  std::span<const std::byte> bytes() const { return std::as_bytes(items()); }

 private:
  std::unique_ptr<T[]> items_;
  std::size_t count_ = 0;
};

template <typename T>
using BufferPerRank = std::vector<MessageBuffer<T>>;

}  // namespace footwall::extract
