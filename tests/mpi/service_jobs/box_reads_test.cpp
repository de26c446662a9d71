#include "engine/service/resident/jobs/box_reads.h"

#include "engine/service/wire.h"
#include "mpi/service_jobs/small_volume.h"

namespace footwall::service {
namespace {

class BoxReadsTest : public SmallVolume {
 protected:
  std::vector<float> read(const survey::Box& box, bool compress) {
    v1::ReadBoxRequest request;
    request.set_volume(checksum);
    *request.mutable_box() = message_of(box);
    request.set_compress(compress);
    std::vector<float> values;
    const auto take = [&](const google::protobuf::Message& message) {
      const std::string& bytes = dynamic_cast<const v1::ReadBoxReply&>(message).values();
      std::vector<float> piece(bytes.size() / sizeof(float));
      if (compress) {
        piece = inflated<float>(bytes, std::size_t{1} << 20);
      } else {
        std::memcpy(piece.data(), bytes.data(), bytes.size());
      }
      values.insert(values.end(), piece.begin(), piece.end());
    };
    reads.read(
        request,
        [&](const std::string&) {
          ++opened;
          return volume();
        },
        take);
    return values;
  }
  BoxReads reads;
  int opened = 0;
};

TEST_F(BoxReadsTest, GivesTheVolumesValuesAndOpensItOnce) {
  if (world.rank() != 0) return;
  const survey::Box all{{0, 0, 0}, session::kSmallDims};
  const survey::Box section{{7, 0, 0}, {8, session::kSmallDims[1], session::kSmallDims[2]}};
  const survey::Box one{{19, 13, 29}, {20, 14, 30}};
  for (const survey::Box& box : {all, section, one}) {
    for (const bool compress : {false, true}) {
      const std::vector<float> values = read(box, compress);
      ASSERT_EQ(values.size(), static_cast<std::size_t>(box.count()));
      std::size_t n = 0;
      for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
        for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
          for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k, ++n) {
            const float wanted = session::small_value({i, j, k});
            ASSERT_TRUE(values[n] == wanted || (std::isnan(values[n]) && std::isnan(wanted)));
          }
        }
      }
    }
  }
  EXPECT_EQ(opened, 1);
}

TEST_F(BoxReadsTest, RefusesWhatIsOutside) {
  if (world.rank() != 0) return;
  for (const survey::Box& box : {survey::Box{{0, 0, 0}, {21, 1, 1}}, survey::Box{{-1, 0, 0}, {1, 1, 1}},
                                 survey::Box{{3, 3, 3}, {3, 4, 4}}, survey::Box{{5, 5, 5}, {4, 6, 6}}}) {
    try {
      read(box, false);
      ADD_FAILURE();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kUsage);
    }
  }
  checksum = "0123456789abcdef";  // not what the file has
  EXPECT_THROW(read({{0, 0, 0}, {1, 1, 1}}, false), Error);
}

}  // namespace
}  // namespace footwall::service
