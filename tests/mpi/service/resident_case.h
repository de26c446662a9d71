// A resident engine on all ranks of a test, driven by a function on a thread of rank 0, as the server would.
#pragma once
#include <gtest/gtest.h>

#include <condition_variable>
#include <functional>
#include <thread>

#include "engine/comm/shared_text.h"
#include "engine/service/ranks.pb.h"
#include "engine/service/resident/resident.h"
#include "scratch_folder.h"
#include "storage/base/hash.h"
#include "storage/volume/volume_writer.h"

namespace footwall::service {

// Keeps what was answered. Reply: the method's reply type.
template <typename Reply>
class CollectingCall : public Call {
 public:
  explicit CollectingCall(v1::Command command) : Call("Test"), command_(std::move(command)) {}

  v1::Command take_command() override { return command_; }
  void send(const google::protobuf::Message& reply) override {
    if (on_reply) on_reply();
    context().check();
    Reply copy;
    copy.CopyFrom(reply);
    const std::scoped_lock lock(mutex_);
    replies_.push_back(std::move(copy));
  }
  void finish(const std::optional<Error>& failure) noexcept override {
    const std::scoped_lock lock(mutex_);
    failure_ = failure;
    finished_ = true;
    changed_.notify_all();
  }
  // The answers, or throws the call's error.
  std::vector<Reply> wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return finished_; });
    if (failure_) throw Error(*failure_);
    return std::move(replies_);
  }

  bool is_over() {
    const std::scoped_lock lock(mutex_);
    return finished_;
  }

  std::function<void()> on_reply;  // before it is taken
  std::function<void(const State&)> on_progress;

 protected:
  void progressed(const State& state) override {
    if (on_progress) on_progress(state);
  }

 private:
  v1::Command command_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Reply> replies_;
  std::optional<Error> failure_;
  bool finished_ = false;
};

// What a client sees.
class Client {
 public:
  explicit Client(CallQueue& its_queue, const Resident& its_resident)
      : queue(its_queue), resident(its_resident) {}

  template <typename Reply>
  std::vector<Reply> ask(const v1::Command& command) {
    const auto call = std::make_shared<CollectingCall<Reply>>(command);
    queue.push(call);
    return call->wait();
  }
  // The kind of error; none where it works.
  template <typename Reply>
  std::optional<Error> error_of(const v1::Command& command) {
    try {
      ask<Reply>(command);
    } catch (const Error& error) {
      return error;
    }
    return std::nullopt;
  }
  // As of the end of the last command: an answer may come before it.
  std::uint64_t hash() {
    v1::Command command;
    command.mutable_read_model()->add_faults(std::numeric_limits<std::int64_t>::max());
    ask<v1::ReadModelReply>(command);
    return resident.status().state_hash;
  }

  CallQueue& queue;
  const Resident& resident;
};

inline v1::Command open_command(const std::filesystem::path& path) {
  v1::Command command;
  command.mutable_open_volume()->mutable_volume()->set_path(path.string());
  return command;
}

class ResidentCase : public testing::Test {
 protected:
  ResidentCase() : world(MPI_COMM_WORLD) {
    if (world.rank() == 0) made_.emplace();
    folder = comm::shared_text(world, made_ ? made_->path().string() : "");
    options.folder = folder;
    options.volumes = folder;
  }

  // Runs the engine until `as_client` has returned on its thread, which is rank 0's.
  void run(const std::function<void(Client&)>& as_client) {
    Resident resident(world, options);
    if (world.rank() != 0) {
      resident.serve(nullptr);
      return;
    }
    CallQueue queue;
    std::thread thread([&] {
      try {
        Client client(queue, resident);
        as_client(client);
      } catch (const std::exception& error) {
        ADD_FAILURE() << error.what();
      }
      queue.close(Error(ErrorCode::kEngine, "the test is over"));
    });
    resident.serve(&queue);
    thread.join();
  }

  // A volume in the folder, made by rank 0. All ranks call it.
  template <typename Value>
  std::filesystem::path write_volume(const std::string& name, const survey::Index& dims, Value&& value,
                                     const survey::Index& origin = {0, 0, 0}) {
    world.collectively([&] {
      if (world.rank() != 0) return;
      volume::WriteOptions how;
      how.geometry.inlines = {1, 1, dims[0]};
      how.geometry.crosslines = {1, 1, dims[1]};
      how.geometry.samples = dims[2];
      how.origin = origin;
      how.chunk = survey::Index{8, 8, 8};
      volume::write_volume(folder / name, how,
                           [&](const survey::Box& box, std::span<float> values, std::span<std::uint8_t>) {
                             std::size_t n = 0;
                             for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
                               for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
                                 for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k)
                                   values[n++] = value(survey::Index{i, j, k});
                               }
                             }
                           },
                           {});
    });
    return folder / name;
  }

  comm::Communicator world;
  std::filesystem::path folder;
  ResidentOptions options;

 private:
  std::optional<ScratchFolder> made_;
};

}  // namespace footwall::service
