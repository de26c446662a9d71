#include "engine/tasks/resample_volume.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "engine/verify/resample_by_definition.h"
#include "made_source.h"
#include "storage/base/error.h"

namespace footwall::tasks {
namespace {

using Field = std::function<float(std::int64_t, std::int64_t, std::int64_t)>;

VolumeSource all_live(const survey::Index& dims, const Field& field) {
  VolumeSource source = made_source();
  source.geometry.inlines.count = dims[0];
  source.geometry.crosslines.count = dims[1];
  source.geometry.samples = dims[2];
  source.fill = [field](const survey::Box& box, std::span<float> values, std::span<std::uint8_t>) {
    std::size_t n = 0;
    for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
      for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
        for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k) values[n++] = field(i, j, k);
      }
    }
  };
  return source;
}

struct Filled {
  std::vector<float> values;
  std::vector<std::uint8_t> live;
};
// In blocks, as the writer asks for it.
Filled filled(const VolumeSource& source, std::int64_t side) {
  const survey::Index dims = source.geometry.dims();
  Filled all{std::vector<float>(static_cast<std::size_t>(dims[0] * dims[1] * dims[2])),
             std::vector<std::uint8_t>(static_cast<std::size_t>(dims[0] * dims[1]))};
  for (std::int64_t i = 0; i < dims[0]; i += side) {
    for (std::int64_t j = 0; j < dims[1]; j += side) {
      const survey::Box box{{i, j, 0}, {std::min(i + side, dims[0]), std::min(j + side, dims[1]), dims[2]}};
      std::vector<float> values(static_cast<std::size_t>(box.count()));
      std::vector<std::uint8_t> live(static_cast<std::size_t>(box.size(0) * box.size(1)), 1);
      source.fill(box, values, live);
      for (std::int64_t a = 0; a < box.size(0); ++a) {
        for (std::int64_t b = 0; b < box.size(1); ++b) {
          const std::int64_t from = a * box.size(1) + b;
          const std::int64_t to = (i + a) * dims[1] + j + b;
          all.live[to] = live[from];
          std::copy_n(values.begin() + from * dims[2], dims[2], all.values.begin() + to * dims[2]);
        }
      }
    }
  }
  return all;
}

TEST(ResampleVolume, AgreesWithItsDefinition) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(-1, 1);
  const survey::Index dims{9, 11, 14};
  std::vector<float> noise(static_cast<std::size_t>(dims[0] * dims[1] * dims[2]));
  for (float& value : noise) value = uniform(random);
  const Field field = [&](std::int64_t i, std::int64_t j, std::int64_t k) {
    return noise[static_cast<std::size_t>((i * dims[1] + j) * dims[2] + k)];
  };
  for (const survey::Index& to :
       {survey::Index{17, 6, 14}, survey::Index{4, 31, 5}, survey::Index{9, 2, 40}}) {
    const VolumeSource source = all_live(dims, field);
    const Filled got = filled(resampled(source, regridded(source.geometry, to)), 3);
    const std::array<double, 3> step{double(dims[0] - 1) / double(to[0] - 1),
                                     double(dims[1] - 1) / double(to[1] - 1),
                                     double(dims[2] - 1) / double(to[2] - 1)};
    std::size_t n = 0;
    for (std::int64_t i = 0; i < to[0]; ++i) {
      for (std::int64_t j = 0; j < to[1]; ++j) {
        for (std::int64_t k = 0; k < to[2]; ++k) {
          const double want = verify::resampled_sample(
              field, dims, {double(i) * step[0], double(j) * step[1], double(k) * step[2]}, step);
          ASSERT_NEAR(got.values[n++], want, 1e-5) << i << " " << j << " " << k;
        }
      }
    }
  }
}

