#include "engine/service/server/requests/parcel.h"

#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <gtest/gtest.h>

#include "engine/service/engine.pb.h"
#include "engine/service/wire.h"
#include "engine_at_work.h"

namespace footwall::service {
namespace {

using google::protobuf::io::ArrayInputStream;

constexpr int kMuch = 32 << 20;

// In pieces of so many bytes, as they come from a connection.
v1::EditBatch unpacked(const std::string& wire, int piece, std::int64_t* memory = nullptr) {
  ArrayInputStream stream(wire.data(), static_cast<int>(wire.size()), piece);
  const Parcel parcel(stream, static_cast<std::int64_t>(wire.size()), *v1::EditBatch::descriptor());
  if (memory != nullptr) *memory = parcel.memory_bytes();
  v1::EditBatch batch;
  parcel.unpack(batch);
  return batch;
}

ErrorCode refusal_of(const std::string& wire) {
  try {
    unpacked(wire, -1);
  } catch (const Error& error) {
    return error.code();
  }
  return ErrorCode::kInternal;
}

std::string again_and_again(const std::string& part) {
  std::string wire;
  wire.reserve(kMuch);
  while (wire.size() + part.size() <= kMuch) wire += part;
  return wire;
}

v1::EditBatch faces(int count) {
  std::vector<extract::Face> all;
  for (int n = 0; n < count; ++n)
    all.push_back({3, n, n % 7, {{{n, 2 * n, 256 * n}, {n + 256, n, -n}, {70'000 + n, 80'000, 90'000 - n}}}});
  v1::EditBatch batch;
  *batch.add_edits()->mutable_put() = message_of(all);
  return batch;
}

TEST(Parcel, IsTheMessageHoweverItCame) {
  const v1::EditBatch batch = faces(1000);
  const std::string wire = batch.SerializeAsString();
  for (const int piece : {-1, 1, 7, 1000}) {
    std::int64_t memory = 0;
    const v1::EditBatch read = unpacked(wire, piece, &memory);
    EXPECT_EQ(read.SerializeAsString(), wire);
    EXPECT_GE(memory, static_cast<std::int64_t>(read.SpaceUsedLong()));
    EXPECT_LE(memory, 3 * static_cast<std::int64_t>(read.SpaceUsedLong()));
  }
  EXPECT_EQ(unpacked("", -1).edits_size(), 0);
}

// What is two bytes on the wire and many more in memory.
TEST(Parcel, WhatWouldSwellIsRefused) {
  EXPECT_EQ(refusal_of(again_and_again(std::string("\x12\x00", 2))), ErrorCode::kMemory);  // empty edits
  EXPECT_EQ(refusal_of(again_and_again(std::string("\xf8\x01\x00", 3))),
            ErrorCode::kMemory);  // unknown numbers
  EXPECT_EQ(refusal_of(again_and_again(std::string("\xfb\x01\xfc\x01", 4))), ErrorCode::kMemory);  // groups
  // Faces of a byte a number.
  v1::EditBatch batch;
  batch.add_edits()->mutable_put()->mutable_faults()->Resize(24 << 20, 1);
  EXPECT_EQ(refusal_of(batch.SerializeAsString()), ErrorCode::kMemory);
}

TEST(Parcel, ALargeModelIsTaken) {
  const v1::EditBatch batch = faces(700'000);
  const std::string wire = batch.SerializeAsString();
  ASSERT_GT(wire.size(), std::size_t{20} << 20);
  ASSERT_LT(wire.size(), std::size_t{64} << 20);
  EXPECT_EQ(unpacked(wire, 1 << 20).edits(0).put().faults_size(), 700'000);
}

TEST(Parcel, WhatIsNoMessageIsRefused) {
  const std::string wire = faces(3).SerializeAsString();
  for (std::size_t length = 1; length < wire.size(); ++length)
    EXPECT_EQ(refusal_of(wire.substr(0, length)), ErrorCode::kInvalid) << length;
  EXPECT_EQ(refusal_of(again_and_again("\xfb\x01")), ErrorCode::kInvalid);  // groups without an end
}

// The call ends with it, and the engine goes on.
TEST(Parcel, ASwellingMessageIsItsCallsError) {
  EngineAtWork engine([](const v1::Command&, Call& call) { call.send(v1::EditModelReply()); });
  Context context;
  v1::EditBatch batch;
  for (int n = 0; n < 5'000'000; ++n) batch.add_edits();
  v1::EditModelReply reply;
  EXPECT_EQ(engine.stub->EditModel(&context, batch, &reply).error_code(),
            grpc::StatusCode::RESOURCE_EXHAUSTED);
  Context again;
  EXPECT_TRUE(engine.stub->EditModel(&again, faces(10), &reply).ok());
}

}  // namespace
}  // namespace footwall::service
