// The same options, the same bytes: other blocks, other thread counts, another processor, another compiler.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <omp.h>

#include <bit>
#include <cstdio>

#include "unit/synthetic/small_survey.h"

namespace footwall::synthetic {
namespace {

// Whoever changes the model on purpose writes the new hashes down here and raises kGeneratorVersion.
constexpr std::string_view kVoxelHash = "cc718752e9c47271";
constexpr std::string_view kFaultHash = "b8378c8cfe5e3b60";

std::string output_of(const std::string& command) {
  std::string output;
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return "cannot start " + command;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) output += static_cast<char>(c);
  const int status = pclose(pipe);
  return status == 0 ? output : command + " failed";
}

TEST(Repeat, BytesAreTheOnesWrittenDown) {
  const FaultedSurvey survey(small_survey());
  EXPECT_EQ(hash_of_voxels(survey), kVoxelHash);
  EXPECT_EQ(hash_of_faults(survey), kFaultHash);
}

TEST(Repeat, ProcessorFeaturesDoNotMatter) {
  const std::string program = FOOTWALL_PRINT_HASH;
  const std::string hashes = fmt::format("{} {} ", kVoxelHash, kFaultHash);
  const std::string plain = output_of(program);
  EXPECT_TRUE(plain.starts_with(hashes)) << plain;
  // Both spellings of the C library's switch: before and since its version 2.33.
  const std::string masked = output_of(
      "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2_Usable,-FMA_Usable,-AVX512F_Usable,-AVX2,-FMA,-AVX512F,-"
      "AVX512VL " +
      program);
  EXPECT_TRUE(masked.starts_with(hashes)) << masked;
  EXPECT_EQ(masked.find("=on"), std::string::npos) << "the mask had no effect: " << masked;
}

// Large enough for threads, for several runs along a trace and for several strips of traces.
Options long_traces() {
  Options options;
  options.size = {17, 70, 1100};
  return options;
}

TEST(Repeat, ThreadsDoNotMatter) {
  const FaultedSurvey survey(long_traces());
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const std::string alone = hash_of_voxels(survey);
  for (const int threads : {2, 5}) {
    omp_set_num_threads(threads);
    EXPECT_EQ(hash_of_voxels(survey), alone) << threads << " threads";
  }
  omp_set_num_threads(before);
}

TEST(Repeat, AnyBoxIsAPartOfTheWhole) {
  const FaultedSurvey survey(long_traces());
  const std::vector<float> whole = all_of(survey);
  const survey::Box boxes[] = {{{0, 0, 0}, {1, 1, 1}},         {{16, 69, 1099}, {17, 70, 1100}},
                               {{3, 60, 1000}, {9, 70, 1100}}, {{0, 0, 1021}, {17, 70, 1031}},
                               {{5, 1, 3}, {6, 67, 1050}},     {{2, 7, 513}, {4, 8, 514}}};
  for (const survey::Box& box : boxes) {
    std::vector<float> part(static_cast<std::size_t>(box.count()));
    survey.fill(box, part);
    std::size_t n = 0;
    for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
      for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
        for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k) {
          const float expected = whole[static_cast<std::size_t>((i * 70 + j) * 1100 + k)];
          ASSERT_EQ(std::bit_cast<std::uint32_t>(part[n++]), std::bit_cast<std::uint32_t>(expected))
              << i << " " << j << " " << k;
        }
      }
    }
  }
}

TEST(Repeat, SeedsDiffer) {
  Options options = small_survey();
  options.seed = 8;
  const FaultedSurvey survey(options);
  EXPECT_NE(hash_of_voxels(survey), kVoxelHash);
  EXPECT_NE(hash_of_faults(survey), kFaultHash);
}

}  // namespace
}  // namespace footwall::synthetic
