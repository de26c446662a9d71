#include "storage/volume/volume_reader.h"

#include <hdf5.h>

#include <random>
#include <thread>

#include "unit/volume/volume_fixture.h"

namespace footwall::volume {
namespace {

using ::testing::Test;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

class VolumeReaderTest : public VolumeTest {
 protected:
  // Chunks 4 x 5 x 6 over 10 x 12 x 15: every axis has a partial chunk.
  void write() {
    WriteOptions options = options_for({10, 12, 15});
    options.chunk = survey::Index{4, 5, 6};
    write_volume(path_, options, source_of(wavy), JobContext());
  }
  static constexpr std::int64_t kChunkBytes = 4 * 5 * 6 * 4;
};

TEST_F(VolumeReaderTest, AnyBoxIsReadRight) {
  write();
  const VolumeReader reader(path_);
  std::mt19937 random(7);
  for (int n = 0; n < 300; ++n) {
    survey::Box box;
    for (int axis = 0; axis < 3; ++axis) {
      const std::int64_t size = reader.info().dims[axis];
      box.lo[axis] = static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(size));
      box.hi[axis] = box.lo[axis] + 1 +
                     static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(size - box.lo[axis]));
    }
    std::vector<float> out(static_cast<std::size_t>(box.count()));
    reader.read(box, out);
    std::size_t at = 0;
    for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
      for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
        for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k) ASSERT_EQ(out[at++], wavy(i, j, k));
      }
    }
  }
}

TEST_F(VolumeReaderTest, RefusesABoxOutsideAndReadsNothingForAnEmptyOne) {
  write();
  const VolumeReader reader(path_);
  std::vector<float> one(1);
  EXPECT_NO_THROW(reader.read({{3, 3, 3}, {3, 4, 4}}, {}));
  EXPECT_NO_THROW(reader.read({{-5, 0, 0}, {-5, 0, 0}}, {}));
  EXPECT_THROW(reader.read({{10, 0, 0}, {11, 1, 1}}, one), Error);
  EXPECT_THROW(reader.read({{-1, 0, 0}, {0, 1, 1}}, one), Error);
  EXPECT_THROW(reader.read({{0, 0, 0}, {1, 1, 2}}, one), Error);
}

TEST_F(VolumeReaderTest, OneFlippedBitIsFoundWithItsPlace) {
  write();
  // 3 x 3 x 3 chunks; number 14 is (1, 1, 2): inlines 4 to 7, crosslines 5 to 9, samples 12 to 14.
  flip(voxels_at() + 14 * kChunkBytes + 100);
  const VolumeReader reader(path_);
  const std::string place = "chunk 14 (inlines 4 to 7, crosslines 5 to 9, samples 12 to 14, counted from 0)";
  std::vector<float> out(4 * 5 * 12);
  EXPECT_NO_THROW(reader.read({{4, 5, 0}, {8, 10, 12}}, out)) << "other chunks are not concerned";
  out.resize(1);
  Caught caught = error_of([&] { reader.read({{4, 5, 14}, {5, 6, 15}}, out); });
  EXPECT_EQ(caught.code, ErrorCode::kCorrupt);
  EXPECT_TRUE(contains(caught.message, place)) << caught.message;
  flip(voxels_at() + 26 * kChunkBytes);
  caught = error_of([&] { reader.verify(JobContext()); });
  EXPECT_EQ(caught.code, ErrorCode::kCorrupt);
  EXPECT_TRUE(contains(caught.message, place)) << caught.message;
  EXPECT_TRUE(contains(caught.message, "2 of 27 chunks")) << caught.message;
}

