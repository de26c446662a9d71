#include "storage/formats/png.h"

#include <gtest/gtest.h>
#include <png.h>

#include <vector>

#include "scratch_folder.h"
#include "storage/base/error.h"

namespace footwall::formats {
namespace {

class PngTest : public ::testing::Test {
 protected:
  ScratchFolder folder_;
};

TEST_F(PngTest, ReadsBackAsWritten) {
  constexpr int kWidth = 37;
  constexpr int kHeight = 5;
  std::vector<std::uint8_t> rgba(4 * kWidth * kHeight);
  for (std::size_t n = 0; n < rgba.size(); ++n) rgba[n] = static_cast<std::uint8_t>(n * 37 + 11);
  const auto path = folder_ / "picture.png";
  write_png(path, kWidth, kHeight, rgba);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_file(&image, path.c_str()), 0) << image.message;
  EXPECT_EQ(image.width, static_cast<unsigned>(kWidth));
  EXPECT_EQ(image.height, static_cast<unsigned>(kHeight));
  image.format = PNG_FORMAT_RGBA;
  std::vector<std::uint8_t> back(PNG_IMAGE_SIZE(image));
  ASSERT_NE(png_image_finish_read(&image, nullptr, back.data(), 0, nullptr), 0) << image.message;
  EXPECT_EQ(back, rgba);
}

TEST_F(PngTest, LeavesNothingWhereItCannotWrite) {
  const std::vector<std::uint8_t> pixel(4);
  EXPECT_THROW(write_png(folder_ / "no" / "picture.png", 1, 1, pixel), Error);
  EXPECT_THROW(write_png(folder_ / "picture.png", 2, 1, pixel), Error);
  std::filesystem::create_directory(folder_ / "taken.png");
  EXPECT_THROW(write_png(folder_ / "taken.png", 1, 1, pixel), Error);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 1);
}

}  // namespace
}  // namespace footwall::formats
