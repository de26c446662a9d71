#include "engine/service/resident/volume_folder.h"

#include <gtest/gtest.h>

#include "scratch_folder.h"
#include "storage/base/error.h"
#include "storage/base/hash.h"
#include "storage/volume/volume_writer.h"

namespace footwall::service {
namespace {

std::string write(const std::filesystem::path& path, float value) {
  volume::WriteOptions options;
  options.geometry.inlines = {1, 1, 2};
  options.geometry.crosslines = {1, 1, 3};
  options.geometry.samples = 4;
  return to_hex(
      volume::write_volume(path, options,
                           [&](const survey::Box&, std::span<float> values, std::span<std::uint8_t>) {
                             std::fill(values.begin(), values.end(), value);
                           },
                           {})
          .checksum);
}

TEST(VolumeFolder, FindsVolumesByChecksumAlsoThoseThatComeLater) {
  const ScratchFolder scratch;
  scratch.file("broken.h5", "no volume at all");
  scratch.file("notes.txt", "neither");
  VolumeFolder folder(scratch.path());
  const std::string first = write(scratch / "b.h5", 1);
  EXPECT_EQ(folder.find(first), scratch / "b.h5");
  EXPECT_EQ(folder.find("0123456789abcdef"), std::nullopt);
  EXPECT_EQ(folder.find(""), std::nullopt);
  const std::string second = write(scratch / "a.h5", 2);
  EXPECT_EQ(folder.find(second), scratch / "a.h5");
  // Another volume in the same file.
  std::filesystem::remove(scratch / "b.h5");
  const std::string third = write(scratch / "b.h5", 3);
  EXPECT_EQ(folder.find(first), std::nullopt);
  EXPECT_EQ(folder.find(third), scratch / "b.h5");
}

TEST(VolumeFolder, SaysWhatIsWrong) {
  VolumeFolder none{std::filesystem::path()};
  EXPECT_EQ(none.find("0123456789abcdef"), std::nullopt);
  VolumeFolder absent("/nowhere/at/all");
  EXPECT_THROW(absent.find("0123456789abcdef"), Error);
}

}  // namespace
}  // namespace footwall::service
