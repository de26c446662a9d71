#include "storage/volume/block_writer.h"

#include "unit/volume/volume_fixture.h"

namespace footwall::volume {
namespace {

const ChunkGrid kGrid{{20, 30, 40}, {8, 16, 8}};  // 3 x 2 blocks

TEST(BlockRun, StripsAreItsBlocksOfTheSameInlines) {
  EXPECT_EQ(all_blocks(kGrid).end, 6);
  EXPECT_EQ(box_of_block(kGrid, 3), (survey::Box{{8, 16, 0}, {16, 30, 40}}));
  const std::vector<survey::Box> wanted{
      {{0, 16, 0}, {8, 30, 40}}, {{8, 0, 0}, {16, 30, 40}}, {{16, 0, 0}, {20, 16, 40}}};
  EXPECT_EQ(strips_of(kGrid, {1, 5}), wanted);
  EXPECT_TRUE(strips_of(kGrid, {4, 4}).empty());
}

// Runs fill their own ranges of the file and no others: what two of them write is what one writes.
TEST_F(VolumeTest, RunsOfBlocksTogetherWriteAllChunks) {
  const auto write = [&](const std::filesystem::path& path, const std::vector<BlockRun>& runs) {
    std::ofstream(path) << "made";
    std::vector<std::uint64_t> hashes;
    for (const BlockRun& run : runs) {
      BlockWriter writer(path, 4096, kGrid, {}, run);
      std::vector<survey::Box> strips;
      writer.write(
          source_of(wavy), [](std::int64_t) {},
          [&](const survey::Box& strip, std::span<const std::uint8_t> mask) {
            EXPECT_EQ(mask.size(), static_cast<std::size_t>(strip.size(0) * strip.size(1)));
            strips.push_back(strip);
          });
      EXPECT_EQ(strips, strips_of(kGrid, run));
      writer.flush();
      hashes.insert(hashes.end(), writer.hashes().begin(), writer.hashes().end());
    }
    return hashes;
  };
  const auto one = write(folder_ / "one", {all_blocks(kGrid)});
  const auto two = write(folder_ / "two", {{3, 6}, {0, 1}, {1, 3}, {6, 6}});
  EXPECT_EQ(one.size(), 30U);
  EXPECT_NE(one, two) << "in another order";
  EXPECT_TRUE(content_of(folder_ / "one") == content_of(folder_ / "two"));
}

}  // namespace
}  // namespace footwall::volume
