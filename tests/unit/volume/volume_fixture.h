// A private folder, small volumes with known values, and the one way to damage a file.
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "scratch_folder.h"
#include "storage/base/error.h"
#include "storage/volume/volume_reader.h"
#include "storage/volume/volume_writer.h"

namespace footwall::volume {

using Value = std::function<float(std::int64_t, std::int64_t, std::int64_t)>;
using Alive = std::function<bool(std::int64_t, std::int64_t)>;

// Different for neighbours on every axis, of both signs, without a pattern that a shift would repeat.
inline float wavy(std::int64_t i, std::int64_t j, std::int64_t k) {
  const std::uint64_t n = static_cast<std::uint64_t>(i) * 73856093U ^
                          static_cast<std::uint64_t>(j) * 19349663U ^
                          static_cast<std::uint64_t>(k) * 83492791U;
  return static_cast<float>(static_cast<std::int64_t>(n % 200001U) - 100000) / 64.0F;
}

inline WriteOptions options_for(const survey::Index& dims) {
  WriteOptions options;
  options.geometry.inlines = {100, 2, dims[0]};
  options.geometry.crosslines = {300, 1, dims[1]};
  options.geometry.samples = dims[2];
  options.geometry.interval = 4;
  options.source = "a test";
  return options;
}

inline BlockSource source_of(const Value& value, const Alive& alive = {}) {
  return [value, alive](const survey::Box& box, std::span<float> values, std::span<std::uint8_t> live) {
    std::size_t n = 0;
    std::size_t trace = 0;
    for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
      for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
        if (alive) live[trace] = alive(i, j) ? 1 : 0;
        ++trace;
        for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k) values[n++] = value(i, j, k);
      }
    }
  };
}

// The code and text of the error that f throws; fails the test if it throws none.
struct Caught {
  ErrorCode code = ErrorCode::kInternal;
  std::string message;
};
inline Caught error_of(const std::function<void()>& f) {
  try {
    f();
  } catch (const Error& error) {
    return {error.code(), error.message()};
  }
  ADD_FAILURE() << "no error was thrown";
  return {};
}

class VolumeTest : public ::testing::Test {
 protected:
  std::ptrdiff_t entries() const {
    return std::distance(std::filesystem::directory_iterator(folder_.path()), {});
  }

  // Flips one bit of the byte at this offset.
  void flip(std::int64_t offset) const {
    std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(offset);
    const char byte = static_cast<char>(file.get() ^ 1);
    file.seekp(offset);
    file.put(byte);
    ASSERT_TRUE(file.good());
  }

  // From the text in front of the file.
  std::int64_t voxels_at() const {
    std::ifstream file(path_, std::ios::binary);
    std::string text(512, ' ');
    file.read(text.data(), 512);
    const std::string key = "\"voxels_at\":";
    return std::stoll(text.substr(text.find(key) + key.size()));
  }

  ScratchFolder folder_;
  std::filesystem::path path_ = folder_ / "v.h5";
};

}  // namespace footwall::volume
