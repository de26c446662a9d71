// A message as it came: a client's bytes, and what they would take as a message in memory. That can be far
// more than they are: an empty message within a message is two bytes on the wire.
#pragma once
#include <google/protobuf/io/zero_copy_stream.h>
#include <google/protobuf/message.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace footwall::service {

// An upper bound of the memory that a message of the type takes once it is unpacked, fields that nobody knows
// included, without unpacking it. It stops early, with more than `most`. Throws Error kInvalid where the
// bytes are no such message.
std::int64_t unpacked_bytes(std::string_view wire, const google::protobuf::Descriptor& type,
                            std::int64_t most);

class Parcel {
 public:
  // A message may take so much memory: four times the largest one on the wire. Faces take up to three times.
  static constexpr std::int64_t kMost = std::int64_t{256} << 20;

  // The stream's `size` bytes; must not outlive the stream. Throws Error kInvalid where they are no message
  // of the type, kMemory where it would take more than kMost.
  Parcel(google::protobuf::io::ZeroCopyInputStream& bytes, std::int64_t size,
         const google::protobuf::Descriptor& type);
  Parcel(const Parcel&) = delete;
  Parcel& operator=(const Parcel&) = delete;

  std::int64_t memory_bytes() const { return memory_bytes_; }
  // Throws Error kInvalid where the bytes are no such message.
  void unpack(google::protobuf::Message& into) const;

 private:
  std::string joined_;  // where they came in pieces
  std::string_view wire_;
  std::int64_t memory_bytes_ = 0;
};

}  // namespace footwall::service
