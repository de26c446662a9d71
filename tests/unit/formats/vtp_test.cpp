#include "storage/formats/vtp.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>

#include "sample_mesh.h"
#include "scratch_folder.h"
#include "storage/base/error.h"

namespace footwall::formats::vtp {
namespace {

// A reader of nothing but the appended arrays, by name, as the format's description has them.
struct Arrays {
  explicit Arrays(std::string whole)
      : bytes(std::move(whole)), data(bytes.find("<AppendedData encoding=\"raw\">")) {
    data = bytes.find('_', data) + 1;
  }
  std::string of(const std::string& name) const {
    const std::size_t tag = bytes.find("Name=\"" + name + "\"");
    EXPECT_NE(tag, std::string::npos) << name;
    const std::size_t place = bytes.find("offset=\"", tag) + 8;
    const std::size_t offset = data + std::stoul(bytes.substr(place));
    std::uint64_t size = 0;
    std::memcpy(&size, bytes.data() + offset, sizeof size);
    return bytes.substr(offset + sizeof size, size);
  }
  template <class Value>
  std::vector<Value> values(const std::string& name) const {
    const std::string raw = of(name);
    std::vector<Value> out(raw.size() / sizeof(Value));
    std::memcpy(out.data(), raw.data(), raw.size());
    return out;
  }
  std::string bytes;
  std::size_t data;
};

TEST(Vtp, ArraysStandWhereTheHeaderSays) {
  const ScratchFolder folder;
  MeshTable second = sample_mesh("F<2>&");
  second.statistics.resize(1);
  Options options;
  options.z_axis = ZAxis::kDown;
  write(folder / "f.vtp", std::vector{sample_mesh(), second}, options);
  const Arrays file(content_of(folder / "f.vtp"));
  EXPECT_NE(file.bytes.find("NumberOfPoints=\"10\""), std::string::npos);
  EXPECT_NE(file.bytes.find("NumberOfPolys=\"4\""), std::string::npos);
  const auto points = file.values<double>("Points");
  ASSERT_EQ(points.size(), 30u);
  EXPECT_EQ(points[1], 7322538.712891);
  EXPECT_EQ(points[17], 1643.655884);
  EXPECT_EQ(file.values<std::int64_t>("connectivity"),
            (std::vector<std::int64_t>{0, 1, 2, 0, 2, 3, 5, 6, 7, 5, 7, 8}));
  EXPECT_EQ(file.values<std::int64_t>("offsets"), (std::vector<std::int64_t>{3, 6, 9, 12}));
  EXPECT_EQ(file.values<std::int32_t>("fault"), (std::vector<std::int32_t>{0, 0, 1, 1}));
  EXPECT_EQ(file.values<double>("mean"), (std::vector<double>{2, 4, 2, 4}));
  const auto variance = file.values<double>("variance");
  EXPECT_TRUE(std::isnan(variance[0]) && variance[1] == 0.1 && std::isnan(variance[2]) &&
              std::isnan(variance[3]));
  EXPECT_EQ(file.of("fault_names"), std::string("F1\0F<2>&\0", 9));
  EXPECT_EQ(file.of("face"), std::string("p1:1\0p1:2\0p1:1\0p1:2\0", 20));
  EXPECT_EQ(file.of("z_positive"), std::string("down\0", 5));
}

TEST(Vtp, ZUpTurnsTheWindingWithIt) {
  const ScratchFolder folder;
  write(folder / "f.vtp", std::vector{sample_mesh()});
  const Arrays file(content_of(folder / "f.vtp"));
  EXPECT_EQ(file.values<double>("Points")[2], -1643.655884);
  EXPECT_EQ(file.values<std::int64_t>("connectivity"), (std::vector<std::int64_t>{0, 2, 1, 0, 3, 2}));
  EXPECT_EQ(file.of("z_positive"), std::string("up\0", 3));
}

TEST(Vtp, NothingAtAllIsAFileToo) {
  const ScratchFolder folder;
  write(folder / "f.vtp", {});
  EXPECT_TRUE(Arrays(content_of(folder / "f.vtp")).of("Points").empty());
}

TEST(Vtp, ATableThatDisagreesIsABug) {
  const ScratchFolder folder;
  MeshTable mesh = sample_mesh();
  mesh.triangles[0][1] = 9;
  EXPECT_THROW(write(folder / "f.vtp", std::vector{mesh}), Error);
  mesh = sample_mesh();
  mesh.statistics[0].values.pop_back();
  EXPECT_THROW(write(folder / "f.vtp", std::vector{mesh}), Error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace footwall::formats::vtp
