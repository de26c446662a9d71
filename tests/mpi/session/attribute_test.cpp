#include "engine/session/attribute.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/verify/contrast_by_definition.h"
#include "mpi/session/small_job.h"
#include "storage/base/partial_file.h"
#include "storage/volume/volume_reader.h"

namespace footwall::session {
namespace {

// A folder made by rank 0 with a small volume in it.
class Attribute : public testing::Test {
 protected:
  Attribute() : world(MPI_COMM_WORLD) {
    if (world.rank() == 0) {
      folder = std::make_unique<ScratchFolder>();
      write_small_job(folder->path());
    }
    const std::string name = folder ? folder->path().string() : "";
    const auto raw = std::as_bytes(std::span(name));
    const comm::Bytes bytes = world.broadcast(comm::Bytes(raw.begin(), raw.end()), 0);
    path = std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  ~Attribute() override { MPI_Barrier(world.get()); }

  std::filesystem::path job_with(const std::function<void(AttributeJob&)>& change) {
    AttributeJob job{path / "volume.h5", path / "made.h5", path / "result.json", {3, 3, 5}};
    change(job);
    world.collectively([&] {
      if (world.rank() == 0) write_attribute_job(job, path / "ATTRIBUTE.json");
    });
    return path / "ATTRIBUTE.json";
  }
  ErrorCode code_of(const std::filesystem::path& job, const JobContext& context = {}) {
    try {
      run_attribute(world, job, context);
    } catch (const comm::AgreedError& error) {
      return error.code();
    }
    return ErrorCode::kInternal;
  }

  comm::Communicator world;
  std::unique_ptr<ScratchFolder> folder;
  std::filesystem::path path;
};

TEST_F(Attribute, IsTheDefinitionForAnyNumberOfRanks) {
  run_attribute(world, job_with([](AttributeJob&) {}), {});
  if (world.rank() != 0) return;
  const volume::VolumeReader source(path / "volume.h5");
  const volume::VolumeReader made(path / "made.h5");
  EXPECT_EQ(made.info().role, volume::Role::kDiscontinuity);
  EXPECT_TRUE(made.info().high_is_fault);
  EXPECT_TRUE(made.info().geometry == source.info().geometry);
  const auto provenance = nlohmann::json::parse(made.info().provenance_json);
  EXPECT_EQ(provenance["window"], "3x3x5");
  EXPECT_EQ(provenance["of"]["checksum"], to_hex(source.info().checksum));
  // Blocks of single processors give this file, too.
  const nlohmann::json result = nlohmann::json::parse(read_whole_file(path / "result.json", 1 << 20));
  EXPECT_EQ(result["checksum"], to_hex(made.info().checksum));
  const survey::Box box{{0, 0, 0}, kSmallDims};
  std::vector<float> values(static_cast<std::size_t>(box.count()));
  made.read(box, values);
  std::size_t n = 0;
  for (std::int64_t i = 0; i < kSmallDims[0]; ++i) {
    for (std::int64_t j = 0; j < kSmallDims[1]; ++j) {
      for (std::int64_t k = 0; k < kSmallDims[2]; ++k, ++n) {
        const float want = verify::attribute_by_definition({i, j, k}, {3, 3, 5}, kSmallDims, small_value,
                                                           source.info().statistics.max_abs);
        ASSERT_EQ(std::isnan(values[n]), std::isnan(want));
        if (!std::isnan(want)) {
          ASSERT_EQ(std::bit_cast<std::uint32_t>(values[n]), std::bit_cast<std::uint32_t>(want));
        }
      }
    }
  }
}

// Nine blocks, of which more than one falls to a rank: what neighbours share is read once, and must be right.
TEST_F(Attribute, BlocksAreThoseOfTheDefinition) {
  const survey::Index dims{70, 67, 6};
  const extract::Window window{5, 3, 3};
  const auto value = [](const survey::Index& p) {
    const std::int64_t n = (p[0] * 7919 + p[1] * 104729 + p[2] * 15485863) % 20011;
    return n % 37 == 0 ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(n - 10000) * 0.125F;
  };
  world.collectively([&] {
    if (world.rank() != 0) return;
    volume::WriteOptions options;
    options.geometry.inlines.count = dims[0];
    options.geometry.crosslines.count = dims[1];
    options.geometry.samples = dims[2];
    const auto fill = [&](const survey::Box& box, std::span<float> values, std::span<std::uint8_t>) {
      std::size_t n = 0;
      for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
        for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
          for (std::int64_t k = 0; k < dims[2]; ++k) values[n++] = value({i, j, k});
        }
      }
    };
    volume::write_volume(path / "blocks.h5", options, fill, {});
  });
  run_attribute(world, job_with([&](AttributeJob& job) {
                  job.volume = path / "blocks.h5";
                  job.window = window;
                }),
                {});
  if (world.rank() != 0) return;
  const double max_abs = volume::VolumeReader(path / "blocks.h5").info().statistics.max_abs;
  const volume::VolumeReader made(path / "made.h5");
  EXPECT_EQ(made.info().chunk, (survey::Index{32, 32, 6}));
  std::vector<float> values(static_cast<std::size_t>(dims[0] * dims[1] * dims[2]));
  made.read({{0, 0, 0}, dims}, values);
  std::size_t n = 0;
  for (std::int64_t i = 0; i < dims[0]; ++i) {
    for (std::int64_t j = 0; j < dims[1]; ++j) {
      for (std::int64_t k = 0; k < dims[2]; ++k, ++n) {
        const float want = verify::attribute_by_definition(
            {i, j, k}, {window.inlines, window.crosslines, window.samples}, dims, value, max_abs);
        ASSERT_EQ(std::isnan(values[n]), std::isnan(want));
        if (!std::isnan(want)) {
          ASSERT_EQ(std::bit_cast<std::uint32_t>(values[n]), std::bit_cast<std::uint32_t>(want));
        }
      }
    }
  }
}

TEST_F(Attribute, TroubleIsTheSameErrorOnAllRanksAndLeavesNoFile) {
  EXPECT_EQ(code_of(job_with([&](AttributeJob& job) { job.volume = path / "gone.h5"; })),
            ErrorCode::kNotFound);
  // Only rank 0 makes the file, so only it sees this.
  EXPECT_EQ(code_of(job_with([&](AttributeJob& job) { job.output = path / "no such folder" / "made.h5"; })),
            ErrorCode::kNotFound);
  const JobContext cancelled;
  if (world.rank() == world.size() - 1) cancelled.cancel();
  EXPECT_EQ(code_of(job_with([](AttributeJob&) {}), cancelled), ErrorCode::kCancelled);
  EXPECT_FALSE(std::filesystem::exists(path / "made.h5"));
  EXPECT_FALSE(std::filesystem::exists(path / "result.json"));
  world.collectively([&] {
    if (world.rank() == 0) write_whole_file(path / "ATTRIBUTE.json", "{}");
  });
  EXPECT_EQ(code_of(path / "ATTRIBUTE.json"), ErrorCode::kFormat);
}

}  // namespace
}  // namespace footwall::session
