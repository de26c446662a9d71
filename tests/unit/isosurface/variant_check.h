// What every serial variant has to show: the surface of the definition, whatever the volume.
#pragma once
#include <gtest/gtest.h>

#include <string>

#include "engine/isosurface/extract.h"
#include "engine/verify/surface_by_definition.h"
#include "sample_volumes.h"
#include "storage/base/error.h"

namespace footwall::isosurface {

using ExtractFunction = void (*)(const Field&, float, const ExtractOptions&, Surface&);

inline void expect_defined(ExtractFunction variant, const Field& field, float isovalue,
                           ExtractOptions options, const std::string& what) {
  const Surface defined = verify::surface_by_definition(field, isovalue, options);
  Surface made;
  options.keys = true;
  variant(field, isovalue, options, made);
  EXPECT_EQ(verify::difference(made, defined), "") << what;
  EXPECT_EQ(verify::unsoundness(made), "") << what;
}

inline void check_random_volumes(ExtractFunction variant) {
  for (const survey::Index& size :
       {survey::Index{2, 2, 2}, {3, 2, 9}, {2, 5, 8}, {6, 7, 17}, {9, 4, 70}, {5, 18, 3}}) {
    for (const double nulls : {0.0, 0.01, 0.3}) {
      const SampleVolume volume = random_volume(size, 11, nulls);
      const std::string what = std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " +
                               std::to_string(size[2]) + ", nulls " + std::to_string(nulls);
      expect_defined(variant, volume.field(), 0.1F, {}, what);
    }
  }
  const SampleVolume round = ball_volume({20, 22, 24}, 8);
  expect_defined(variant, round.field(), 0.5F, {}, "a ball");
}

inline void check_odd_values(ExtractFunction variant) {
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  std::mt19937 random(3);
  const float odd[] = {kInfinite, -kInfinite, 1e30F, -1e30F, 1e-40F, 0, 1, -1, 2, kNull};
  std::uniform_int_distribution<std::size_t> which(0, std::size(odd) - 1);
  const SampleVolume volume = sampled({7, 8, 9}, [&](auto...) { return odd[which(random)]; });
  // Many samples have exactly the isovalue.
  const SampleVolume steps = sampled({7, 8, 19}, [&](auto...) { return static_cast<double>(random() % 3); });
  for (const float isovalue : {0.0F, 1.0F, 2.0F}) {
    expect_defined(variant, volume.field(), isovalue, {}, "odd values");
    expect_defined(variant, steps.field(), isovalue, {}, "steps");
  }
}

inline void check_parts(ExtractFunction variant) {
  for (const survey::Index& size : {survey::Index{1, 9, 5}, {7, 1, 5}, {3, 4, 1}, {1, 1, 1}}) {
    const SampleVolume flat = random_volume(size, 1);
    expect_defined(variant, flat.field(), 0, {}, "no cells");
  }
  const SampleVolume volume = random_volume({9, 10, 21}, 5, 0.01);
  ExtractOptions options;
  options.keys = true;
  for (const survey::Box& cells : {survey::Box{{0, 0, 0}, {3, 9, 20}}, survey::Box{{4, 5, 6}, {7, 8, 15}},
                                   survey::Box{{7, 0, 18}, {8, 1, 20}}, survey::Box{{2, 2, 2}, {2, 3, 4}}}) {
    options.cells = cells;
    expect_defined(variant, volume.field(), 0.05F, options, "a box of cells");
    if (cells.empty()) continue;
    // The same from the samples around it alone.
    const Surface whole = verify::surface_by_definition(volume.field(), 0.05F, options);
    survey::Box samples = survey::grown(cells, 1);
    for (int axis = 0; axis < 3; ++axis) samples.hi[axis] += 1;
    const SamplePart part = part_of(volume, survey::intersection(samples, {{0, 0, 0}, volume.size}));
    Surface made;
    variant(part.field, 0.05F, options, made);
    EXPECT_EQ(verify::difference(made, whole), "");
  }
}

inline void check_choices(ExtractFunction variant) {
  const SampleVolume volume = random_volume({6, 6, 11}, 8);
  Surface made;
  ExtractOptions options;
  for (const bool normals : {true, false}) {
    for (const bool keys : {true, false}) {
      options.normals = normals;
      options.keys = keys;
      variant(volume.field(), 0, options, made);
      EXPECT_EQ(made.normals.size(), normals ? made.positions.size() : 0);
      EXPECT_EQ(made.keys.size(), keys ? made.positions.size() : 0);
    }
  }
  const auto code_of = [&](const Field& field, float isovalue) {
    try {
      variant(field, isovalue, options, made);
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::kInternal;
  };
  EXPECT_EQ(code_of(volume.field(), kNull), ErrorCode::kInvalid);
  Field field = volume.field();
  field.size = {6, 6, 12};
  EXPECT_EQ(code_of(field, 0), ErrorCode::kInvalid);
  const Bricks bricks;
  options.bricks = &bricks;
  const ErrorCode refused = code_of(volume.field(), 0);
  EXPECT_TRUE(refused == ErrorCode::kUnsupported || refused == ErrorCode::kInvalid);
}

}  // namespace footwall::isosurface
