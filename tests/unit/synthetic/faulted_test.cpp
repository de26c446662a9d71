#include "engine/synthetic/faulted.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "storage/base/error.h"
#include "unit/synthetic/small_survey.h"

namespace footwall::synthetic {
namespace {

constexpr double kNoNoise = std::numeric_limits<double>::infinity();

double rms(const std::vector<float>& values) {
  double sum = 0;
  for (const float value : values) sum += static_cast<double>(value) * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

// The frequency in cycles per sample at which traces have most energy, by a plain Fourier sum.
double peak_frequency(const std::vector<float>& values, std::int64_t samples) {
  const std::int64_t traces = static_cast<std::int64_t>(values.size()) / samples;
  double best = 0;
  double best_power = 0;
  for (double frequency = 0.01; frequency < 0.5; frequency += 0.01) {
    double power = 0;
    for (std::int64_t trace = 0; trace < traces; trace += 41) {
      double re = 0;
      double im = 0;
      for (std::int64_t k = 0; k < samples; ++k) {
        const double value = values[static_cast<std::size_t>(trace * samples + k)];
        re += value * std::cos(2 * M_PI * frequency * static_cast<double>(k));
        im += value * std::sin(2 * M_PI * frequency * static_cast<double>(k));
      }
      power += re * re + im * im;
    }
    if (power > best_power) best = frequency;
    best_power = std::max(best_power, power);
  }
  return best;
}

class FaultedStatistics : public testing::Test {
 protected:
  static constexpr std::int64_t kSize = 96;
  static Options options(double signal_to_noise) {
    Options options;
    options.size = {kSize, kSize, kSize};
    options.signal_to_noise = signal_to_noise;
    return options;
  }
  const std::vector<float> signal_ = all_of(FaultedSurvey(options(kNoNoise)));
  const std::vector<float> noisy_ = all_of(FaultedSurvey(options(2)));
  std::vector<float> noise() const {
    std::vector<float> noise = noisy_;
    for (std::size_t n = 0; n < noise.size(); ++n) noise[n] -= signal_[n];
    return noise;
  }
};

TEST_F(FaultedStatistics, SignalHasRmsAboutOne) {
  EXPECT_NEAR(rms(signal_), 1, 0.2);
}

TEST_F(FaultedStatistics, NoiseIsAsStrongAsAsked) {
  EXPECT_NEAR(rms(noise()), 0.5, 0.02);
}

TEST_F(FaultedStatistics, SignalAndNoiseHaveTheWaveletsBand) {
  EXPECT_NEAR(peak_frequency(signal_, kSize), 0.085, 0.026);
  EXPECT_NEAR(peak_frequency(noise(), kSize), 0.085, 0.016);
}

TEST_F(FaultedStatistics, NoiseOfNeighbouringTracesIsAlike) {
  const std::vector<float> values = noise();
  const auto correlation = [&](std::size_t step) {
    double product = 0;
    double power = 0;
    for (std::size_t n = 0; n + step < values.size(); ++n) {
      product += static_cast<double>(values[n]) * values[n + step];
      power += static_cast<double>(values[n]) * values[n];
    }
    return product / power;
  };
  // Weights 1 2 1 over uncorrelated traces: 4/6 one trace away, 1/6 two, 0 three; both ways alike.
  EXPECT_NEAR(correlation(kSize), 4.0 / 6, 0.03);
  EXPECT_NEAR(correlation(kSize * kSize), 4.0 / 6, 0.03);
  EXPECT_NEAR(correlation(2 * kSize), 1.0 / 6, 0.03);
  EXPECT_NEAR(correlation(3 * kSize), 0, 0.03);
}

TEST(Faulted, SurveyLiesInTheWorldAsRealOnesDo) {
  const FaultedSurvey survey(small_survey());
  const survey::Geometry& geometry = survey.geometry();
  EXPECT_EQ(geometry.dims(), (survey::Index{48, 40, 56}));
  EXPECT_EQ(geometry.inlines.first, 300);
  EXPECT_EQ(geometry.crosslines.last(), 600 + 39 * 2);
  EXPECT_EQ(geometry.interval, 4);
  const survey::WorldPoint origin = geometry.world_of({0, 0, 0});
  const survey::WorldPoint next_inline = geometry.world_of({1, 0, 0});
  const survey::WorldPoint next_crossline = geometry.world_of({0, 1, 0});
  EXPECT_EQ(std::hypot(next_inline.x - origin.x, next_inline.y - origin.y), 25);
  EXPECT_EQ(std::hypot(next_crossline.x - origin.x, next_crossline.y - origin.y), 12.5);
  EXPECT_EQ((next_inline.x - origin.x) * (next_crossline.x - origin.x) +
                (next_inline.y - origin.y) * (next_crossline.y - origin.y),
            0)
      << "inlines and crosslines meet at right angles";
  EXPECT_NE(next_inline.x, origin.x) << "rotated";
}

TEST(Faulted, AnySizeFromOneVoxelUpWorks) {
  for (const survey::Index& size : {survey::Index{1, 1, 1},
                                    {1, 1, 2},
                                    {2, 1, 1},
                                    {3, 2, 1},
                                    {1, 5, 40},
                                    {15, 200, 20},
                                    {16, 16, 16},
                                    {16, 17, 300},
                                    {130, 16, 16},
                                    {1, 1, 20000}}) {
    Options options;
    options.size = size;
    const FaultedSurvey survey(options);
    const std::vector<float> values = all_of(survey);
    for (const float value : values) ASSERT_TRUE(std::abs(value) < 20) << value;
    EXPECT_GT(rms(values), 0.01) << size[0] << " x " << size[1] << " x " << size[2];
    const bool room = std::min({size[0], size[1], size[2]}) >= 16;
    EXPECT_EQ(survey.faults().size(), room ? 3U : 0U);
    for (const Fault& fault : survey.faults()) {
      EXPECT_GE(fault.pillars.size(), 2U)
          << fault.name << " " << size[0] << " x " << size[1] << " x " << size[2];
      EXPECT_FALSE(fault.truth.triangles.empty()) << fault.name;
    }
  }
}

TEST(Faulted, LargestSurveyCanBeDescribedAndRead) {
  Options options;
  options.size = {1 << 20, 1 << 17, 1 << 23};
  const FaultedSurvey survey(options);
  for (const Fault& fault : survey.faults()) EXPECT_LE(fault.pillars.size(), 1024U) << fault.name;
  std::vector<float> values(100);
  survey.fill({{(1 << 20) - 1, (1 << 17) - 1, (1 << 23) - 100}, {1 << 20, 1 << 17, 1 << 23}}, values);
  EXPECT_GT(rms(values), 0.01);
}

TEST(Faulted, RefusesWhatCannotBeMade) {
  const auto code_of = [](auto change) {
    Options options = small_survey();
    change(options);
    try {
      const FaultedSurvey survey(options);
    } catch (const Error& error) {
      EXPECT_FALSE(error.hint().empty());
      return error.code();
    }
    return ErrorCode::kInternal;
  };
  EXPECT_EQ(code_of([](Options& o) { o.size[1] = 0; }), ErrorCode::kUsage);
  EXPECT_EQ(code_of([](Options& o) { o.size[0] = -4; }), ErrorCode::kUsage);
  EXPECT_EQ(code_of([](Options& o) { o.size[2] = (1 << 23) + 1; }), ErrorCode::kUsage);
  EXPECT_EQ(code_of([](Options& o) { o.size = {1 << 23, 1 << 23, 1 << 23}; }), ErrorCode::kUsage);
  EXPECT_EQ(code_of([](Options& o) { o.signal_to_noise = 0; }), ErrorCode::kUsage);
  EXPECT_EQ(code_of([](Options& o) { o.signal_to_noise = std::nan(""); }), ErrorCode::kUsage);
  EXPECT_EQ(code_of([](Options& o) { o.pillar_every_lines = 0; }), ErrorCode::kUsage);
  EXPECT_EQ(code_of([](Options& o) { o.jitter_voxels = -1; }), ErrorCode::kUsage);
}

TEST(Faulted, FillRefusesBoxesOutsideAndWrongLengths) {
  const FaultedSurvey survey(small_survey());
  std::vector<float> values(8);
  EXPECT_THROW(survey.fill({{0, 0, -1}, {2, 2, 1}}, values), Error);
  EXPECT_THROW(survey.fill({{46, 38, 55}, {48, 40, 57}}, values), Error);
  EXPECT_THROW(survey.fill({{0, 0, 0}, {2, 2, 1}}, values), Error);
  EXPECT_NO_THROW(survey.fill({{5, 5, 5}, {5, 9, 9}}, {}));
}

TEST(Faulted, DescriptionNamesWhatItWasMadeFrom) {
  const FaultedSurvey survey(small_survey());
  const nlohmann::json json = nlohmann::json::parse(survey.description_json());
  EXPECT_EQ(json.at("generator"), "faulted");
  EXPECT_EQ(json.at("seed"), 7);
  EXPECT_EQ(json.at("signal_to_noise"), 4);
  EXPECT_EQ(json.at("faults").size(), 3U);
  EXPECT_EQ(json.at("faults").at(0).at("pillar_every_lines"), 5);
  Options quiet = small_survey();
  quiet.signal_to_noise = kNoNoise;
  EXPECT_TRUE(nlohmann::json::parse(FaultedSurvey(quiet).description_json()).at("signal_to_noise").is_null());
}

}  // namespace
}  // namespace footwall::synthetic
