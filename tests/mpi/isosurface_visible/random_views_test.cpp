// Random views of volumes of four kinds, one of them real: each picture is that of the whole surface.
#include <gtest/gtest.h>

#include "conformance/formats/real_files.h"
#include "engine/isosurface/visible/parallel/brick_pillars.h"
#include "engine/isosurface/visible/parallel/visible_picture_parallel.h"
#include "engine/synthetic/fields.h"
#include "mpi/isosurface_visible/layer_difference.h"
#include "rounds.h"
#include "storage/formats/nrrd.h"
#include "unit/isosurface_visible/visible_scene.h"

namespace footwall::isosurface {
namespace {

SampleVolume synthetic_volume(std::string_view name, float& isovalue) {
  synthetic::SampledField field = synthetic::make_field(name, 56);
  isovalue = field.isovalue;
  return {std::move(field.values), {56, 56, 56}};
}

SampleVolume real_volume(const std::filesystem::path& path) {
  const formats::nrrd::NrrdFile file(path, std::filesystem::temp_directory_path(), {});
  const auto& axes = file.header().axes;
  SampleVolume volume{{}, {axes[0].size, axes[1].size, axes[2].size}};
  volume.values.resize(static_cast<std::size_t>(axes[0].size * axes[1].size * axes[2].size));
  file.read_block(formats::nrrd::default_order(file.header()), {{0, 0, 0}, volume.size}, volume.values);
  return volume;
}

void check_views(VisibleScene& scene, int views, unsigned seed) {
  comm::Communicator world(MPI_COMM_WORLD);
  const BrickPillars pillars(scene.volume.field(), world.size(), world.rank(), {2, 2, 1});
  std::mt19937 random(seed);
  VisiblePicture picture;
  for (int view = 0; view < views; ++view) {
    scene.look_at_random(random);
    if (view % 4 == 0) picture.forget();
    VisibleReport report;
    render::ComposeReport composed;
    const render::SurfaceLayer layer = picture.draw(world, pillars.parts(), scene.request, report, composed);
    EXPECT_LE(report.passes.size(), 5U);
    if (world.rank() == 0) {
      ASSERT_EQ(difference(scene.whole(), layer), "") << "view " << view;
    }
  }
}

TEST(RandomViews, OfSyntheticVolumesAreThoseOfTheWholeSurface) {
  for (const char* name : {"sphere", "gyroid", "envelope"}) {
    float isovalue = 0;
    VisibleScene scene(synthetic_volume(name, isovalue));
    scene.request.isovalue = isovalue;
    check_views(scene, rounds(2), 21);
  }
}

TEST(RandomViews, OfARealVolumeAreThoseOfTheWholeSurface) {
  const std::filesystem::path file = formats::real_files() / "_derived" / "headsq_quarter.nrrd";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no test data in " << formats::real_files();
  VisibleScene scene(real_volume(file));
  scene.request.isovalue = 1150;
  scene.request.placement = {{3.2, 0, 0, 0, 3.2, 0, 0, 0, -1.5}, {}};
  check_views(scene, rounds(1), 22);
}

}  // namespace
}  // namespace footwall::isosurface