TEST(ResampleVolume, LinearFieldsComeOutExactlyForEveryRatioAndAtTheEdges) {
  const survey::Index dims{12, 10, 21};
  const Field plane = [](std::int64_t i, std::int64_t j, std::int64_t k) {
    return static_cast<float>(3 + 2 * i - 5 * j + 0.25 * double(k));
  };
  for (const survey::Index& to :
       {survey::Index{23, 19, 41}, survey::Index{5, 4, 7}, survey::Index{2, 13, 2}}) {
    const VolumeSource source = all_live(dims, plane);
    const VolumeSource made = resampled(source, regridded(source.geometry, to));
    const Filled got = filled(made, 32);
    std::size_t n = 0;
    for (std::int64_t i = 0; i < to[0]; ++i) {
      for (std::int64_t j = 0; j < to[1]; ++j) {
        for (std::int64_t k = 0; k < to[2]; ++k) {
          // Through the world: the geometry must say where the new samples are.
          const auto at = source.geometry.index_of(made.geometry.world_of({double(i), double(j), double(k)}));
          ASSERT_NEAR(got.values[n++], 3 + 2 * at.i - 5 * at.j + 0.25 * at.k, 1e-4);
        }
      }
    }
  }
}

TEST(ResampleVolume, TheSameGridGivesTheSameBits) {
  const VolumeSource source = made_source();
  const Filled before = filled(source, 4);
  const Filled after = filled(resampled(source, regridded(source.geometry, source.geometry.dims())), 4);
  EXPECT_EQ(after.live, before.live);
  for (std::size_t n = 0; n < before.values.size(); ++n) {
    if (before.live[n / 12] != 0) {
      EXPECT_EQ(after.values[n], before.values[n]);
    }
  }
}

TEST(ResampleVolume, WhatTheNewGridCannotHoldIsTakenOut) {
  const survey::Index dims{1, 1, 401};
  const auto rms = [&](const Field& field, std::int64_t to) {
    const VolumeSource source = all_live(dims, field);
    const Filled got = filled(resampled(source, regridded(source.geometry, {1, 1, to})), 1);
    double sum = 0;
    for (std::int64_t k = 5; k < to - 5; ++k) sum += double(got.values[k]) * got.values[k];
    return std::sqrt(sum / double(to - 10));
  };
  const auto wave = [](double period) {
    return [period](std::int64_t, std::int64_t, std::int64_t k) {
      return static_cast<float>(std::sin(2 * 3.14159265358979 * double(k) / period + 0.3));
    };
  };
  EXPECT_LT(rms(wave(2.2), 101), 0.05);                   // far beyond: 8.8 periods in what holds 2
  EXPECT_NEAR(rms(wave(40), 101), std::sqrt(0.5), 0.02);  // well inside
  EXPECT_NEAR(rms(wave(10), 801), std::sqrt(0.5), 0.01);  // finer grid: kept
}

TEST(ResampleVolume, NullsStayWhereTheyAreAndDoNotSpread) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const survey::Index dims{5, 5, 21};
  VolumeSource source = all_live(dims, [&](std::int64_t i, std::int64_t, std::int64_t k) {
    if (i == 2 && k == 10) return nan;
    return k == 15 ? -999.0F : 7.0F;
  });
  source.null_value = -999.0F;
  const Filled got = filled(resampled(source, regridded(source.geometry, {5, 5, 41})), 8);
  for (std::int64_t i = 0; i < 5; ++i) {
    for (std::int64_t k = 0; k < 41; ++k) {
      const float value = got.values[(i * 5 + 2) * 41 + k];
      // New sample k lies at k / 2; of two equally near ones the lower counts.
      const std::int64_t nearest = k / 2;
      if ((i == 2 && nearest == 10) || nearest == 15) {
        EXPECT_TRUE(std::isnan(value)) << i << " " << k;
      } else {
        EXPECT_NEAR(value, 7, 1e-6) << i << " " << k;
      }
    }
  }
}

