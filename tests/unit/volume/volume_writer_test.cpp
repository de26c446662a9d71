#include "storage/volume/volume_writer.h"

#include <omp.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <csignal>
#include <limits>

#include "unit/volume/volume_fixture.h"

namespace footwall::volume {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

TEST_F(VolumeTest, WhatWasWrittenIsReadBackWhateverTheShape) {
  const std::vector<std::pair<survey::Index, survey::Index>> shapes{
      {{1, 1, 1}, {64, 64, 64}}, {{1, 37, 1}, {1, 8, 1}},    {{5, 1, 90}, {4, 4, 32}},
      {{17, 23, 41}, {8, 8, 8}}, {{16, 16, 16}, {8, 8, 16}}, {{9, 70, 130}, {64, 64, 64}}};
  for (const auto& [dims, chunk] : shapes) {
    WriteOptions options = options_for(dims);
    options.chunk = chunk;
    const VolumeInfo written = write_volume(path_, options, source_of(wavy), JobContext());
    const VolumeReader reader(path_);
    EXPECT_EQ(reader.info().dims, dims);
    EXPECT_EQ(reader.info().checksum, written.checksum);
    EXPECT_EQ(reader.info().bytes, static_cast<std::int64_t>(std::filesystem::file_size(path_)));
    std::vector<float> all(static_cast<std::size_t>(dims[0] * dims[1] * dims[2]));
    reader.read(options.geometry.box(), all);
    std::size_t n = 0;
    for (std::int64_t i = 0; i < dims[0]; ++i) {
      for (std::int64_t j = 0; j < dims[1]; ++j) {
        for (std::int64_t k = 0; k < dims[2]; ++k)
          ASSERT_EQ(all[n++], wavy(i, j, k)) << i << ' ' << j << ' ' << k;
      }
    }
    reader.verify(JobContext());
  }
}

TEST_F(VolumeTest, InfoComesBackWhole) {
  WriteOptions options = options_for({3, 4, 5});
  options.geometry.z0 = 0.1;
  options.geometry.crs = "ED50 / UTM zone 31N";
  options.geometry.assumed = {"the unit"};
  options.geometry.map = {6e5 + 1.0 / 3, 6e6, 12.3, 4.56, -7.8, 9.1};
  options.origin = {10, 20, 30};
  options.null_value = -999.25F;
  options.role = Role::kDiscontinuity;
  options.high_is_fault = false;
  options.source = "lines \"1\" to\n2";
  options.provenance_json = "{\"header\":\"" + std::string(200000, 'C') + "\"}";
  const VolumeInfo written = write_volume(path_, options, source_of(wavy), JobContext());
  const VolumeInfo info = VolumeReader(path_).info();
  EXPECT_EQ(info.geometry, options.geometry);
  EXPECT_EQ(info.origin, options.origin);
  EXPECT_EQ(info.null_value, options.null_value);
  EXPECT_EQ(info.role, Role::kDiscontinuity);
  EXPECT_FALSE(info.high_is_fault);
  EXPECT_EQ(info.source, options.source);
  EXPECT_EQ(info.provenance_json, options.provenance_json);
  EXPECT_EQ(info.statistics, written.statistics);
  EXPECT_EQ(info.chunk, (survey::Index{3, 4, 5}));
}

TEST_F(VolumeTest, NullsAndDeadTracesAreNaNAndOutsideTheStatistics) {
  WriteOptions options = options_for({10, 9, 20});
  options.null_value = -999.25F;
  const auto value = [](std::int64_t i, std::int64_t j, std::int64_t k) {
    if (k == 3) return -999.25F;
    if (k == 4) return kNaN;
    if (k == 5)
      return i % 2 == 0 ? std::numeric_limits<float>::infinity() : -std::numeric_limits<float>::infinity();
    return i == 7 ? 1e30F : static_cast<float>(j);  // inline 7 is dead: its values must not count
  };
  const auto alive = [](std::int64_t i, std::int64_t j) { return i != 7 && !(i == 0 && j == 8); };
  const VolumeInfo info = write_volume(path_, options, source_of(value, alive), JobContext());
  EXPECT_EQ(info.statistics.live_traces, 10 * 9 - 9 - 1);
  EXPECT_EQ(info.statistics.null_count, 80 * 3 + 10 * 20);
  EXPECT_EQ(info.statistics.count, 80 * 17);
  EXPECT_EQ(info.statistics.max, 8);
  EXPECT_EQ(info.statistics.min, 0);

  const VolumeReader reader(path_);
  const auto live = reader.live_mask();
  std::vector<float> all(10 * 9 * 20);
  reader.read(options.geometry.box(), all);
  for (std::int64_t i = 0; i < 10; ++i) {
    for (std::int64_t j = 0; j < 9; ++j) {
      const auto trace = static_cast<std::size_t>(i * 9 + j);
      EXPECT_EQ(live[trace], alive(i, j) ? 1 : 0);
      for (std::size_t k = 0; k < 20; ++k) {
        const float v = all[trace * 20 + k];
        if (!alive(i, j) || (k >= 3 && k <= 5)) {
          EXPECT_TRUE(std::isnan(v));
        } else {
          EXPECT_EQ(v, static_cast<float>(j));
        }
      }
    }
  }
}

TEST_F(VolumeTest, ASurveyOfNullsHasNoStatistics) {
  const VolumeInfo info = write_volume(path_, options_for({4, 4, 4}),
                                       source_of([](auto, auto, auto) { return kNaN; }), JobContext());
  EXPECT_EQ(info.statistics.count, 0);
  EXPECT_EQ(info.statistics.null_count, 64);
  EXPECT_EQ(info.statistics.percentiles.size(), 101U);
  EXPECT_EQ(VolumeReader(path_).info().statistics, info.statistics);
}

TEST_F(VolumeTest, TheSameVolumeGivesTheSameBytesAndStatisticsInAnyChunks) {
  WriteOptions options = options_for({30, 20, 50});
  const VolumeInfo a = write_volume(path_, options, source_of(wavy), JobContext());
  const VolumeInfo again = write_volume(folder_ / "again.h5", options, source_of(wavy), JobContext());
  options.chunk = survey::Index{7, 5, 16};
  const VolumeInfo b = write_volume(folder_ / "b.h5", options, source_of(wavy), JobContext());
  EXPECT_EQ(a.statistics, b.statistics);
  EXPECT_EQ(a.checksum, again.checksum);
  const auto bytes = [](const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  EXPECT_TRUE(bytes(path_) == bytes(folder_ / "again.h5"));
}

// Zeros of both signs are the smallest values: which one a thread meets first must not show in the file.
TEST_F(VolumeTest, TheFileIsTheSameForAnyNumberOfThreads) {
  WriteOptions options = options_for({40, 50, 60});
  options.chunk = survey::Index{8, 8, 16};
  const auto value = [](std::int64_t i, std::int64_t j, std::int64_t k) {
    const std::int64_t n = (i * 7 + j * 5 + k * 3) % 11;
    return n < 3 ? 0.0F : n < 6 ? -0.0F : wavy(i, j, k) * wavy(i, j, k);
  };
  const auto alive = [](std::int64_t i, std::int64_t j) { return (i + j) % 9 != 0; };
  const int before = omp_get_max_threads();
  std::string expected;
  for (const int threads : {1, 2, 7}) {
    omp_set_num_threads(threads);
    write_volume(path_, options, source_of(value, alive), JobContext());
    const std::string bytes = content_of(path_);
    if (expected.empty()) expected = bytes;
    EXPECT_TRUE(bytes == expected) << threads << " threads";
  }
  omp_set_num_threads(before);
}

TEST_F(VolumeTest, BlocksAreWholeTracesInOrder) {
  WriteOptions options = options_for({20, 30, 40});
  options.chunk = survey::Index{8, 16, 8};
  std::vector<survey::Box> boxes;
  write_volume(
      path_, options,
      [&](const survey::Box& box, std::span<float> values, std::span<std::uint8_t> live) {
        EXPECT_EQ(values.size(), static_cast<std::size_t>(box.count()));
        EXPECT_EQ(live.size(), static_cast<std::size_t>(box.size(0) * box.size(1)));
        std::fill(values.begin(), values.end(), 0.0F);
        boxes.push_back(box);
      },
      JobContext());
  ASSERT_EQ(boxes.size(), 6U);
  EXPECT_EQ(boxes[0], (survey::Box{{0, 0, 0}, {8, 16, 40}}));
  EXPECT_EQ(boxes[1], (survey::Box{{0, 16, 0}, {8, 30, 40}}));
  EXPECT_EQ(boxes[5], (survey::Box{{16, 16, 0}, {20, 30, 40}}));
}

TEST_F(VolumeTest, CancelOrAFailingSourceLeavesTheOldFileAlone) {
  WriteOptions options = options_for({32, 8, 8});
  options.chunk = survey::Index{4, 8, 8};
  const VolumeInfo old = write_volume(path_, options, source_of(wavy), JobContext());
  JobContext job;
  const auto cancels = [&](const survey::Box& box, std::span<float> values, std::span<std::uint8_t>) {
    std::fill(values.begin(), values.end(), 1.0F);
    if (box.lo[0] == 8) job.cancel();
  };
  EXPECT_EQ(error_of([&] { write_volume(path_, options, cancels, job); }).code, ErrorCode::kCancelled);
  const auto fails = [&](const survey::Box& box, std::span<float>, std::span<std::uint8_t>) {
    if (box.lo[0] == 8) throw Error(ErrorCode::kFormat, "trace 17 is short");
  };
  EXPECT_EQ(error_of([&] { write_volume(path_, options, fails, JobContext()); }).message,
            "trace 17 is short");
  EXPECT_EQ(entries(), 1);
  EXPECT_EQ(VolumeReader(path_).info().checksum, old.checksum);
}

TEST_F(VolumeTest, WhatCannotBeStoredIsRefusedBeforeTheSourceIsAsked) {
  const BlockSource never = [](const survey::Box&, std::span<float>, std::span<std::uint8_t>) {
    ADD_FAILURE() << "the source was asked";
  };
  const auto code = [&](const WriteOptions& options) {
    return error_of([&] { write_volume(path_, options, never, JobContext()); }).code;
  };
  WriteOptions options = options_for({4, 4, 4});
  options.provenance_json = "{not json";
  EXPECT_EQ(code(options), ErrorCode::kInvalid);
  options = options_for({4, 4, 4});
  options.geometry.interval = 0;
  EXPECT_EQ(code(options), ErrorCode::kInvalid);
  options = options_for({1 << 20, 1 << 20, 64});
  options.chunk = survey::Index{1 << 20, 1 << 20, 64};
  EXPECT_EQ(code(options), ErrorCode::kInvalid);
  EXPECT_EQ(code(options_for({1 << 20, 1 << 20, 64})), ErrorCode::kIo) << "256 TiB fit on no disk";
  EXPECT_EQ(code(options_for({1 << 23, 1 << 23, 1 << 23})), ErrorCode::kInvalid)
      << "no 64-bit file can hold it";
  EXPECT_EQ(entries(), 0);
}

TEST_F(VolumeTest, AFullDiskIsAnErrorAndLeavesNothing) {
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    omp_set_num_threads(1);  // the parent's threads do not exist here
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{1U << 20, 1U << 20};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    int result = 1;
    try {
      write_volume(path_, options_for({64, 64, 256}), source_of(wavy), JobContext());
    } catch (const Error& error) {
      const bool said = error.message().find("cannot write") != std::string::npos;
      result = error.code() == ErrorCode::kIo && said ? 0 : 2;
    }
    std::exit(result);  // with HDF5's own clean-up at exit: that must not crash either
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_EQ(entries(), 0);
}

TEST(DefaultChunk, KeepsBlocksBounded) {
  EXPECT_EQ(default_chunk({1, 5, 500})[1], 5);
  for (const survey::Index& dims :
       {survey::Index{651, 951, 463}, survey::Index{4000, 4000, 6000}, survey::Index{100, 100, 1 << 18}}) {
    const survey::Index chunk = default_chunk(dims);
    EXPECT_LE(chunk[0] * chunk[1] * dims[2] * 4, std::int64_t{128} << 20);
    EXPECT_GE(chunk[0] * chunk[1], 64);
  }
}

}  // namespace
}  // namespace footwall::volume
