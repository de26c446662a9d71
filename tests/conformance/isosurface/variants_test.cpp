// Isosurfaces of real volumes: all variants give the same, bit for bit, and none has a crack.
#include <cmath>

#include "engine/isosurface/canonical.h"
#include "engine/isosurface/cap.h"
#include "engine/isosurface/properties.h"
#include "engine/isosurface/registry.h"
#include "real_files.h"
#include "storage/formats/nrrd.h"
#include "storage/formats/segy/segy_file.h"

namespace footwall::isosurface {
namespace {

struct RealVolume {
  std::vector<float> values;
  survey::Index size;
};

RealVolume of_nrrd(const std::filesystem::path& path) {
  const formats::nrrd::NrrdFile file(path, std::filesystem::temp_directory_path(), {});
  const auto& axes = file.header().axes;
  RealVolume volume{{}, {axes[0].size, axes[1].size, axes[2].size}};
  volume.values.resize(static_cast<std::size_t>(axes[0].size * axes[1].size * axes[2].size));
  file.read_block(formats::nrrd::default_order(file.header()), {{0, 0, 0}, volume.size}, volume.values);
  return volume;
}

RealVolume of_segy(const std::filesystem::path& path) {
  const auto file = formats::segy::SegyFile::scan(path, {});
  const survey::Box box = file.geometry().box();
  RealVolume volume{std::vector<float>(static_cast<std::size_t>(box.count())), file.geometry().dims()};
  std::vector<std::uint8_t> live(static_cast<std::size_t>(box.size(0) * box.size(1)));
  file.read_block(box, volume.values, live);
  return volume;
}

void expect_one_surface(const RealVolume& volume, float isovalue, const std::string& name) {
  SCOPED_TRACE(name + " at " + std::to_string(isovalue));
  const Field field{volume.values, volume.size, {0, 0, 0}, volume.size};
  ExtractOptions options;
  options.keys = true;
  Surface first;
  variant_of("plane").extract(field, isovalue, options, first);
  EXPECT_GT(first.triangles.size(), 0u);
  for (const Variant& variant : variants()) {
    Surface other;
    variant.extract(field, isovalue, options, other);
    EXPECT_EQ(difference(other, first, volume.size).value_or(""), "") << variant.name;
    EXPECT_EQ(other.row_first, first.row_first) << variant.name;
  }
  const Properties open = properties_of(first, Measure(), &field);
  EXPECT_EQ(open.boundary_edges.inside, 0u);
  EXPECT_EQ(open.non_manifold_edges, 0u);
  cap(field, isovalue, first);
  const Properties closed = properties_of(first, Measure(), &field);
  EXPECT_EQ(closed.boundary_edges.inside, 0u);
  if (open.boundary_edges.at_nulls > 0) return;
  EXPECT_EQ(closed.boundary_edges.at_border, 0u);
  EXPECT_EQ(closed.euler % 2, 0);
  ASSERT_TRUE(closed.volume.has_value());
  // Samples at or above the isovalue stand for a voxel each; the surface cuts their cells.
  double samples = 0;
  for (const float value : volume.values) samples += value >= isovalue ? 1 : 0;
  EXPECT_NEAR(*closed.volume / samples, 1, 0.25);
}

// A value that so much of the samples, above the smallest, lie below.
float quantile(std::vector<float> values, double part) {
  std::erase_if(values, [](float value) { return std::isnan(value); });
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

TEST(Variants, GiveOneSurfaceOfRealVolumes) {
  FOOTWALL_NEEDS_REAL_FILES();
  const auto folder = formats::real_files() / "_derived";
  int volumes = 0;
  for (const char* name : {"nucleon", "hydrogen_orbital", "neghip", "ironProt", "HeadMRVolume",
                           "headsq_quarter", "avg152T1", "bolt"}) {
    const auto path = folder / (std::string(name) + ".nrrd");
    if (!std::filesystem::exists(path)) continue;
    ++volumes;
    const RealVolume volume = of_nrrd(path);
    // A value that many samples of integer data have, and one between two.
    const float common =
        std::max(quantile(volume.values, 0.9), std::nextafter(quantile(volume.values, 0), 1e30F));
    expect_one_surface(volume, common, name);
    expect_one_surface(volume, common + 0.5F * std::abs(common) / 8, name);
  }
  EXPECT_GT(volumes, 4);
}

TEST(Variants, GiveOneSurfaceOfSeismicAmplitudes) {
  FOOTWALL_NEEDS_REAL_FILES();
  const RealVolume f3 = of_segy(formats::real_files() / "equinor+segyio/test-data/f3.sgy");
  for (const double part : {0.1, 0.5, 0.9}) expect_one_surface(f3, quantile(f3.values, part), "f3");
}

}  // namespace
}  // namespace footwall::isosurface