TEST(ResampleVolume, DeadTracesStayDead) {
  const VolumeSource source = made_source();
  const Filled got = filled(resampled(source, regridded(source.geometry, {19, 8, 12})), 32);
  for (std::int64_t i = 0; i < 19; ++i) {
    for (std::int64_t j = 0; j < 8; ++j) {
      EXPECT_EQ(got.live[i * 8 + j] != 0, made_live(i / 2, j)) << i << " " << j;
    }
  }
}

TEST(ResampleVolume, LineNumbersGoOnWhereTheyAreWhole) {
  const survey::Geometry old = made_source().geometry;  // inlines by 2, crosslines by 5
  const Regrid made = regridded(old, {19, 15, 12});
  EXPECT_EQ(made.geometry.inlines, (survey::LineAxis{100, 1, 19}));
  EXPECT_EQ(made.geometry.crosslines, (survey::LineAxis{1, 1, 15}));
  ASSERT_EQ(made.geometry.assumed.size(), 1u);
  EXPECT_NE(made.geometry.assumed[0].find("crosslines are numbered from 1"), std::string::npos);
  EXPECT_THROW(regridded(old, {1, 8, 12}), Error);
}

TEST(ResampleVolume, OntoTheSurveysGrid) {
  survey::Geometry survey = made_source().geometry;
  // The part: half the interval, twice the crossline spacing, other numbers, other directions of both lines.
  VolumeSource part = made_source();
  survey::Geometry& g = part.geometry;
  g.samples = 17;
  g.interval = 2;
  g.z0 = 1006;  // to 1038: survey samples 1008 to 1036
  g.inlines = {1, 1, 6};
  g.crosslines = {1, 1, 3};
  const survey::WorldPoint corner = survey.world_of({7, 6, 0});
  g.map = {corner.x, corner.y, -15, -20, -32, 24};  // inlines 7 down to 2, crosslines 6, 4, 2
  const auto value = [](double x, double y, double z) {
    return static_cast<float>((x - 500000) + 2 * (y - 6700000) - z);
  };
  part.fill = [g, value](const survey::Box& box, std::span<float> values, std::span<std::uint8_t>) {
    std::size_t n = 0;
    for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
      for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
        for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k) {
          const survey::WorldPoint p = g.world_of({double(i), double(j), double(k)});
          values[n++] = value(p.x, p.y, p.z);
        }
      }
    }
  };
  const VolumeSource made = resampled(part, on_survey(survey, g));
  EXPECT_EQ(made.geometry.inlines, (survey::LineAxis{104, 2, 6}));
  EXPECT_EQ(made.geometry.crosslines, (survey::LineAxis{-40, 5, 5}));
  EXPECT_EQ(made.geometry.samples, 8);
  EXPECT_EQ(origin_in(survey, made.geometry), (survey::Index{2, 2, 2}));
  const Filled got = filled(made, 2);
  for (std::int64_t i = 0; i < 6; ++i) {
    for (std::int64_t j = 0; j < 5; ++j) {
      for (std::int64_t k = 0; k < 8; ++k) {
        const survey::WorldPoint p = survey.world_of({double(i + 2), double(j + 2), double(k + 2)});
        ASSERT_NEAR(got.values[(i * 5 + j) * 8 + k], value(p.x, p.y, p.z), 1e-3);
      }
    }
  }
}

TEST(ResampleVolume, RefusesWhatDoesNotLieAlongTheSurvey) {
  const survey::Geometry survey = made_source().geometry;
  survey::Geometry turned = survey;
  turned.map = {500000, 6700000, 20, 15, -12, 16};
  EXPECT_THROW(on_survey(survey, turned), Error);
  survey::Geometry elsewhere = survey;
  elsewhere.map.origin_x += 1e6;
  EXPECT_THROW(on_survey(survey, elsewhere), Error);
  survey::Geometry depth = survey;
  depth.domain = survey::Domain::kDepth;
  depth.vertical_unit = survey::VerticalUnit::kMetre;
  EXPECT_THROW(on_survey(survey, depth), Error);
}

}  // namespace
}  // namespace footwall::tasks
