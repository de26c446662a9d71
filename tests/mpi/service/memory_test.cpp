// What does not fit into memory is refused before it begins, with the numbers; the engine goes on.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/service/resident/host_memory.h"
#include "engine/service/resident/memory_needs.h"
#include "engine/service/wire.h"
#include "mpi/service/host_layouts.h"
#include "mpi/service/made_camera.h"
#include "mpi/service/made_values.h"
#include "mpi/service/resident_case.h"

namespace footwall::service {
namespace {

constexpr std::int64_t kMiB = 1 << 20;
constexpr survey::Index kDims{23, 19, 14};

class Memory : public ResidentCase {
 protected:
  static std::string open(Client& client, const std::filesystem::path& path) {
    return client.ask<v1::OpenVolumeReply>(open_command(path)).back().opened().volume();
  }
  static v1::Command put_command(int count) {
    std::mt19937 random(1);
    std::vector<extract::Face> faces;
    for (int n = 0; n < count; ++n) faces.push_back(made_face(random, kDims, 1, n));
    v1::Command command;
    *command.mutable_edit_model()->add_edits()->mutable_put() =
        message_of(std::span<const extract::Face>(faces));
    return command;
  }
  static v1::Command surface_command(const std::string& volume, bool normals = true) {
    v1::Command command;
    command.mutable_isosurface()->set_volume(volume);
    command.mutable_isosurface()->set_value(100);
    command.mutable_isosurface()->set_normals(normals);
    return command;
  }
  static v1::Command picture_command(const std::string& volume, int size) {
    v1::Command command;
    v1::RenderRequest& request = *command.mutable_render();
    *request.mutable_camera() = camera_along_samples();
    request.set_width(size);
    request.set_height(size);
    v1::DrawnIsosurface& surface = *request.add_isosurfaces();
    surface.set_volume(volume);
    surface.set_value(100);
    for (int n = 0; n < 9; ++n) surface.mutable_placement()->add_linear(n % 4 == 0 ? 1 : 0);
    for (int n = 0; n < 3; ++n) surface.mutable_placement()->add_shift(0);
    return command;
  }
  template <typename Reply>
  static void expect_refused(Client& client, const v1::Command& command, const std::string& what) {
    const auto error = client.error_of<Reply>(command);
    ASSERT_TRUE(error) << what;
    EXPECT_EQ(error->code(), ErrorCode::kMemory) << error->what();
    EXPECT_TRUE(error->message().starts_with(what + " needs ")) << error->message();
    EXPECT_NE(error->message().find(" on this host, "), std::string::npos) << error->message();
    EXPECT_TRUE(error->message().ends_with(" are free")) << error->message();
    EXPECT_FALSE(error->hint().empty());
  }
};

TEST_F(Memory, FacesAndPicturesThatDoNotFitAreRefusedAndTheEngineGoesOn) {
  const auto path = write_volume("random.h5", kDims, made_value);
  options.memory_bytes = 4 * kMiB * world.size();
  run([&](Client& client) {
    const std::string volume = open(client, path);
    const std::uint64_t empty = client.hash();
    expect_refused<v1::EditModelReply>(client, put_command(30'000), "the edit");
    EXPECT_EQ(client.hash(), empty);
    client.ask<v1::EditModelReply>(put_command(3000));
    const std::uint64_t before = client.hash();

    v1::Command extract;
    extract.mutable_extract()->set_volume(volume);
    expect_refused<v1::ExtractReply>(client, extract, "the extraction");
    expect_refused<v1::RenderReply>(client, picture_command(volume, 8000), "the picture");
    EXPECT_EQ(client.hash(), before);

    v1::FaceNames& only = *extract.mutable_extract()->mutable_only();
    only.add_faults(1);
    only.add_owners(3);
    only.add_numbers(7);
    EXPECT_EQ(client.ask<v1::ExtractReply>(extract).back().done().faces(), 1);
    EXPECT_TRUE(client.ask<v1::RenderReply>(picture_command(volume, 64)).back().has_done());
  });
}

TEST_F(Memory, AnIsosurfaceThatDoesNotFitIsRefused) {
  const auto path = write_volume("larger.h5", {40, 40, 40}, made_value);
  options.memory_bytes = 3 * kMiB;
  run([&](Client& client) {
    const std::string volume = open(client, path);
    expect_refused<v1::IsosurfaceReply>(client, surface_command(volume), "the isosurface");
    // An isovalue that nothing crosses takes nothing.
    v1::Command none = surface_command(volume);
    none.mutable_isosurface()->set_value(1e9F);
    EXPECT_EQ(client.ask<v1::IsosurfaceReply>(none).back().done().triangles(), 0U);
  });
}

// By what the process has, which is more than the count of the engine alone.
TEST_F(Memory, FacesTakeNoMoreThanIsForeseen) {
  constexpr int kFaces = 30'000;
  const auto path = write_volume("random.h5", kDims, made_value);
  run([&](Client& client) {
    v1::Command extract;
    extract.mutable_extract()->set_volume(open(client, path));
    extract.mutable_extract()->mutable_options()->add_compute("variance");
    client.ask<v1::ExtractReply>(extract);
    const v1::Command put = put_command(kFaces);
    const std::int64_t before = client.resident.status().ranks[0].memory_bytes;
    client.ask<v1::EditModelReply>(put);
    client.hash();
    const std::int64_t edited = client.resident.status().ranks[0].memory_bytes;
    client.ask<v1::ExtractReply>(extract);
    client.hash();
    const std::int64_t extracted = client.resident.status().ranks[0].memory_bytes;
    fmt::print("{} faces: {} bytes each for the edit, {} for the extraction\n", kFaces,
               (edited - before) / kFaces, (extracted - edited) / kFaces);
    EXPECT_LT(edited - before, edit_bytes(put.edit_model(), 0));
    EXPECT_LT(extracted - edited, extraction_stays(kFaces) + extraction_passes(kFaces));
  });
}

// The bytes of all pieces, and what it took to make them.
std::pair<std::string, double> told(const std::vector<v1::IsosurfaceReply>& replies) {
  std::string bytes;
  for (const v1::IsosurfaceReply& each : replies) bytes += each.piece().SerializeAsString();
  const auto report = nlohmann::json::parse(replies.back().done().report_json());
  return {bytes, report.at("seconds").at("extract").get<double>()};
}

TEST_F(Memory, AnIsosurfaceThatIsAskedForAgainIsNotMadeAgain) {
  const auto path = write_volume("random.h5", kDims, made_value);
  run([&](Client& client) {
    const std::string volume = open(client, path);
    const auto first = told(client.ask<v1::IsosurfaceReply>(surface_command(volume)));
    EXPECT_GT(first.second, 0);
    const auto again = told(client.ask<v1::IsosurfaceReply>(surface_command(volume)));
    EXPECT_EQ(again.first, first.first);
    EXPECT_EQ(again.second, 0);
    // With other options it is another surface; what was closed is made anew.
    EXPECT_GT(told(client.ask<v1::IsosurfaceReply>(surface_command(volume, false))).second, 0);
    v1::Command close;
    close.mutable_close_volume()->set_volume(volume);
    client.ask<v1::CloseVolumeReply>(close);
    open(client, path);
    const auto anew = told(client.ask<v1::IsosurfaceReply>(surface_command(volume)));
    EXPECT_GT(anew.second, 0);
    EXPECT_EQ(anew.first, first.first);
  });
}

TEST(HostMemory, WhatIsKeptGoesFirstAndAllRanksAgree) {
  const comm::Communicator world(MPI_COMM_WORLD);
  for (const std::vector<int>& host_of : host_layouts(world.size())) {
    std::int64_t most = 0;  // ranks of a host
    for (const int host : host_of) most = std::max<std::int64_t>(most, std::ranges::count(host_of, host));
    HostMemory memory(world, host_of, 100 * kMiB * most);
    std::int64_t kept = 80 * kMiB;
    int drops = 0;
    memory.held = [&]() -> HostMemory::Held { return {10 * kMiB, kept}; };
    memory.drop = [&] {
      kept = 0;
      ++drops;
    };
    memory.require_free(kMiB, "a little", "");
    EXPECT_EQ(drops, 0);
    memory.require_free(80 * kMiB, "much", "");
    EXPECT_EQ(drops, 1);
    // One rank alone needs too much: the error is everybody's.
    try {
      memory.require_free(world.rank() == world.size() - 1 ? 200 * kMiB * most : 0, "it", "wait");
      FAIL() << "there is not so much";
    } catch (const comm::AgreedError& error) {
      EXPECT_EQ(error.code(), ErrorCode::kMemory);
      EXPECT_EQ(error.hint(), "wait");
    }
    EXPECT_EQ(drops, 2);
  }
}

}  // namespace
}  // namespace footwall::service
