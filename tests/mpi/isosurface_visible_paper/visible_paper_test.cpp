// Mode `paper` finds what the published passes find, step by step, on any number of ranks.
#include "engine/isosurface/visible/paper/visible_paper.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/isosurface/visible/paper/screen_box.h"
#include "engine/render/composite/compose.h"
#include "engine/verify/covered_by_definition.h"
#include "rounds.h"
#include "unit/isosurface/sample_volumes.h"

namespace footwall::isosurface {
namespace {

constexpr int kWidth = 90;
constexpr int kHeight = 70;

struct Scene {
  SampleVolume volume;
  BrickRanges bricks;
  VisibleRequest request;

  Scene(SampleVolume of, float isovalue, const render::Camera& camera) : volume(std::move(of)) {
    bricks = brick_ranges(volume.field(), 1);
    request.isovalue = isovalue;
    request.volume_size = volume.size;
    request.camera = camera;
    request.colour = render::hex(0xd08040);
    request.width = kWidth;
    request.height = kHeight;
    request.mode = VisibleMode::kPaper;
  }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
  VisibleRequest asked() const {
    VisibleRequest with_tables = request;
    with_tables.bricks = bricks.tables();
    return with_tables;
  }
};

std::vector<render::Vec3> corners_of(const survey::Index& size) {
  std::vector<render::Vec3> corners;
  for (unsigned n = 0; n < 8; ++n) {
    const auto at = [&](unsigned axis) {
      return (n >> axis & 1U) != 0 ? static_cast<double>(size[axis] - 1) : 0.0;
    };
    corners.emplace_back(at(0), at(1), at(2));
  }
  return corners;
}

render::Camera outside(const survey::Index& size, double azimuth, double elevation, bool perspective) {
  return render::Camera::look(azimuth, elevation, 1, corners_of(size), static_cast<double>(kWidth) / kHeight,
                              perspective);
}

render::Camera inside(const survey::Index& size) {
  const render::Vec3 eye{0.4 * static_cast<double>(size[0]), 0.45 * static_cast<double>(size[1]),
                         0.55 * static_cast<double>(size[2])};
  return render::Camera::look_at(eye, {0, 0, 0}, {0, 0, 1}, corners_of(size),
                                 static_cast<double>(kWidth) / kHeight, true);
}

VisiblePieces found(comm::Communicator& world, const Scene& scene, const VisibleRequest& request,
                    const std::function<void(const VisiblePieces&)>& after_pass = {}) {
  std::optional<Octree> octree;
  if (world.rank() == 0) {
    const survey::Index cell =
        request.cell == survey::Index{0, 0, 0} ? default_paper_cell(scene.volume.size) : request.cell;
    octree = paper_octree(scene.volume.field(), request.bricks, cell, 1);
  }
  VisiblePieces pieces;
  extract_visible_paper(world, scene.volume.field(), octree ? &*octree : nullptr, request, {}, after_pass,
                        pieces);
  return pieces;
}

struct Pixels {
  std::vector<float> depth;
  std::vector<render::Rgba> colours;
  friend bool operator==(const Pixels&, const Pixels&) = default;
  std::int64_t covered() const {
    return std::count_if(depth.begin(), depth.end(), [](float d) { return d < 1; });
  }
};

Pixels composed(comm::Communicator& world, std::span<const render::LitSurface> surfaces,
                const VisibleRequest& request) {
  render::Composer composer;
  render::ComposeReport report;
  const render::SurfaceLayer layer =
      composer.compose(world, surfaces, request.camera, {request.width, request.height, 1, {}}, report);
  Pixels pixels;
  if (world.rank() != 0) return pixels;
  const auto width = static_cast<std::size_t>(request.width);
  pixels.depth.resize(width * static_cast<std::size_t>(request.height));
  pixels.colours.resize(pixels.depth.size());
  for (int y = 0; y < request.height; ++y) {
    const std::size_t first = static_cast<std::size_t>(y) * width;
    layer.row(y, std::span(pixels.depth).subspan(first, width),
              std::span(pixels.colours).subspan(first, width));
  }
  return pixels;
}

Pixels picture_of(comm::Communicator& world, const VisiblePieces& pieces, const VisibleRequest& request) {
  std::vector<render::LitSurface> surfaces;
  for (const SomeTriangles& some : pieces.passes)
    surfaces.push_back(lit(some, request.colour, request.placement));
  return composed(world, surfaces, request);
}

// Of the whole surface; rank 0 has it all.
Pixels whole_picture(comm::Communicator& world, const Scene& scene) {
  SomeTriangles whole;
  if (world.rank() == 0) extract(scene.volume.field(), scene.request.isovalue, {}, whole.surface);
  whole.runs = {{0, 0}};
  std::vector<render::LitSurface> surfaces;
  if (world.rank() == 0) surfaces.push_back(lit(whole, scene.request.colour, scene.request.placement));
  return composed(world, surfaces, scene.request);
}

// Section 3.2 as it is printed, with a byte for each pixel, cell by cell and triangle by triangle.
std::vector<VisiblePass> passes_by_definition(const Scene& scene, const survey::Index& cell) {
  const VisibleRequest request = scene.asked();
  const render::Matrix4 to_clip = request.placement.then(request.camera.view_projection);
  const Octree octree(leaf_ranges(scene.volume.field(), cell, 1).tables(), scene.volume.size, cell);
  std::vector<survey::Box> active;
  for (const survey::Index& at :
       octree.active(viewpoint_of(request.camera, request.placement), request.isovalue))
    active.push_back(octree.cells_of({0, at}));
  const auto box_of = [&](const survey::Box& cells) {
    return screen_box(cells, to_clip, request.width, request.height);
  };

  verify::CoveredPixels mask(request.width, request.height);
  std::vector<VisiblePass> passes;
  for (;;) {
    std::vector<survey::Box> visible;
    std::vector<survey::Box> left;
    for (const survey::Box& cells : active) {
      const render::PixelRect box = box_of(cells);
      switch (mask.classify(box.x0, box.y0, box.x1, box.y1)) {
        case verify::CoveredPixels::Outcome::kVisible:
          visible.push_back(cells);
          break;
        case verify::CoveredPixels::Outcome::kUndetermined:
          left.push_back(cells);
          break;
        case verify::CoveredPixels::Outcome::kHidden:
          break;
      }
    }
    mask.end_pass();
    if (!passes.empty()) {
      std::int64_t may_be_covered = 0;
      for (int y = 0; y < request.height; ++y) {
        for (int x = 0; x < request.width; ++x) {
          bool may = false;
          for (const std::vector<survey::Box>* list : {&visible, &left}) {
            for (const survey::Box& cells : *list) {
              const render::PixelRect box = box_of(cells);
              may = may || (x >= box.x0 && x < box.x1 && y >= box.y0 && y < box.y1);
            }
          }
          may_be_covered += may && mask.entry(x, y) == 0 ? 1 : 0;
        }
      }
      passes.back().uncovered_pixels = may_be_covered;
    }
    if (visible.empty()) return passes;
    VisiblePass pass;
    for (const survey::Box& cells : visible) {
      Surface surface;
      ExtractOptions options;
      options.cells = cells;
      extract(scene.volume.field(), request.isovalue, options, surface);
      pass.triangles += static_cast<std::int64_t>(surface.triangles.size());
      render::VisibilityBuffer drawn(request.width, request.height);
      SomeTriangles some;
      some.surface = std::move(surface);
      some.runs = {{0, 0}};
      const render::LitSurface one = lit(some, 0, {});
      render::SurfaceFrame frame;
      frame.project(std::span(&one, 1), request.camera, request.width, request.height, 1);
      if (!one.triangles.empty()) frame.rasterize(drawn, 1);
      for (int y = 0; y < request.height; ++y) {
        for (int x = 0; x < request.width; ++x) {
          if (drawn.at(x, y) != render::kBackground) mask.fill(x, y, x + 1, y + 1);
        }
      }
    }
    pass.cells = static_cast<std::int64_t>(visible.size());
    passes.push_back(pass);
    active = left;
  }
}

void expect_passes_by_definition(const Scene& scene, const survey::Index& cell, const std::string& what) {
  comm::Communicator world(MPI_COMM_WORLD);
  VisibleRequest request = scene.asked();
  request.cell = cell;
  const VisibleReport got = found(world, scene, request).report;
  if (world.rank() != 0) return;
  const std::vector<VisiblePass> want = passes_by_definition(scene, cell);
  ASSERT_EQ(got.passes.size(), want.size()) << what;
  for (std::size_t n = 0; n < want.size(); ++n) {
    EXPECT_EQ(got.passes[n].cells, want[n].cells) << what << ", pass " << n;
    EXPECT_EQ(got.passes[n].triangles, want[n].triangles) << what << ", pass " << n;
    EXPECT_EQ(got.passes[n].uncovered_pixels, want[n].uncovered_pixels) << what << ", pass " << n;
  }
  EXPECT_TRUE(got.finished);
}

SampleVolume lumps(const survey::Index& size, double null_share) {
  SampleVolume noise = random_volume(size, 5, null_share);
  return sampled(size, [&](auto i, auto j, auto k) {
    const double wave = std::sin(0.31 * static_cast<double>(i)) +
                        std::sin(0.27 * static_cast<double>(j) + 1) +
                        std::sin(0.35 * static_cast<double>(k) + 2);
    return wave + 0.2 * noise.values[static_cast<std::size_t>((i * size[1] + j) * size[2] + k)];
  });
}

TEST(VisiblePaper, PassesAreThoseOfTheDefinition) {
  const survey::Index size{34, 29, 41};
  for (const bool perspective : {true, false}) {
    const Scene scene(lumps(size, 0), 0.3F, outside(size, 40, 25, perspective));
    expect_passes_by_definition(scene, {8, 8, 8}, "8");
    expect_passes_by_definition(scene, {16, 8, 8}, "16 x 8 x 8");
    expect_passes_by_definition(scene, {5, 4, 7}, "5 x 4 x 7");
  }
  const Scene within(lumps(size, 0.01), 0.3F, inside(size));
  expect_passes_by_definition(within, {8, 8, 8}, "inside, with nulls");
}

TEST(VisiblePaper, ABallsPictureIsThatOfTheWholeWithFewerTriangles) {
  comm::Communicator world(MPI_COMM_WORLD);
  const survey::Index size{57, 60, 63};
  for (const bool perspective : {true, false}) {
    const Scene scene(ball_volume(size, 24), 0, outside(size, 200, 35, perspective));
    for (const survey::Index& cell : {survey::Index{8, 8, 8}, survey::Index{3, 6, 4}}) {
      VisibleRequest request = scene.asked();
      request.cell = cell;
      const VisiblePieces pieces = found(world, scene, request);
      const Pixels got = picture_of(world, pieces, request);
      const Pixels want = whole_picture(world, scene);
      EXPECT_TRUE(got == want);
      if (world.rank() != 0) continue;
      Surface whole;
      extract(scene.volume.field(), 0, {}, whole);
      EXPECT_LT(pieces.report.triangles, static_cast<std::int64_t>(whole.triangles.size() * 9 / 10));
      EXPECT_DOUBLE_EQ(pieces.report.passes.back().percent, 100);
      EXPECT_EQ(pieces.report.passes.back().uncovered_pixels, 0);
    }
  }
}

// Whatever is lost, it is lost behind something: no pixel is left empty, and none shows what is not there.
TEST(VisiblePaper, RandomViewsCoverWhatTheWholeCovers) {
  comm::Communicator world(MPI_COMM_WORLD);
  std::mt19937 random(11);
  const auto upto = [&](int last) { return std::uniform_int_distribution<int>(0, last)(random); };
  for (int n = 0; n < rounds(12); ++n) {
    const survey::Index size{20 + upto(30), 20 + upto(30), 20 + upto(30)};
    const bool perspective = upto(1) == 0;
    const render::Camera camera =
        n % 4 == 3 ? inside(size) : outside(size, upto(359), upto(180) - 90, perspective);
    const Scene scene(lumps(size, n % 3 == 0 ? 0.02 : 0), static_cast<float>(upto(20)) / 10 - 1, camera);
    VisibleRequest request = scene.asked();
    const int side = upto(2);
    request.cell = side == 0   ? survey::Index{8, 8, 8}
                   : side == 1 ? survey::Index{8, 16, 24}
                               : survey::Index{6, 5, 9};
    request.estimate_cell = {1 + upto(3), 1 + upto(3), 1 + upto(3)};
    const VisiblePieces pieces = found(world, scene, request);
    const Pixels got = picture_of(world, pieces, request);
    const Pixels want = whole_picture(world, scene);
    for (std::size_t p = 0; p < want.depth.size(); ++p) {
      ASSERT_GE(got.depth[p], want.depth[p]) << "view " << n << ", pixel " << p;
      ASSERT_EQ(got.depth[p] < 1, want.depth[p] < 1) << "view " << n << ", pixel " << p;
    }
  }
}

// The flaw of the published mask, cells of 8: a speck whose cell is large in front (F); behind it, inside of
// its box, a block (A); behind that a larger body (B) whose cells' boxes poke out of F's. F and B are taken
// in the first pass, B covers all of A's box, and A, which is before B, is discarded.
Scene speck_block_and_body() {
  const SampleVolume volume = sampled({41, 41, 41}, [](auto i, auto j, auto k) {
    const auto in = [](std::int64_t at, std::int64_t lo, std::int64_t hi) { return at >= lo && at <= hi; };
    const bool speck = i == 4 && j == 4 && k == 12;
    const bool block = in(i, 18, 22) && in(j, 10, 14) && in(k, 10, 14);
    const bool body = in(i, 25, 31) && in(j, 9, 23) && in(k, 1, 23);
    return speck || block || body ? 1.0 : -1.0;
  });
  // On the line through the cells of the speck and the block.
  const render::Camera camera = render::Camera::look_at({4 - 90, 4 - 45, 12}, {20, 12, 12}, {0, 0, 1},
                                                        corners_of(volume.size), 1, true);
  return {volume, 0, camera};
}

TEST(VisiblePaper, LosesABlockThatIsSeenSinceTheMaskHasNoDepth) {
  comm::Communicator world(MPI_COMM_WORLD);
  Scene scene = speck_block_and_body();
  scene.request.width = scene.request.height = 200;
  VisibleRequest request = scene.asked();
  request.cell = {8, 8, 8};
  const VisiblePieces pieces = found(world, scene, request);
  const Pixels got = picture_of(world, pieces, request);
  const Pixels want = whole_picture(world, scene);
  if (world.rank() != 0) return;
  EXPECT_EQ(pieces.report.passes.size(), 1U);
  EXPECT_EQ(got.covered(), want.covered()) << "what is behind shows instead";
  std::size_t farther = 0;
  for (std::size_t n = 0; n < want.depth.size(); ++n) {
    EXPECT_GE(got.depth[n], want.depth[n]);
    farther += got.depth[n] > want.depth[n] ? 1 : 0;
  }
  EXPECT_GT(farther, 100U) << "the block";
  EXPECT_FALSE(got == want);
}

TEST(VisiblePaper, StopsAfterThePassesThatAreAskedFor) {
  comm::Communicator world(MPI_COMM_WORLD);
  const survey::Index size{34, 29, 41};
  const Scene scene(lumps(size, 0), 0.3F, outside(size, 40, 25, true));
  VisibleRequest request = scene.asked();
  request.cell = {8, 8, 8};
  const VisibleReport whole = found(world, scene, request).report;
  std::vector<std::int64_t> covered;
  request.passes = 2;
  const VisiblePieces two = found(world, scene, request, [&](const VisiblePieces& so_far) {
    covered.push_back(picture_of(world, so_far, request).covered());
  });
  ASSERT_EQ(covered.size(), 2U) << "every rank is told of every pass";
  request.passes = 0;
  request.budget_seconds = 0;
  const VisiblePieces one = found(world, scene, request);
  if (world.rank() != 0) return;
  ASSERT_GT(whole.passes.size(), 3U);
  ASSERT_EQ(two.report.passes.size(), 2U);
  EXPECT_FALSE(two.report.finished);
  EXPECT_LT(covered[0], covered[1]);
  EXPECT_EQ(two.report.passes[1].triangles, whole.passes[1].triangles);
  EXPECT_EQ(two.report.passes[1].uncovered_pixels, whole.passes[1].uncovered_pixels);
  EXPECT_DOUBLE_EQ(two.report.passes[1].percent, 100);
  EXPECT_EQ(one.report.passes.size(), 1U) << "one pass whatever the budget";
  EXPECT_GT(one.report.passes[0].uncovered_pixels, 0);
}

TEST(VisiblePaper, FindsNothingWhereThereIsNothing) {
  comm::Communicator world(MPI_COMM_WORLD);
  const auto expect_empty = [&](const SampleVolume& volume, float isovalue) {
    const Scene scene(volume, isovalue, outside({9, 9, 9}, 30, 30, true));
    const VisiblePieces pieces = found(world, scene, scene.asked());
    EXPECT_TRUE(pieces.passes.empty() || pieces.passes.front().surface.triangles.empty());
    EXPECT_TRUE(pieces.report.finished);
    if (world.rank() == 0) {
      EXPECT_EQ(pieces.report.triangles, 0);
    }
    EXPECT_EQ(picture_of(world, pieces, scene.asked()).covered(), 0);
  };
  expect_empty(ball_volume({20, 20, 20}, 5), 1000);
  expect_empty(sampled({12, 12, 12}, [](auto...) { return kNull; }), 0);
  expect_empty(sampled({1, 1, 1}, [](auto...) { return 1.0; }), 0.5F);
  expect_empty(random_volume({1, 9, 1}, 1), 0);
  expect_empty(random_volume({9, 9, 1}, 1), 0);
}

TEST(VisiblePaper, RefusesWhatCannotBe) {
  comm::Communicator world(MPI_COMM_WORLD);
  const Scene scene(ball_volume({12, 12, 12}, 4), 0, outside({12, 12, 12}, 30, 30, true));
  VisibleRequest request = scene.asked();
  request.width = 0;
  EXPECT_THROW(found(world, scene, request), comm::AgreedError);
  request = scene.asked();
  request.estimate_cell = {1, -1, 1};
  EXPECT_THROW(found(world, scene, request), comm::AgreedError);
  request = scene.asked();
  request.passes = -1;
  EXPECT_THROW(found(world, scene, request), comm::AgreedError);
  request = scene.asked();
  request.volume_size = {13, 12, 12};
  EXPECT_THROW(found(world, scene, request), comm::AgreedError);
}

}  // namespace
}  // namespace footwall::isosurface
