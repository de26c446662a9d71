#include "storage/formats/voxels_csv.h"

#include <gtest/gtest.h>

#include <limits>

#include "scratch_folder.h"
#include "storage/base/partial_file.h"

namespace footwall::formats::voxels_csv {
namespace {

survey::Geometry geometry() {
  survey::Geometry survey;
  survey.inlines = {100, 2, 10};
  survey.crosslines = {7, 1, 10};
  survey.samples = 50;
  survey.z0 = 800;
  survey.interval = 4;
  return survey;
}

TEST(VoxelsCsv, OneRowAVoxelWithItsPlaces) {
  const ScratchFolder folder;
  const auto path = folder.path() / "v.csv";
  const std::vector<survey::Index> voxels{{0, 0, 0}, {3, 4, 5}};
  const std::vector<float> values{0.1F, std::numeric_limits<float>::quiet_NaN()};
  {
    Writer writer(path, geometry(), {});
    writer.add("A, \"B\"", "3-7.12", voxels, values);
    EXPECT_FALSE(std::filesystem::exists(path));
    writer.commit();
  }
  EXPECT_EQ(read_whole_file(path, 1 << 20),
            "fault,face,i,j,k,inline,crossline,z,value\n"
            "\"A, \"\"B\"\"\",3-7.12,0,0,0,100,7,800,0.1\n"
            "\"A, \"\"B\"\"\",3-7.12,3,4,5,106,11,820,\n");
  Writer writer(path, geometry(), {0.001, true});
  writer.add("F", "1.1", std::span(voxels).first(1), std::span(values).first(1));
  writer.commit();
  EXPECT_NE(read_whole_file(path, 1 << 20).find("F,1.1,0,0,0,100,7,-0.8,0.1\n"), std::string::npos);
}

}  // namespace
}  // namespace footwall::formats::voxels_csv
