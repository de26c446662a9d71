// Boxes, face voxels, isosurfaces, pictures and jobs as commands; what they answer is tested in
// ../service_jobs.
#include <map>

#include "engine/isosurface/extract.h"
#include "engine/service/task_files.h"
#include "engine/service/wire.h"
#include "engine/session/attribute.h"
#include "mpi/service/made_camera.h"
#include "mpi/service/made_values.h"
#include "mpi/service/resident_case.h"
#include "storage/base/partial_file.h"
#include "storage/volume/volume_reader.h"

namespace footwall::service {
namespace {

constexpr survey::Index kDims{23, 19, 14};

class JobCommands : public ResidentCase {
 protected:
  JobCommands() : path(write_volume("random.h5", kDims, made_value)) {}

  std::string open(Client& client) {
    return client.ask<v1::OpenVolumeReply>(open_command(path)).back().opened().volume();
  }
  static v1::Command box_command(const std::string& volume, const survey::Box& box) {
    v1::Command command;
    command.mutable_read_box()->set_volume(volume);
    *command.mutable_read_box()->mutable_box() = message_of(box);
    return command;
  }
  static v1::Command render_command(const std::string& volume, float value) {
    v1::Command command;
    v1::RenderRequest& request = *command.mutable_render();
    *request.mutable_camera() = camera_along_samples();
    request.set_width(64);
    request.set_height(48);
    v1::DrawnIsosurface& surface = *request.add_isosurfaces();
    surface.set_volume(volume);
    surface.set_value(value);
    surface.set_colour(0xff808080U);
    for (int n = 0; n < 9; ++n) surface.mutable_placement()->add_linear(n % 4 == 0 ? 1 : 0);
    for (int n = 0; n < 3; ++n) surface.mutable_placement()->add_shift(0);
    return command;
  }
  std::filesystem::path path;
};

TEST_F(JobCommands, AnswerAndLeaveTheStateAsItWas) {
  run([&](Client& client) {
    const std::string volume = open(client);
    const std::uint64_t before = client.hash();

    std::string values;
    const auto call =
        std::make_shared<CollectingCall<v1::ReadBoxReply>>(box_command(volume, {{0, 0, 0}, kDims}));
    client.queue.push_read(call);
    for (const v1::ReadBoxReply& each : call->wait()) values += each.values();
    ASSERT_EQ(values.size(), static_cast<std::size_t>(kDims[0] * kDims[1] * kDims[2]) * sizeof(float));

    v1::Command face;
    face.mutable_face_voxels()->set_volume(volume);
    for (const int each : {0, 0, 0, 20 * 256, 0, 12 * 256, 0, 15 * 256, 12 * 256})
      face.mutable_face_voxels()->add_corners(each);
    const v1::FaceVoxelsReply voxels = client.ask<v1::FaceVoxelsReply>(face).back();
    ASSERT_GT(voxels.values_size(), 0);
    for (int n = 0; n < voxels.values_size(); ++n) {
      const float wanted =
          made_value({voxels.places(3 * n), voxels.places(3 * n + 1), voxels.places(3 * n + 2)});
      EXPECT_TRUE(voxels.values(n) == wanted || (std::isnan(wanted) && std::isnan(voxels.values(n))));
    }

    v1::Command surface;
    surface.mutable_isosurface()->set_volume(volume);
    surface.mutable_isosurface()->set_value(100);
    const std::uint64_t triangles = client.ask<v1::IsosurfaceReply>(surface).back().done().triangles();
    EXPECT_GT(triangles, 100U);

    for (const bool visible : {false, true, true}) {
      v1::Command picture = render_command(volume, 100);
      if (visible) picture.mutable_render()->mutable_visible();
      const auto replies = client.ask<v1::RenderReply>(picture);
      EXPECT_TRUE(replies.back().has_done());
      EXPECT_TRUE(replies.front().has_tile());
    }
    EXPECT_EQ(client.hash(), before);
  });
}

TEST_F(JobCommands, OfAVolumeThatIsNotOpenAreRefused) {
  run([&](Client& client) {
    const std::string volume = open(client);
    const std::string other = "0123456789abcdef";
    v1::Command face;
    face.mutable_face_voxels()->set_volume(other);
    v1::Command surface;
    surface.mutable_isosurface()->set_volume(other);
    EXPECT_EQ(client.error_of<v1::FaceVoxelsReply>(face)->code(), ErrorCode::kNotFound);
    EXPECT_EQ(client.error_of<v1::IsosurfaceReply>(surface)->code(), ErrorCode::kNotFound);
    EXPECT_EQ(client.error_of<v1::RenderReply>(render_command(other, 1))->code(), ErrorCode::kNotFound);
    // A closed one takes its pictures along, and may be opened again.
    for (int n = 0; n < 2; ++n) {
      EXPECT_TRUE(client.ask<v1::RenderReply>(render_command(volume, 100)).back().has_done());
      v1::Command close;
      close.mutable_close_volume()->set_volume(volume);
      client.ask<v1::CloseVolumeReply>(close);
      EXPECT_EQ(client.error_of<v1::RenderReply>(render_command(volume, 100))->code(), ErrorCode::kNotFound);
      open(client);
    }
  });
}

TEST_F(JobCommands, AJobOfTheCommandLineFindsItsVolumeByChecksum) {
  run([&](Client& client) {
    const std::string volume = to_hex(volume::VolumeReader(path).info().checksum);
    for (const char* each : {"task/in", "task/out"}) std::filesystem::create_directories(folder / each);
    session::write_attribute_job({path, folder / "a.h5", folder / "result.json", {3, 3, 5}},
                                 folder / "A.json");
    v1::Command command;
    *command.mutable_task()->mutable_task() = pack_task("attribute", folder / "A.json").task;
    command.mutable_task()->set_folder((folder / "task").string());
    const auto replies = client.ask<v1::TaskOutput>(command);
    EXPECT_EQ(replies.back().file().name(), "result.json");
    std::string file;
    for (const v1::TaskOutput& each : replies) {
      if (each.file().name() == "volume.h5") file += each.file().bytes();
    }
    write_whole_file(folder / "came.h5", file);
    EXPECT_EQ(volume::VolumeReader(folder / "came.h5").info().role, volume::Role::kDiscontinuity);
    command.mutable_task()->mutable_task()->set_kind("shell");
    EXPECT_EQ(client.error_of<v1::TaskOutput>(command)->code(), ErrorCode::kUnsupported);
  });
}

}  // namespace
}  // namespace footwall::service
