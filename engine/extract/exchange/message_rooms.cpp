#include "engine/extract/exchange/message_rooms.h"

namespace footwall::extract {

std::span<std::byte> Room::of(std::size_t bytes) {
  if (size_ < bytes) {
    size_ = 0;
    bytes_.reset();                                 // not both at once
    bytes_ = std::make_unique<std::byte[]>(bytes);  // touches every page
    size_ = bytes;
  }
  return {bytes_.get(), bytes};
}

}  // namespace footwall::extract
