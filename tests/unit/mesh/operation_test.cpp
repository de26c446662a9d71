#include "engine/mesh/operation.h"

#include <gtest/gtest.h>

#include "storage/base/error.h"

namespace footwall::mesh {
namespace {

const std::vector<Operation> kOneOfEach{
    CreateMesh{{{1, 2, 3}, {-4, 5, 6}, {7, 8, 2147483647}}, {{0, 1, 2}}},
    DestroyMesh{3},
    AddFace{1, 2, LatticePoint{3, 4, 5}},
    AddFace{1, 2, VertexId{7}},
    RemoveFaces{4, 5},
    RemoveFace{4, 6},
    MoveVertex{2, 9, {-1, 0, 1}},
    SplitEdge{8, 1, {256, 512, -256}},
};

TEST(Operation, ComesBackAsItWasSent) {
  EXPECT_EQ(decode(encode(kOneOfEach)), kOneOfEach);
  EXPECT_TRUE(decode({}).empty());
  EXPECT_EQ(encode(std::vector<Operation>{MoveVertex{}}).size(), 21u);
}

TEST(Operation, RefusesBytesThatAreCutOff) {
  for (const Operation& operation : kOneOfEach) {
    const std::vector<std::byte> whole = encode(std::span(&operation, 1));
    for (std::size_t n = 1; n < whole.size(); ++n)
      EXPECT_THROW(decode(std::span(whole).first(n)), Error) << name_of(operation) << " cut at " << n;
  }
}

TEST(Operation, RefusesWhatIsNoOperation) {
  std::vector<std::byte> bytes = encode(std::vector<Operation>{AddFace{1, 2, VertexId{7}}});
  bytes[9] = std::byte{2};  // neither a position nor a vertex
  EXPECT_THROW(decode(bytes), Error);
  bytes[0] = std::byte{7};
  EXPECT_THROW(decode(bytes), Error);
  // A count that no memory could hold.
  std::vector<std::byte> large(5, std::byte{0xff});
  large[0] = std::byte{0};
  EXPECT_THROW(decode(large), Error);
}

}  // namespace
}  // namespace footwall::mesh
