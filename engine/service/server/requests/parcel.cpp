#include "engine/service/server/requests/parcel.h"

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/stubs/logging.h>
#include <google/protobuf/unknown_field_set.h>
#include <google/protobuf/wire_format_lite.h>

#include <algorithm>
#include <unordered_map>

#include "storage/base/error.h"

namespace footwall::service {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::UnknownField;
using google::protobuf::UnknownFieldSet;
using google::protobuf::internal::WireFormatLite;
using google::protobuf::io::CodedInputStream;

// As protobuf's own parser.
constexpr int kDeepest = 100;
// What the allocator adds to each piece.
constexpr std::int64_t kPiece = 16;
// Arrays grow twofold, and begin with room for a few.
constexpr std::int64_t kGrowth = 2;
constexpr std::int64_t kFirstRoom = 64;

Error no_message(const Descriptor& type) {
  return {ErrorCode::kInvalid, fmt::format("the message is not a {}", type.name()),
          "client and engine may be of different versions"};
}

std::int64_t string_bytes(std::int64_t length) {
  constexpr std::int64_t kWithin = 15;  // the string itself holds
  return kPiece + static_cast<std::int64_t>(sizeof(std::string)) +
         (length > kWithin ? kPiece + std::max(2 * kWithin, length) + 1 : 0);
}

std::int64_t width_of(const FieldDescriptor& field) {
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_BOOL:
      return 1;
    case FieldDescriptor::CPPTYPE_INT32:
    case FieldDescriptor::CPPTYPE_UINT32:
    case FieldDescriptor::CPPTYPE_FLOAT:
    case FieldDescriptor::CPPTYPE_ENUM:
      return 4;
    default:
      return 8;
  }
}

WireFormatLite::WireType wire_type_of(const FieldDescriptor& field) {
  return WireFormatLite::WireTypeForFieldType(static_cast<WireFormatLite::FieldType>(field.type()));
}

// Numbers in a packed array.
std::int64_t count_in(std::string_view packed, const FieldDescriptor& field) {
  switch (wire_type_of(field)) {
    case WireFormatLite::WIRETYPE_FIXED32:
      return static_cast<std::int64_t>(packed.size() / 4);
    case WireFormatLite::WIRETYPE_FIXED64:
      return static_cast<std::int64_t>(packed.size() / 8);
    default:
      return std::count_if(packed.begin(), packed.end(), [](char byte) { return (byte & 0x80) == 0; });
  }
}

// Walks the fields and adds up what they take.
class Scan {
 public:
  explicit Scan(std::int64_t most) : most_(most) {}

  std::int64_t bytes() const { return bytes_; }
  // Whether the bytes are one message of the type, as far as they were looked at.
  bool message(std::string_view wire, const Descriptor& type, int depth) {
    if (depth > kDeepest) return false;
    bytes_ += size_of(type);
    CodedInputStream in(reinterpret_cast<const std::uint8_t*>(wire.data()), static_cast<int>(wire.size()));
    std::uint64_t seen = 0;  // fields, by their place
    while (bytes_ <= most_) {
      const std::uint32_t tag = in.ReadTagNoLastTag();
      if (tag == 0) return in.CurrentPosition() == static_cast<int>(wire.size());
      const FieldDescriptor* field = type.FindFieldByNumber(WireFormatLite::GetTagFieldNumber(tag));
      if (!(field != nullptr ? known(in, *field, tag, seen, depth) : unknown(in, tag, depth))) return false;
    }
    return true;
  }

 private:
  std::int64_t size_of(const Descriptor& type) {
    const auto [at, is_new] = sizes_.try_emplace(&type, 0);
    if (is_new) {
      at->second =
          kPiece +
          static_cast<std::int64_t>(
              google::protobuf::MessageFactory::generated_factory()->GetPrototype(&type)->SpaceUsedLong());
    }
    return at->second;
  }

  static bool take(CodedInputStream& in, std::string_view& part) {
    std::uint32_t length = 0;
    const void* at = nullptr;
    int left = 0;
    if (!in.ReadVarint32(&length) || length > std::numeric_limits<int>::max()) return false;
    if (length == 0) {
      part = {};
      return true;
    }
    if (!in.GetDirectBufferPointer(&at, &left) || static_cast<std::uint32_t>(left) < length) return false;
    part = {static_cast<const char*>(at), length};
    return in.Skip(static_cast<int>(length));
  }

