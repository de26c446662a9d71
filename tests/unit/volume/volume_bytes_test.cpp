#include "storage/volume/volume_bytes.h"

#include "storage/base/partial_file.h"
#include "unit/volume/volume_fixture.h"

namespace footwall::volume {
namespace {

class VolumeBytes : public VolumeTest {
 protected:
  VolumeBytes() {
    WriteOptions options = options_for({20, 17, 30});
    options.chunk = {8, 8, 16};
    write_volume(path_, options, source_of(wavy), {});
  }
  std::string copied() const {
    std::string bytes;
    each_verified_piece(path_, {}, [&](std::span<const std::byte> piece) {
      bytes.append(reinterpret_cast<const char*>(piece.data()), piece.size());
    });
    return bytes;
  }
};

TEST_F(VolumeBytes, AreTheWholeFile) {
  EXPECT_EQ(copied(), content_of(path_));
}

TEST_F(VolumeBytes, NoAlteredChunkPasses) {
  flip(voxels_at() + 5 * 8 * 8 * 16 * 4 + 3);
  const Caught caught = error_of([&] { copied(); });
  EXPECT_EQ(caught.code, ErrorCode::kCorrupt);
  EXPECT_NE(caught.message.find("chunk 5"), std::string::npos) << caught.message;
}

TEST_F(VolumeBytes, ACancelAndAnErrorOfTheTakerPassThrough) {
  const JobContext job;
  int pieces = 0;
  const Caught caught = error_of([&] {
    each_verified_piece(path_, job, [&](std::span<const std::byte>) {
      ++pieces;
      job.cancel();
    });
  });
  EXPECT_EQ(caught.code, ErrorCode::kCancelled);
  EXPECT_EQ(pieces, 1);
}

}  // namespace
}  // namespace footwall::volume
