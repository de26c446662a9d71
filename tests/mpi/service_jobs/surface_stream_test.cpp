#include "engine/service/resident/jobs/surface_stream.h"

#include "engine/isosurface/extract.h"
#include "mpi/service_jobs/small_volume.h"

namespace footwall::service {
namespace {

class SurfaceStreamTest : public SmallVolume {
 protected:
  SurfaceStreamTest() : samples(world, volume()) {}

  void ask(float value, bool normals, const JobContext& job = {}) {
    v1::IsosurfaceRequest request;
    request.set_value(value);
    request.set_normals(normals);
    send_isosurface(
        world, samples, request, 1,
        [&](const google::protobuf::Message& message) {
          const auto& reply = dynamic_cast<const v1::IsosurfaceReply&>(message);
          const v1::SurfacePiece& piece = reply.piece();
          all.mutable_positions()->MergeFrom(piece.positions());
          all.mutable_normals()->MergeFrom(piece.normals());
          for (const std::uint32_t vertex : piece.triangles())
            EXPECT_LT(vertex, static_cast<std::uint32_t>(all.positions_size() / 3));
          all.mutable_triangles()->MergeFrom(piece.triangles());
          if (reply.has_done()) done = reply.done();
          ++messages;
          if (messages == client_goes_after) throw Error(ErrorCode::kCancelled, "the client has gone");
        },
        job);
  }

  isosurface::StoredSamples samples;
  v1::SurfacePiece all;
  v1::IsosurfaceDone done;
  int messages = 0;
  int client_goes_after = 0;
};

TEST_F(SurfaceStreamTest, IsTheSurfaceOfOneRank) {
  std::vector<float> values(static_cast<std::size_t>(survey::Box{{0, 0, 0}, session::kSmallDims}.count()));
  volume::VolumeReader(volume()).read({{0, 0, 0}, session::kSmallDims}, values);
  isosurface::Surface whole;
  isosurface::extract({values, session::kSmallDims, {0, 0, 0}, session::kSmallDims}, 100, {}, whole);
  for (const bool normals : {true, false}) {
    all.Clear();
    ask(100, normals);
    if (world.rank() != 0) {
      EXPECT_EQ(messages, 0);
      continue;
    }
    const auto same = [](const auto& sent, const auto& points) {
      return sent.size() == static_cast<int>(3 * points.size()) &&
             std::memcmp(sent.data(), points.data(), static_cast<std::size_t>(sent.size()) * 4) == 0;
    };
    EXPECT_GT(whole.triangles.size(), 1000U);
    EXPECT_TRUE(same(all.positions(), whole.positions));
    EXPECT_TRUE(same(all.triangles(), whole.triangles));
    EXPECT_TRUE(normals ? same(all.normals(), whole.normals) : all.normals_size() == 0);
    EXPECT_EQ(done.triangles(), whole.triangles.size());
    EXPECT_EQ(done.vertices(), whole.positions.size());
  }
}

TEST_F(SurfaceStreamTest, AnEmptyOneEndsToo) {
  ask(1e30F, true);
  EXPECT_EQ(messages, world.rank() == 0 ? 1 : 0);
  EXPECT_EQ(done.triangles(), 0U);
}

TEST_F(SurfaceStreamTest, FailuresAreThoseOfAllRanksAndTheNextWorks) {
  EXPECT_EQ(code_of([&] { ask(std::numeric_limits<float>::quiet_NaN(), true); }), ErrorCode::kUsage);
  client_goes_after = 2;
  EXPECT_EQ(code_of([&] { ask(100, true); }), ErrorCode::kCancelled);
  const JobContext cancelled;
  if (world.rank() == world.size() - 1) cancelled.cancel();
  EXPECT_EQ(code_of([&] { ask(100, true, cancelled); }), ErrorCode::kCancelled);
  ask(100, true);
  EXPECT_EQ(done.triangles() > 0, world.rank() == 0);
}

}  // namespace
}  // namespace footwall::service
