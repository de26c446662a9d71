// How fast a resident engine answers, without RPC (with it: footwall bench service): from a call's push to
// its end. Prints one table.
//   mpiexec --oversubscribe --bind-to none -n 2 build/release/bin/bench_service [MOVES [MOVES FOR MEMORY]]
#include <fmt/format.h>
#include <mpi.h>
#include <time.h>

#include <algorithm>
#include <cstdio>
#include <random>
#include <thread>

#include "bench/service/bench_calls.h"
#include "engine/comm/environment.h"
#include "engine/comm/shared_text.h"
#include "engine/service/resident/doorbell.h"
#include "engine/service/resident/hosts.h"
#include "engine/service/resident/resident.h"
#include "engine/tasks/process_use.h"
#include "engine/tasks/workload/grow.h"
#include "engine/tasks/workload/values.h"
#include "scratch_folder.h"
#include "storage/volume/volume_writer.h"

namespace footwall::service {
namespace {

// Benchmark 2 of docs/workloads.md.
constexpr survey::Index kDims{200, 200, 100};
constexpr double kArea = 1000;
constexpr double kDistance = 10;
constexpr std::int64_t kFaces = 10000;
constexpr int kMeshes = 16;

void print(const std::string& what, const std::string& result) {
  std::printf("%-44s %s\n", what.c_str(), result.c_str());
  std::fflush(stdout);
}

std::vector<int> processes_of(const std::vector<RankFacts>& ranks) {
  std::vector<int> processes;
  for (const RankFacts& rank : ranks) processes.push_back(rank.process);
  return processes;
}

double most_memory(const std::vector<RankFacts>& ranks) {
  const std::vector<std::int64_t> bytes = tasks::resident_bytes(processes_of(ranks));
  return static_cast<double>(*std::max_element(bytes.begin(), bytes.end()));
}

double now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// From the ring to the last rank's return from wait(), all asleep before. Collective.
void bench_ring(const comm::Communicator& world, const std::filesystem::path& folder, const std::string& what,
                const std::vector<int>& host_of) {
  Doorbell doorbell(world, folder, host_of);
  std::vector<double> seconds;
  for (int n = 0; n < 200; ++n) {
    double rung = 0;
    double woken = 0;
    if (world.rank() == 0) {
      std::this_thread::sleep_for(std::chrono::milliseconds(15));
      rung = now();
      doorbell.ring();
    } else {
      doorbell.wait();
      woken = now();
    }
    const double last = world.maximum(woken);
    if (world.rank() == 0 && world.size() > 1) seconds.push_back(last - rung);
  }
  if (world.rank() == 0) print(what, spread(seconds));
}

struct Model {
  tasks::Grower grower{kDims, kArea, kDistance, 1};
  mesh::MeshSet meshes;
  std::mt19937_64 random{7};