TEST_F(VolumeReaderTest, ATruncatedFileNamesTheFirstLostChunk) {
  write();
  const std::int64_t first = voxels_at();
  const auto size = static_cast<std::int64_t>(std::filesystem::file_size(path_));
  std::filesystem::resize_file(path_, static_cast<std::uintmax_t>(size - 1));
  Caught caught = error_of([&] { const VolumeReader reader(path_); });
  EXPECT_EQ(caught.code, ErrorCode::kCorrupt);
  EXPECT_TRUE(contains(caught.message, "truncated")) << caught.message;
  std::filesystem::resize_file(path_, static_cast<std::uintmax_t>(first + 14 * kChunkBytes + 8));
  caught = error_of([&] { const VolumeReader reader(path_); });
  EXPECT_EQ(caught.code, ErrorCode::kCorrupt);
  EXPECT_TRUE(contains(caught.message, "chunk 14 (inlines 4 to 7")) << caught.message;
  std::filesystem::resize_file(path_, 300);
  EXPECT_EQ(error_of([&] { const VolumeReader reader(path_); }).code, ErrorCode::kCorrupt);
}

TEST_F(VolumeReaderTest, NoSingleFlippedByteGoesUnnoticedOrCrashes) {
  write();
  std::vector<float> expected(10 * 12 * 15);
  const survey::Box all{{0, 0, 0}, {10, 12, 15}};
  VolumeInfo info;
  {
    const VolumeReader reader(path_);
    reader.read(all, expected);
    info = reader.info();
  }
  const auto size = static_cast<std::int64_t>(std::filesystem::file_size(path_));
  int noticed = 0;
  for (std::int64_t offset = 0; offset < size; offset += 23) {
    flip(offset);
    try {
      const VolumeReader reader(path_);
      std::vector<float> out(expected.size());
      reader.read(all, out);
      reader.verify(JobContext());
      // Bytes that nothing uses may change; what is read must not.
      EXPECT_EQ(out, expected) << "offset " << offset;
      EXPECT_EQ(reader.info().geometry, info.geometry) << "offset " << offset;
      EXPECT_EQ(reader.info().statistics, info.statistics) << "offset " << offset;
    } catch (const Error& error) {
      EXPECT_NE(error.code(), ErrorCode::kInternal) << error.message();
      ++noticed;
    }
    flip(offset);
  }
  EXPECT_GT(noticed, 300);
}

TEST_F(VolumeReaderTest, ForeignFilesAreNamedForWhatTheyAre) {
  EXPECT_EQ(error_of([&] { const VolumeReader reader(path_); }).code, ErrorCode::kNotFound);
  EXPECT_EQ(error_of([&] { const VolumeReader reader(folder_.path()); }).code, ErrorCode::kFormat);
  std::ofstream(path_) << "x";
  EXPECT_EQ(error_of([&] { const VolumeReader reader(path_); }).code, ErrorCode::kFormat);
  const hid_t file = H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  H5Fclose(file);
  const Caught caught = error_of([&] { const VolumeReader reader(path_); });
  EXPECT_EQ(caught.code, ErrorCode::kFormat);
  EXPECT_TRUE(contains(caught.message, "not a Footwall volume")) << caught.message;
}

