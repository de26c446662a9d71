// A folder that rank 0 makes, with a small volume and a job over it in it.
#pragma once
#include <gtest/gtest.h>
#include <zlib.h>

#include "engine/comm/communicator.h"
#include "mpi/session/small_job.h"
#include "storage/base/error.h"
#include "storage/volume/volume_reader.h"

namespace footwall::service {

class SmallVolume : public testing::Test {
 protected:
  SmallVolume() : world(MPI_COMM_WORLD) {
    std::string name;
    if (world.rank() == 0) {
      folder = std::make_unique<ScratchFolder>();
      checksum = session::write_small_job(folder->path()).volume_checksum;
      name = folder->path().string();
    }
    path = shared(name);
    checksum = shared(checksum);
  }
  ~SmallVolume() override { MPI_Barrier(world.get()); }

  std::string shared(const std::string& text) const {
    const auto raw = std::as_bytes(std::span(text));
    const comm::Bytes bytes = world.broadcast(comm::Bytes(raw.begin(), raw.end()), 0);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }
  std::filesystem::path volume() const { return path / "volume.h5"; }

  // The code of the Error that f throws on every rank alike.
  template <typename F>
  std::optional<ErrorCode> code_of(F&& f) const {
    std::optional<ErrorCode> code;
    try {
      f();
    } catch (const comm::AgreedError& error) {
      code = error.code();
    }
    const auto mine = std::int64_t{code ? static_cast<int>(*code) : -1};
    EXPECT_EQ(world.maximum(mine), mine);
    EXPECT_EQ(-world.maximum(-mine), mine);
    return code;
  }

  comm::Communicator world;
  std::unique_ptr<ScratchFolder> folder;
  std::filesystem::path path;
  std::string checksum;
};

template <typename T>
std::vector<T> inflated(const std::string& stream, std::size_t most) {
  std::vector<T> values(most);
  uLongf size = most * sizeof(T);
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(values.data()), &size,
                       reinterpret_cast<const Bytef*>(stream.data()), stream.size()),
            Z_OK);
  values.resize(size / sizeof(T));
  return values;
}

}  // namespace footwall::service