  mesh::MoveVertex move() {
    const auto id = static_cast<mesh::MeshId>(random() % kMeshes);
    const mesh::Mesh& mesh = meshes.mesh(id);
    const auto vertex =
        static_cast<mesh::VertexId>(random() % static_cast<std::uint64_t>(mesh.vertex_limit()));
    const mesh::MoveVertex move{id, vertex, grower.moved(mesh.position(vertex))};
    meshes.apply(move);
    return move;
  }
};

void add(const mesh::Operation& operation, v1::EditBatch& batch) {
  const auto bytes = mesh::encode(std::span(&operation, 1));
  batch.add_edits()->set_mesh(bytes.data(), bytes.size());
}

void choose(v1::ExtractOptions& options) {
  for (const char* each : {"count", "mean", "variance", "contrast"}) options.add_compute(each);
}

void bench_idle(const std::string& what, const Resident& resident) {
  const auto ranks = resident.status().ranks;
  std::this_thread::sleep_for(std::chrono::seconds(1));
  const std::vector<double> before = tasks::processor_seconds(processes_of(ranks));
  const double begun = now();
  std::this_thread::sleep_for(std::chrono::seconds(10));
  const std::vector<double> after = tasks::processor_seconds(processes_of(ranks));
  const double seconds = now() - begun;
  std::string shares;
  for (std::size_t n = 0; n < before.size(); ++n)
    shares += fmt::format("{:.3f} % ", 100 * (after[n] - before[n]) / seconds);
  print(what, shares);
}

// Collective.
void serve(Resident& resident, const std::function<void(CallQueue&)>& as_client, bool is_first) {
  if (!is_first) {
    resident.serve(nullptr);
    return;
  }
  CallQueue queue;
  std::thread thread([&] {
    try {
      as_client(queue);
    } catch (const std::exception& error) {
      std::printf("failed: %s\n", error.what());
    }
    queue.close(Error(ErrorCode::kEngine, "the benchmark is over"));
  });
  resident.serve(&queue);
  thread.join();
}

void write_hashed(const std::filesystem::path& path, const survey::Index& dims) {
  volume::WriteOptions how;
  how.geometry.inlines = {1, 1, dims[0]};
  how.geometry.crosslines = {1, 1, dims[1]};
  how.geometry.samples = dims[2];
  volume::write_volume(path, how,
                       [&](const survey::Box& box, std::span<float> values, std::span<std::uint8_t>) {
                         tasks::fill_hashed(dims, 1, box, values);
                       },
                       {});
}

class Bench {
 public:
  Bench(CallQueue& queue, const Resident& resident) : queue_(queue), resident_(resident) {}

  void open(const std::filesystem::path& path) {
    v1::Command command;
    command.mutable_open_volume()->mutable_volume()->set_path(path.string());
    const double seconds = timed(queue_, command, [&](const google::protobuf::Message& reply) {
      v1::OpenVolumeReply opened;
      opened.CopyFrom(reply);
      if (opened.has_opened()) volume_ = opened.opened().volume();
    });
    print("open the volume", spread({seconds}));
  }

  void make_model() {
    std::vector<mesh::Operation> operations;
    for (int n = 0; n < kMeshes; ++n) model_.grower.grow(kFaces / kMeshes, model_.meshes, operations);
    v1::Command command;
    for (const mesh::Operation& each : operations) add(each, *command.mutable_edit_model());
    print("the model as one batch", spread({timed(queue_, command)}));
    print("extract all faces", spread({timed(queue_, extract_all())}));
  }

  double move(int vertices) {
    v1::Command command;
    v1::LiveStep& step = *command.mutable_live();
    step.set_volume(volume_);
    choose(*step.mutable_options());
    v1::EditBatch& batch = *step.add_batches();
    for (int n = 0; n < vertices; ++n) add(model_.move(), batch);
    return timed(queue_, command, [&](const google::protobuf::Message& reply) {
      v1::LiveReply live;
      live.CopyFrom(reply);
      dirty_ += live.numbers().count_size();
    });
  }

  void moves(int vertices, int count) {
    const auto ranks = resident_.status().ranks;
    const std::vector<double> before = tasks::processor_seconds(processes_of(ranks));
    std::vector<double> seconds;
    dirty_ = 0;
    for (int n = 0; n < count; ++n) seconds.push_back(move(vertices));
    const std::vector<double> after = tasks::processor_seconds(processes_of(ranks));
    print(fmt::format("vertices moved: {} ({} faces)", vertices, dirty_ / count), spread(seconds));
    // Of all threads, waiting for the other ranks included.
    std::string each;
    for (std::size_t n = 0; n < before.size(); ++n)
      each += fmt::format("{:.3f} ms ", 1e3 * (after[n] - before[n]) / count);
    print("  processor time of each rank", each);
  }

  void memory(int count) {
    const double before = most_memory(resident_.status().ranks);
    for (int n = 0; n < count; ++n) move(1);
    const double after = most_memory(resident_.status().ranks);
    print(fmt::format("memory over {} moves", count),
          fmt::format("{:.1f} MiB before, {:.1f} MiB after", before / (1 << 20), after / (1 << 20)));
  }

