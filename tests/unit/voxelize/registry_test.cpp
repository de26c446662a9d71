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

TEST(Registry, SaysWhatIsNotBuiltAndWhy) {
  for (const char* name : {"gpu", "gpu=cg"}) {
    const Error error = error_of(name);
    EXPECT_EQ(error.code(), ErrorCode::kUsage) << name;
    EXPECT_NE(error.message().find("not built"), std::string::npos) << error.message();
    EXPECT_NE(error.message().find("round"), std::string::npos) << error.message();
  }
}

TEST(Registry, NamesWhatThereIs) {
  for (const char* name : {"", "exact=2", "exakt", "rotated=", "rotated=l", "rotated=lc=lc", "kaufman=lc"}) {
    const Error error = error_of(name);
    EXPECT_EQ(error.code(), ErrorCode::kUsage) << name;
    EXPECT_NE(error.hint().find("exact, rotated, rotated=lc, rotated=plain, kaufman"), std::string::npos)
        << error.hint();
  }
}

TEST(Registry, MakesEveryMethodAndVariant) {
  for (const char* name : {"exact", "rotated", "rotated=lc", "rotated=plain", "kaufman"}) {
    std::vector<Voxel> voxels;
    make_voxelizer(name, 2)->raster({{{0, 0, 0}, {2560, 0, 0}, {0, 2560, 0}}}, {{-9, -9, -9}, {20, 20, 20}},
                                    voxels);
    EXPECT_GT(voxels.size(), 20u) << name;
    EXPECT_EQ(method_of(name).exact, std::string_view(name) == "exact");
  }
}

}  // namespace
}  // namespace footwall::voxelize