// Files that carry our first line but break the rules behind it, as an attacker would make them.
TEST_F(VolumeReaderTest, LinksExternalStorageFiltersAndWrongTypesAreRefused) {
  const auto edited = [&](const std::function<void(hid_t)>& edit) {
    write();
    const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    ASSERT_GE(file, 0);
    edit(file);
    H5Fclose(file);
    // The length is part of the preamble: make it agree, so that the rule itself is what refuses.
    std::fstream raw(path_, std::ios::in | std::ios::out | std::ios::binary);
    std::string text(512, '\0');
    raw.read(text.data(), 512);
    const std::string size = std::to_string(std::filesystem::file_size(path_));
    const std::size_t at = text.find("\"bytes\":") + 8;
    text.replace(at, text.find(',', at) - at, size);
    text.resize(512);
    raw.seekp(0);
    raw.write(text.data(), 512);
    raw.close();
    const Caught caught = error_of([&] {
      const VolumeReader reader(path_);
      reader.live_mask();
    });
    EXPECT_EQ(caught.code, ErrorCode::kFormat) << caught.message;
  };
  const auto put = [](hid_t file, const char* name, hid_t type, std::vector<hsize_t> dims,
                      hid_t plan = H5P_DEFAULT) {
    H5Ldelete(file, name, H5P_DEFAULT);
    const hid_t space = H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr);
    const hid_t dataset = H5Dcreate2(file, name, type, space, H5P_DEFAULT, plan, H5P_DEFAULT);
    ASSERT_GE(dataset, 0);
    H5Dclose(dataset);
    H5Sclose(space);
  };
  edited([](hid_t f) {
    H5Ldelete(f, "/voxels", H5P_DEFAULT);
    H5Lcreate_external("/etc/passwd", "/voxels", f, "/voxels", H5P_DEFAULT, H5P_DEFAULT);
  });
  edited([](hid_t f) {
    H5Lmove(f, "/live", f, "/other", H5P_DEFAULT, H5P_DEFAULT);
    H5Lcreate_soft("/other", f, "/live", H5P_DEFAULT, H5P_DEFAULT);
  });
  edited([&](hid_t f) { put(f, "/voxels", H5T_IEEE_F64LE, {10, 12, 15}); });
  edited([&](hid_t f) { put(f, "/voxels", H5T_IEEE_F32LE, {10, 12, 15}); });  // not chunked
  edited([&](hid_t f) { put(f, "/checksums", H5T_STD_U64LE, {26}); });
  edited([&](hid_t f) { put(f, "/live", H5T_STD_U8LE, {10, 13}); });
  edited([&](hid_t f) {
    const hid_t plan = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_external(plan, "/etc/passwd", 0, 120);
    put(f, "/live", H5T_STD_U8LE, {10, 12}, plan);
    H5Pclose(plan);
  });
  edited([&](hid_t f) {
    const hid_t plan = H5Pcreate(H5P_DATASET_CREATE);
    const hsize_t chunk[3] = {4, 5, 6};
    H5Pset_chunk(plan, 3, chunk);
    H5Pset_deflate(plan, 1);
    put(f, "/voxels", H5T_IEEE_F32LE, {10, 12, 15}, plan);
    H5Pclose(plan);
  });
  edited([](hid_t f) { H5Adelete(f, "geometry"); });
}

// HDF5 itself serves one thread at a time: without turns this crashes or reads what is not there.
TEST_F(VolumeReaderTest, ReadersAndWritersOfSeveralThreadsTakeTurns) {
  write();
  const auto read_and_write = [&](int thread) {
    const std::filesystem::path own = folder_ / ("own" + std::to_string(thread) + ".h5");
    WriteOptions options = options_for({9, 8, 7});
    options.chunk = survey::Index{2, 3, 4};
    const survey::Box box{{1, 2, 3}, {9, 11, 14}};
    std::vector<float> values(static_cast<std::size_t>(box.count()));
    int wrong = 0;
    for (int n = 0; n < 40; ++n) {
      write_volume(own, options, source_of(wavy), JobContext());
      VolumeReader(own).verify(JobContext());
      const VolumeReader reader(path_);
      reader.read(box, values);
      wrong += values.front() != wavy(1, 2, 3) || values.back() != wavy(8, 10, 13) ? 1 : 0;
      wrong += reader.min_max(0).min.empty() || reader.live_mask().empty() ? 1 : 0;
      try {
        const VolumeReader none(folder_ / "none.h5");
        ++wrong;
      } catch (const Error& error) {
        wrong += error.code() == ErrorCode::kNotFound ? 0 : 1;
      }
    }
    return wrong;
  };
  std::vector<int> wrong(3, -1);
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < 3; ++t)
      threads.emplace_back([&, t] { wrong[static_cast<std::size_t>(t)] = read_and_write(t); });
  }
  EXPECT_EQ(wrong, (std::vector<int>{0, 0, 0}));
}

}  // namespace
}  // namespace footwall::volume