  void cancels(const std::filesystem::path& large) {
    bench_cancel("cancel of an extraction", extract_all(), {});
    v1::Command open_it;
    open_it.mutable_open_volume()->mutable_volume()->set_path(large.string());
    bench_cancel("cancel of opening 256 MiB", open_it, [&](const google::protobuf::Message& reply) {
      v1::OpenVolumeReply opened;
      opened.CopyFrom(reply);
      large_ = opened.opened().volume();
    });
  }

  // From cancel() to the call's end, at any moment of it.
  void bench_cancel(const std::string& what, const v1::Command& command,
                    const std::function<void(const google::protobuf::Message&)>& on_reply) {
    const double whole = timed(queue_, command, on_reply);
    std::mt19937 random(3);
    std::vector<double> seconds;
    for (int n = 0; n < 40; ++n) {
      if (!large_.empty()) {
        v1::Command close;
        close.mutable_close_volume()->set_volume(large_);
        timed(queue_, close);
        large_.clear();
      }
      const auto call = std::make_shared<TimedCall>(command);
      call->on_reply = on_reply;
      queue_.push(call);
      std::this_thread::sleep_for(
          std::chrono::duration<double>(whole * static_cast<double>(random() % 1000) * 1e-3));
      const double begun = now();
      queue_.cancel(call->id());
      if (call->wait_until_over()) seconds.push_back(now() - begun);
    }
    print(fmt::format("{} in {:.0f} ms", what, whole * 1e3), spread(seconds));
  }

 private:
  v1::Command extract_all() const {
    v1::Command command;
    command.mutable_extract()->set_volume(volume_);
    choose(*command.mutable_extract()->mutable_options());
    return command;
  }

  CallQueue& queue_;
  const Resident& resident_;
  Model model_;
  std::string volume_;
  std::string large_;  // open, of the benchmark of cancels
  std::int64_t dirty_ = 0;
};

int number(int argc, char** argv, int place, int otherwise) {
  return argc > place ? std::max(1, std::atoi(argv[place])) : otherwise;
}

void run(comm::Communicator& world, int argc, char** argv) {
  std::optional<ScratchFolder> scratch;
  if (world.rank() == 0) scratch.emplace();
  const std::filesystem::path folder = comm::shared_text(world, scratch ? scratch->path().string() : "");
  if (world.rank() == 0) std::printf("%d ranks of 1 thread, benchmark 2's model\n", world.size());
  bench_ring(world, folder, "ring to the last rank", host_of_ranks(world));
  std::vector<int> apart(static_cast<std::size_t>(world.size()));
  for (int rank = 0; rank < world.size(); ++rank) apart[static_cast<std::size_t>(rank)] = rank;
  bench_ring(world, folder, "the same, each rank a host of its own", apart);

  ResidentOptions options;
  options.folder = folder;
  const bool is_first = world.rank() == 0;
  {
    options.host_of = apart;
    Resident resident(world, options);
    serve(
        resident, [&](CallQueue&) { bench_idle("of a core, idle, each a host of its own", resident); },
        is_first);
  }
  options.host_of.clear();
  if (is_first) {
    write_hashed(folder / "hashed.h5", kDims);
    write_hashed(folder / "large.h5", {512, 512, 256});
  }
  Resident resident(world, options);
  serve(
      resident,
      [&](CallQueue& queue) {
        Bench bench(queue, resident);
        bench.open(folder / "hashed.h5");
        bench.make_model();
        bench.moves(1, number(argc, argv, 1, 10000));
        bench.moves(370, 100);
        bench_idle("of a core, idle, each rank", resident);
        bench.cancels(folder / "large.h5");
        bench.memory(number(argc, argv, 2, 100000));
      },
      is_first);
}

}  // namespace
}  // namespace footwall::service

int main(int argc, char** argv) {
  const footwall::comm::Environment environment(argc, argv);
  try {
    footwall::comm::Communicator world(MPI_COMM_WORLD);
    footwall::service::run(world, argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
}