  // A field of the type: one that came in another shape than it has is kept as if nobody knew it.
  bool known(CodedInputStream& in, const FieldDescriptor& field, std::uint32_t tag, std::uint64_t& seen,
             int depth) {
    const auto shape = WireFormatLite::GetTagWireType(tag);
    const bool is_packed = shape == WireFormatLite::WIRETYPE_LENGTH_DELIMITED && field.is_packable();
    if (shape != wire_type_of(field) && !is_packed) return unknown(in, tag, depth);
    if (field.is_repeated()) {
      const std::uint64_t bit = std::uint64_t{1} << (field.index() % 64);
      if ((seen & bit) == 0) bytes_ += kFirstRoom;
      seen |= bit;
    }
    if (shape != WireFormatLite::WIRETYPE_LENGTH_DELIMITED) {
      if (field.is_repeated()) bytes_ += kGrowth * width_of(field);
      return skip_number(in, shape);
    }
    std::string_view part;
    if (!take(in, part)) return false;
    if (is_packed) {
      bytes_ += kGrowth * width_of(field) * count_in(part, field);
      return true;
    }
    if (field.is_repeated()) bytes_ += kGrowth * static_cast<std::int64_t>(sizeof(void*));
    if (field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE)
      return message(part, *field.message_type(), depth + 1);
    bytes_ += string_bytes(static_cast<std::int64_t>(part.size()));
    return true;
  }

  static bool skip_number(CodedInputStream& in, WireFormatLite::WireType shape) {
    std::uint64_t number = 0;
    switch (shape) {
      case WireFormatLite::WIRETYPE_VARINT:
        return in.ReadVarint64(&number);
      case WireFormatLite::WIRETYPE_FIXED64:
        return in.Skip(8);
      case WireFormatLite::WIRETYPE_FIXED32:
        return in.Skip(4);
      default:
        return false;
    }
  }

  // What nobody knows is kept for whoever the message is passed on to.
  bool unknown(CodedInputStream& in, std::uint32_t tag, int depth) {
    constexpr auto kField = static_cast<std::int64_t>(sizeof(UnknownField));
    constexpr auto kSet = static_cast<std::int64_t>(sizeof(UnknownFieldSet));
    bytes_ += kGrowth * kField;
    const auto shape = WireFormatLite::GetTagWireType(tag);
    if (shape == WireFormatLite::WIRETYPE_LENGTH_DELIMITED) {
      std::string_view part;
      if (!take(in, part)) return false;
      bytes_ += string_bytes(static_cast<std::int64_t>(part.size()));
      return true;
    }
    if (shape != WireFormatLite::WIRETYPE_START_GROUP) return skip_number(in, shape);
    bytes_ += kPiece + kSet;
    if (depth >= kDeepest) return false;
    const std::uint32_t end =
        WireFormatLite::MakeTag(WireFormatLite::GetTagFieldNumber(tag), WireFormatLite::WIRETYPE_END_GROUP);
    while (bytes_ <= most_) {
      const std::uint32_t inner = in.ReadTagNoLastTag();
      if (inner == end) return true;
      if (inner == 0 || !unknown(in, inner, depth + 1)) return false;
    }
    return true;
  }

  const std::int64_t most_;
  std::int64_t bytes_ = 0;
  std::unordered_map<const Descriptor*, std::int64_t> sizes_;
};

}  // namespace

std::int64_t unpacked_bytes(std::string_view wire, const Descriptor& type, std::int64_t most) {
  Scan scan(most);
  if (wire.size() > std::numeric_limits<int>::max() || !scan.message(wire, type, 0)) throw no_message(type);
  return scan.bytes() + kFirstRoom;  // of unknown fields
}

Parcel::Parcel(google::protobuf::io::ZeroCopyInputStream& bytes, std::int64_t size, const Descriptor& type) {
  const void* at = nullptr;
  int length = 0;
  while (static_cast<std::int64_t>(wire_.size()) < size && bytes.Next(&at, &length)) {
    const std::string_view part(static_cast<const char*>(at), static_cast<std::size_t>(length));
    if (wire_.empty() && length >= size) {
      wire_ = part;
      break;
    }
    if (joined_.empty()) joined_.reserve(static_cast<std::size_t>(size));
    joined_ += part;
    wire_ = joined_;
  }
  memory_bytes_ = unpacked_bytes(wire_, type, kMost);
  if (memory_bytes_ <= kMost) return;
  throw Error(ErrorCode::kMemory,
              fmt::format("the {} of {} MiB would take more than {} MiB of the engine's memory", type.name(),
                          wire_.size() >> 20, kMost >> 20),
              "send it in smaller pieces");
}

void Parcel::unpack(google::protobuf::Message& into) const {
  const google::protobuf::LogSilencer quiet;  // clients' bytes would fill the log
  if (!into.ParseFromArray(wire_.data(), static_cast<int>(wire_.size())))
    throw no_message(*into.GetDescriptor());
}

}  // namespace footwall::service
