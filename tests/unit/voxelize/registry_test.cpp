#include "engine/voxelize/registry.h"

#include <gtest/gtest.h>

#include <string>

#include "storage/base/error.h"

namespace footwall::voxelize {
namespace {

Error error_of(std::string_view name) {
  try {
    make_voxelizer(name);
  } catch (const Error& error) {
    return error;
  }
  return Error(ErrorCode::kInternal, "nothing was thrown");
}

TEST(Registry, MakesTheDefaultFirst) {
  EXPECT_EQ(methods().front().name, "exact");
  class Count final : public RowSink {
   public:
    void row(const Row& row) override { voxels += voxels_in(row); }
    std::int64_t voxels = 0;
  } count;
  make_voxelizer()->rows({{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}}, {{-9, -9, -9}, {9, 9, 9}}, count);
  EXPECT_EQ(count.voxels, 1);
}

TEST(Registry, SaysWhatIsNotBuilt) {
  for (const char* name : {"rotated", "rotated=lc", "kaufman", "gpu"}) {
    const Error error = error_of(name);
    EXPECT_EQ(error.code(), ErrorCode::kUsage) << name;
    EXPECT_NE(error.message().find("not built"), std::string::npos) << error.message();
  }
}

TEST(Registry, NamesWhatThereIs) {
  for (const char* name : {"", "exact=2", "exakt"}) {
    const Error error = error_of(name);
    EXPECT_EQ(error.code(), ErrorCode::kUsage) << name;
    EXPECT_NE(error.hint().find("exact"), std::string::npos) << error.hint();
  }
}

}  // namespace
}  // namespace footwall::voxelize
