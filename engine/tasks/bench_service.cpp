#include "engine/tasks/bench_service.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "engine/service/client/local_engine.h"
#include "engine/session/private_folder.h"
#include "engine/tasks/detail/bench_service_check.h"
#include "engine/tasks/detail/bench_service_inputs.h"
#include "engine/tasks/detail/bench_service_pictures.h"
#include "engine/tasks/detail/bench_service_spread.h"
#include "engine/tasks/process_use.h"
#include "engine/tasks/serve.h"

namespace footwall::tasks {
namespace {

using Clock = std::chrono::steady_clock;
using service::EngineClient;

constexpr std::int64_t kWarmUp = 200;  // moves that do not count
constexpr double kMiB = 1 << 20;

double seconds_since(Clock::time_point begun) {
  return std::chrono::duration<double>(Clock::now() - begun).count();
}

// Looks at cancel meanwhile.
void sleep_for(double seconds, const JobContext& job) {
  const auto begun = Clock::now();
  constexpr std::chrono::milliseconds kLook(50);
  while (seconds_since(begun) < seconds) {
    job.check();
    std::this_thread::sleep_for(std::min<std::chrono::duration<double>>(
        kLook, std::chrono::duration<double>(seconds - seconds_since(begun))));
  }
}

std::vector<int> ranks_of(EngineClient& client) {
  std::vector<int> processes;
  const v1::StatusReply status = client.status();
  for (const auto& rank : status.each_rank()) processes.push_back(rank.process());
  return processes;
}

// "0.31, 0.30"
template <typename Value>
std::string list(const std::vector<Value>& values, const char* format, double scale) {
  std::string text;
  for (const Value& each : values)
    text += (text.empty() ? "" : ", ") + fmt::format(fmt::runtime(format), static_cast<double>(each) * scale);
  return text;
}

std::string open(EngineClient& client, const std::filesystem::path& path, const JobContext& job) {
  v1::VolumeName name;
  name.set_path(path.string());
  return client.open_volume(name, job).volume();
}

// Processor time that the ranks, and this process, used between two looks at it.
class Processors {
 public:
  explicit Processors(std::vector<int> ranks) : processes_(std::move(ranks)) {
    processes_.push_back(getpid());
    before_ = processor_seconds(processes_);
  }
  // In milliseconds for each of `times`: "processor time 0.41, 0.40 ms, client 0.1 ms".
  std::string in_words(std::int64_t times) const {
    std::vector<double> used = processor_seconds(processes_);
    for (std::size_t n = 0; n < used.size(); ++n) used[n] -= before_[n];
    const double client = used.back();
    used.pop_back();
    const double scale = 1e3 / static_cast<double>(times);
    return fmt::format("processor time of each rank {} ms, of the client {:.2f} ms",
                       list(used, "{:.2f}", scale), client * scale);
  }

 private:
  std::vector<int> processes_;
  std::vector<double> before_;
};

ServiceFigure figure_of_moves(const std::string& name, const std::string& what, double goal, bool median,
                              const std::vector<LiveMoves::Answer>& answers, const std::string& processors) {
  std::vector<double> seconds;
  std::vector<double> outside;
  double faces = 0;
  for (const LiveMoves::Answer& each : answers) {
    seconds.push_back(each.seconds);
    outside.push_back(each.seconds - each.engine_seconds);
    faces += static_cast<double>(each.faces);
  }
  const Spread spread = spread_of(seconds);
  const double chosen = median ? spread.median : spread.p99;
  return {
      name,
      what,
      1e3 * chosen,
      "ms",
      goal,
      fmt::format("median {:.3f}, p99 {:.3f}, most {:.3f} ms of {} times, {:.1f} faces; of it outside of the "
                  "engine {:.3f} ms; {}",
                  1e3 * spread.median, 1e3 * spread.p99, 1e3 * spread.most, spread.times,
                  faces / static_cast<double>(answers.size()), 1e3 * spread_of(outside).median, processors)};
}

class Bench {
 public:
  Bench(const ServiceBench& bench, const JobContext& job)
      : bench_(bench), job_(job), folder_(session::temporary_home()) {
    if (bench_.launch.ranks == 0) bench_.launch.ranks = 2;
  }

  std::vector<ServiceFigure> run() {
    measure_moves();
    measure_pictures();
    measure_start();
    return figures_;
  }

 private:
  void at(double fraction, const char* phase) const { job_.report(fraction, phase); }

