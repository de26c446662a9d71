// Cancel, in any phase and on any hosts: all ranks are back in their loop, with the state of before.
#include "engine/service/wire.h"
#include "mpi/service/host_layouts.h"
#include "mpi/service/made_values.h"
#include "mpi/service/resident_case.h"

namespace footwall::service {
namespace {

using extract::Face;

constexpr survey::Index kDims{70, 40, 40};

class CancelledEngine : public ResidentCase {
 protected:
  CancelledEngine() {
    path = write_volume("large.h5", kDims, made_value);
    small = write_volume("small.h5", {9, 8, 7}, made_value);
  }
  std::filesystem::path path;
  std::filesystem::path small;
};

v1::Command put_many(std::uint64_t edit, std::int32_t count) {
  std::mt19937 random(6);
  std::vector<Face> faces;
  for (std::int32_t n = 0; n < count; ++n) faces.push_back(made_face(random, kDims, 1, n));
  v1::Command command;
  command.mutable_edit_model()->set_edit(edit);
  *command.mutable_edit_model()->add_edits()->mutable_put() = message_of(std::span<const Face>(faces));
  return command;
}

v1::Command extract_command(const std::string& volume) {
  v1::Command command;
  command.mutable_extract()->set_volume(volume);
  for (const char* each : {"mean", "contrast"})
    command.mutable_extract()->mutable_options()->add_compute(each);
  return command;
}

// Asks, and cancels when `when` is told: a phase, "answer", or "start" (at once).
template <typename Reply>
std::string cancelled_at(Client& client, const v1::Command& command, const std::string& when) {
  const auto call = std::make_shared<CollectingCall<Reply>>(command);
  if (when == "answer") call->on_reply = [&] { call->context().cancel(); };
  call->on_progress = [&](const Call::State& state) {
    if (state.phase == when) call->context().cancel();
  };
  client.queue.push(call);
  if (when == "start") client.queue.cancel(call->id());
  try {
    call->wait();
  } catch (const Error& error) {
    return std::string(name_of(error.code()));
  }
  return "done";
}

TEST_F(CancelledEngine, IsAsBeforeAndWorksOn) {
  for (const std::vector<int>& host_of : host_layouts(world.size())) {
    options.host_of = host_of;
    run([&](Client& client) {
      const std::string volume =
          client.ask<v1::OpenVolumeReply>(open_command(small)).back().opened().volume();
      client.ask<v1::EditModelReply>(put_many(1, 3000));
      const auto before = client.ask<v1::ExtractReply>(extract_command(volume));
      const std::uint64_t hash = client.hash();
      for (const char* when : {"start", "read"}) {
        EXPECT_EQ(cancelled_at<v1::OpenVolumeReply>(client, open_command(path), when), "cancelled") << when;
        EXPECT_EQ(client.hash(), hash) << when;
        EXPECT_EQ(client.resident.status().volumes.size(), 1U);
      }
      const std::string large = client.ask<v1::OpenVolumeReply>(open_command(path)).back().opened().volume();
      const std::uint64_t hash_with_large = client.hash();
      for (const char* when : {"start", "voxelize", "answer"}) {
        EXPECT_EQ(cancelled_at<v1::ExtractReply>(client, extract_command(large), when), "cancelled") << when;
        EXPECT_EQ(client.hash(), hash_with_large) << when;
      }
      // A step of a drag is taken back with its edits, whether it is cancelled early or late.
      for (const char* when : {"start", "voxelize", "answer"}) {
        v1::Command live;
        live.mutable_live()->set_volume(large);
        live.mutable_live()->mutable_options()->add_compute("contrast");
        *live.mutable_live()->add_batches() = put_many(2, 4000).edit_model();
        EXPECT_EQ(cancelled_at<v1::LiveReply>(client, live, when), "cancelled") << when;
        EXPECT_EQ(client.hash(), hash_with_large) << when;
      }
      v1::Command close;
      close.mutable_close_volume()->set_volume(large);
      client.ask<v1::CloseVolumeReply>(close);
      const auto after = client.ask<v1::ExtractReply>(extract_command(volume));
      EXPECT_EQ(after.back().done().checksum(), before.back().done().checksum());
      EXPECT_EQ(client.hash(), hash);
    });
  }
}

TEST_F(CancelledEngine, TellsFromOutsideWhileRanksCompute) {
  // From another thread at any moment, through the queue, as Cancel does.
  run([&](Client& client) {
    const std::string volume = client.ask<v1::OpenVolumeReply>(open_command(path)).back().opened().volume();
    client.ask<v1::EditModelReply>(put_many(1, 3000));
    const std::uint64_t hash = client.hash();
    std::mt19937 random(2);
    for (int n = 0; n < 15; ++n) {
      const auto call = std::make_shared<CollectingCall<v1::ExtractReply>>(extract_command(volume));
      client.queue.push(call);
      std::this_thread::sleep_for(std::chrono::microseconds(random() % 60000));  // any moment will do
      client.queue.cancel(call->id());
      try {
        call->wait();
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::kCancelled);
      }
      EXPECT_EQ(client.hash(), hash);
    }
    EXPECT_EQ(client.ask<v1::ExtractReply>(extract_command(volume)).back().done().faces(), 3000);
  });
}

}  // namespace
}  // namespace footwall::service
