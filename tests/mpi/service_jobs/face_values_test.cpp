#include "engine/service/resident/jobs/face_values.h"

#include "engine/extract/face_rows.h"
#include "engine/extract/lot.h"
#include "engine/voxelize/registry.h"
#include "mpi/service_jobs/small_volume.h"
#include "storage/volume/volume_reader_parallel.h"

namespace footwall::service {
namespace {

class FaceValuesTest : public SmallVolume {
 protected:
  FaceValuesTest()
      : reader(world.get(), volume()),
        survey(world, reader.info().dims,
               [&](const survey::Box& box, std::span<float> out) { reader.read_collective(box, out); }) {}

  void ask(const v1::FaceVoxelsRequest& request) {
    places.clear();
    values.clear();
    coded.clear();
    send_face_values(world, survey, reader.info(), request, 1,
                     [&](const google::protobuf::Message& message) {
                       const auto& reply = dynamic_cast<const v1::FaceVoxelsReply&>(message);
                       for (int n = 0; n < reply.places_size(); n += 3)
                         places.push_back({reply.places(n), reply.places(n + 1), reply.places(n + 2)});
                       values.insert(values.end(), reply.values().begin(), reply.values().end());
                       coded += reply.coded();
                     },
                     {});
  }
  static v1::FaceVoxelsRequest request_of(const extract::Face& face) {
    v1::FaceVoxelsRequest request;
    for (const survey::LatticePoint& p : face.triangle) {
      for (const std::int32_t each : {p.i, p.j, p.k}) request.add_corners(each);
    }
    return request;
  }

  volume::ParallelVolumeReader reader;
  extract::LoadedSurvey survey;
  std::vector<survey::Index> places;
  std::vector<float> values;
  std::string coded;
};

TEST_F(FaceValuesTest, AreThoseOfTheVoxelizersVoxels) {
  for (const extract::Face& face : session::small_faces(4, 12)) {
    for (const char* voxelizer : {"", "rotated", "kaufman"}) {
      v1::FaceVoxelsRequest request = request_of(face);
      request.set_voxelizer(voxelizer);
      ask(request);
      if (world.rank() != 0) {
        EXPECT_TRUE(places.empty());
        continue;
      }
      extract::FaceRows rows;
      voxelize::make_voxelizer(*voxelizer == 0 ? "exact" : voxelizer)
          ->rows(face.triangle, {{0, 0, 0}, session::kSmallDims}, rows);
      ASSERT_EQ(places.size(), static_cast<std::size_t>(rows.voxels()));
      ASSERT_EQ(values.size(), places.size());
      std::size_t n = 0;
      rows.for_each([&](const survey::Index& voxel) {
        EXPECT_EQ(places[n], voxel);
        const float wanted = session::small_value(voxel);
        EXPECT_TRUE(values[n] == wanted || (std::isnan(values[n]) && std::isnan(wanted)));
        ++n;
      });
    }
  }
}

TEST_F(FaceValuesTest, CodedOnesComeBack) {
  const extract::Face face{
      1, 0, 0, {{{256, 256, 256}, {17 * 256, 256, 20 * 256}, {256, 12 * 256, 28 * 256}}}};
  v1::FaceVoxelsRequest request = request_of(face);
  ask(request);
  const std::vector<float> exact = values;
  request.set_code("lot");
  request.set_snr(30);
  ask(request);
  if (world.rank() != 0) return;
  EXPECT_TRUE(values.empty());
  extract::FaceRows rows;
  voxelize::make_voxelizer()->rows(face.triangle, {{0, 0, 0}, session::kSmallDims}, rows);
  std::vector<float> decoded;
  extract::VoxelReader("lot").read(std::as_bytes(std::span(coded)), rows, decoded);
  ASSERT_EQ(decoded.size(), exact.size());
  double signal = 0;
  double noise = 0;
  for (std::size_t n = 0; n < exact.size(); ++n) {
    ASSERT_EQ(std::isnan(exact[n]), std::isnan(decoded[n]));
    if (std::isnan(exact[n])) continue;
    signal += static_cast<double>(exact[n]) * exact[n];
    noise += std::pow(static_cast<double>(exact[n]) - decoded[n], 2);
  }
  EXPECT_GT(10 * std::log10(signal / noise), 28);
}

TEST_F(FaceValuesTest, WrongOnesAreRefusedAndTheNextIsAnswered) {
  const extract::Face face = session::small_faces(4, 1).front();
  v1::FaceVoxelsRequest request = request_of(face);
  request.set_code("morse");
  EXPECT_EQ(code_of([&] { ask(request); }), ErrorCode::kUsage);
  request.set_code("lot");
  EXPECT_EQ(code_of([&] { ask(request); }), ErrorCode::kUsage);  // without a ratio
  request.set_code("");
  request.add_corners(7);
  EXPECT_EQ(code_of([&] { ask(request); }), ErrorCode::kInvalid);
  // As far away as numbers go: outside, and empty.
  v1::FaceVoxelsRequest far;
  for (int n = 0; n < 9; ++n) far.add_corners(n % 2 == 0 ? 2147483647 : -2147483647 - 1);
  ask(far);
  ask(request_of(face));
  EXPECT_EQ(places.empty(), world.rank() != 0);
}

}  // namespace
}  // namespace footwall::service