  void measure_moves() {
    at(0, "make the model");
    const std::filesystem::path volume = folder_.path() / "hashed.h5";
    write_hashed_volume(volume, kBenchDims, job_.part(0, 0.02));
    service::LocalEngine engine(bench_.launch, {});
    const std::shared_ptr<EngineClient> held = engine.client(job_);
    EngineClient& client = *held;
    const JobContext making = job_.part(0.02, 0.05);
    LiveMoves moves(client, open(client, volume, making.part(0, 0.5)), bench_.faces, making.part(0.5, 1));
    for (std::int64_t n = 0; n < kWarmUp; ++n) moves.move_one();
    moves.move_until(bench_.many_faces);
    check_numbers(moves, volume, bench_.launch, job_.part(0.05, 0.08));
    ring(client);
    idle(client);
    time_moves(client, moves);
    time_batches(client, moves);
    memory(client, moves);
    moves.finish();
    check_numbers(moves, volume, bench_.launch, job_.part(0.75, 0.8));
  }

  void time_moves(EngineClient& client, LiveMoves& moves) {
    const Processors processors(ranks_of(client));
    std::vector<LiveMoves::Answer> answers;
    for (std::int64_t n = 0; n < bench_.moves; ++n) {
      if (n % 100 == 0)
        job_.report(0.1 + 0.2 * static_cast<double>(n) / static_cast<double>(bench_.moves), "move",
                    fmt::format("{} of {} vertices", n, bench_.moves));
      answers.push_back(moves.move_one());
    }
    figures_.push_back(figure_of_moves("move_p99", "1 vertex moved, 99th percentile", 5, false, answers,
                                       processors.in_words(bench_.moves)));
  }

  void time_batches(EngineClient& client, LiveMoves& moves) {
    const Processors processors(ranks_of(client));
    std::vector<LiveMoves::Answer> answers;
    for (int n = 0; n < bench_.batches; ++n) {
      at(0.3, "move many");
      answers.push_back(moves.move_until(bench_.many_faces));
    }
    figures_.push_back(figure_of_moves("batch_median",
                                       fmt::format("{} faces touched at once, median", bench_.many_faces), 30,
                                       true, answers, processors.in_words(bench_.batches)));
  }

  // Ranks, their launcher, and this process.
  void memory(EngineClient& client, LiveMoves& moves) {
    std::vector<int> processes = ranks_of(client);
    processes.push_back(parent_of(processes.front()));
    processes.push_back(getpid());
    const std::vector<std::int64_t> before = resident_bytes(processes);
    for (std::int64_t n = bench_.moves; n < bench_.memory_moves; ++n) {
      if (n % 100 == 0)
        job_.report(0.35 + 0.4 * static_cast<double>(n) / static_cast<double>(bench_.memory_moves), "move on",
                    fmt::format("{} of {} vertices", n, bench_.memory_moves));
      moves.move_one();
    }
    const std::vector<std::int64_t> after = resident_bytes(processes);
    std::int64_t most = 0;
    for (std::size_t n = 0; n < before.size(); ++n) most = std::max(most, after[n] - before[n]);
    // What a process asks for at a time, and may not have asked for before.
    constexpr double kFlat = 1;
    figures_.push_back({"memory_growth",
                        fmt::format("memory of the process that grew most, from {} to {} moves", bench_.moves,
                                    std::max(bench_.moves, bench_.memory_moves)),
                        static_cast<double>(most) / kMiB, "MiB", kFlat,
                        fmt::format("ranks, launcher, client: {} MiB before, {} MiB after",
                                    list(before, "{:.1f}", 1 / kMiB), list(after, "{:.1f}", 1 / kMiB))});
  }

  void ring(EngineClient& client) {
    at(0.08, "ring");
    std::vector<double> seconds;
    constexpr double kAsleep = 0.01;
    for (int n = 0; n < bench_.rings; ++n) {
      sleep_for(kAsleep, job_);
      client.edit({});  // nothing, which all ranks do
      double last = 0;
      const v1::StatusReply status = client.status();
      for (const auto& rank : status.each_rank()) last = std::max(last, rank.start_seconds());
      seconds.push_back(last);
    }
    if (seconds.empty()) return;
    const Spread spread = spread_of(seconds);
    figures_.push_back({"start_p99", "from the bell to the last rank's start, 99th percentile",
                        1e3 * spread.p99, "ms", 1,
                        fmt::format("median {:.3f}, most {:.3f} ms of {} times", 1e3 * spread.median,
                                    1e3 * spread.most, spread.times)});
  }

  void idle(EngineClient& client) {
    at(0.09, "idle");
    const std::vector<int> ranks = ranks_of(client);
    sleep_for(0.5, job_);
    const std::vector<double> before = processor_seconds(ranks);
    const auto begun = Clock::now();
    sleep_for(bench_.idle_seconds, job_);
    std::vector<double> used = processor_seconds(ranks);
    const double seconds = seconds_since(begun);
    for (std::size_t n = 0; n < used.size(); ++n) used[n] = 100 * (used[n] - before[n]) / seconds;
    figures_.push_back({"idle", "idle rank that uses most", *std::max_element(used.begin(), used.end()),
                        "% of a core", 1,
                        fmt::format("each: {} % over {:.0f} s", list(used, "{:.3f}", 1), seconds)});
  }

  void measure_pictures() {
    if (bench_.pictures == 0) return;
    at(0.8, "draw");
    const std::filesystem::path path = folder_.path() / "sphere.h5";
    const float value = write_sphere_volume(path, job_.part(0.8, 0.82));
    std::string expected;
    std::string tiles;
    const JobContext drawing = job_.part(0.82, 0.82);
    const auto draw = [&](EngineClient& client, const std::string& volume, int side) {
      return draw_side(client, volume, value, side, tiles, drawing);
    };
    session::LaunchOptions alone = bench_.launch;
    alone.ranks = 1;
    service::LocalEngine(alone, {}).with_engine([&](EngineClient& client) {
      draw(client, open(client, path, drawing), 0);
      expected = tiles;
    });
    service::LocalEngine engine(bench_.launch, {});
    const std::shared_ptr<EngineClient> held = engine.client(job_);
    EngineClient& client = *held;
    const std::string volume = open(client, path, drawing);
    const double first = draw(client, volume, 0);
    if (tiles != expected) {
      throw Error(ErrorCode::kInternal,
                  fmt::format("{} ranks draw another picture than one", bench_.launch.ranks));
    }
    std::vector<double> seconds;
    for (int side = 1; side <= bench_.pictures; ++side) seconds.push_back(draw(client, volume, side));
    const Spread spread = spread_of(seconds);
    figures_.push_back(
        {"next_picture", fmt::format("next picture of a sphere in {}^3, median", kSphereSize),
         1e3 * spread.median, "ms", std::nullopt,
         fmt::format("first {:.1f} ms, p99 {:.1f} ms of {} from other sides, 1024 x 1024 pixels", 1e3 * first,
                     1e3 * spread.p99, spread.times)});
  }

  void measure_start() {
    if (bench_.volume_bytes == 0) return;
    at(0.85, "make a volume");
    const std::filesystem::path project = folder_.path() / "served.footwall";
    make_hashed_project(project, bench_.volume_bytes, job_.part(0.85, 0.95));
    std::vector<double> seconds;
    for (int n = 0; n <= bench_.starts; ++n) {
      at(0.95, "serve");
      job_.check();
      seconds.push_back(start(project));
    }
    const double first = seconds.front();
    seconds.erase(seconds.begin());
    const Spread spread = spread_of(seconds);
    figures_.push_back(
        {"serve_ready",
         fmt::format("serve of a volume of {:.0f} MiB until ready, median",
                     static_cast<double>(bench_.volume_bytes) / kMiB),
         spread.median, "s", 3,
         fmt::format("first {:.2f} s, then most {:.2f} s of {} times", first, spread.most, spread.times)});
  }

  double start(const std::filesystem::path& project) {
    ServeOptions how;
    how.project = project;
    how.connection = folder_.path() / "engine.json";
    how.engine.launch = bench_.launch;
    const JobContext serving;
    std::optional<double> ready;
    ServeEvents events;
    const auto begun = Clock::now();
    events.ready = [&](const service::Connection&, const std::filesystem::path&, const Replayed& replayed) {
      ready = seconds_since(begun);
      if (replayed.volumes.size() != 1) ready.reset();
      serving.cancel();
    };
    serve(how, events, serving);
    if (!ready) throw Error(ErrorCode::kInternal, "the served engine did not open the project's volume");
    return *ready;
  }

  ServiceBench bench_;
  const JobContext& job_;
  session::PrivateFolder folder_;
  std::vector<ServiceFigure> figures_;
};

}  // namespace

std::vector<ServiceFigure> bench_service(const ServiceBench& bench, const JobContext& job) {
  const auto is_amount = [](std::int64_t amount, std::int64_t least) {
    return amount >= least && amount <= std::int64_t{1} << 40;
  };
  if (!is_amount(bench.faces, 1) || !is_amount(bench.moves, 1) || !is_amount(bench.memory_moves, 0) ||
      !is_amount(bench.many_faces, 1) || !is_amount(bench.batches, 1) || !is_amount(bench.volume_bytes, 0) ||
      !is_amount(bench.starts, 1) || !is_amount(bench.rings, 1) || !is_amount(bench.pictures, 0) ||
      bench.many_faces > bench.faces) {
    throw Error(ErrorCode::kUsage, "such amounts cannot be measured",
                "give whole numbers above 0, and no more faces at once than there are");
  }
  return Bench(bench, job).run();
}

}  // namespace footwall::tasks
