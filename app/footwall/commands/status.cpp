// footwall status: what a running engine holds and does.
#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <thread>

#include "app/footwall/commands/commands.h"
#include "app/footwall/commands/running.h"
#include "engine/service/client/engine_client.h"

namespace footwall::commands {
namespace {

struct Options {
  std::string engine;
  double wait_seconds = 0;
};

constexpr double kMiB = 1 << 20;
constexpr std::chrono::milliseconds kPause{50};

double mib(std::int64_t bytes) {
  return static_cast<double>(bytes) / kMiB;
}

console::Json json_of(const v1::StatusReply& status, const service::Connection& connection) {
  console::Json json = {{"address", connection.address},     {"project", connection.project},
                        {"version", status.version()},       {"host", status.host()},
                        {"process", status.process()},       {"ranks", status.ranks()},
                        {"threads", status.threads()},       {"uptime_seconds", status.uptime_seconds()},
                        {"faces", status.faces()},           {"edit", status.edit()},
                        {"state_hash", status.state_hash()}, {"each_rank", console::Json::array()},
                        {"volumes", console::Json::array()}, {"jobs", console::Json::array()}};
  for (const v1::RankStatus& rank : status.each_rank()) {
    json["each_rank"].push_back(
        {{"rank", rank.rank()},
         {"host", rank.host()},
         {"process", rank.process()},
         {"memory_bytes", rank.memory_bytes()},
         {"start_seconds",
          rank.has_start_seconds() ? console::Json(rank.start_seconds()) : console::Json()}});
  }
  for (const v1::OpenVolumeInfo& volume : status.volumes()) {
    const v1::Index& dims = volume.dims();
    json["volumes"].push_back({{"checksum", volume.volume()},
                               {"path", volume.path()},
                               {"dims", {dims.i(), dims.j(), dims.k()}},
                               {"memory_bytes", volume.memory_bytes()}});
  }
  for (const v1::JobStatus& job : status.jobs()) {
    json["jobs"].push_back({{"job", job.job()},
                            {"what", job.what()},
                            {"running", job.running()},
                            {"fraction", job.progress().fraction()},
                            {"phase", job.progress().phase()},
                            {"amounts", job.progress().amounts()},
                            {"seconds", job.seconds()}});
  }
  return json;
}

std::string in_words(const v1::StatusReply& status, const service::Connection& connection) {
  std::int64_t memory = 0;
  for (const v1::RankStatus& rank : status.each_rank()) memory += rank.memory_bytes();
  std::string text =
      fmt::format("{} on host {}, process {}, since {:.0f} s: {} ranks of {} threads, {:.0f} MiB\n",
                  connection.address, status.host(), status.process(), status.uptime_seconds(),
                  status.ranks(), status.threads(), mib(memory));
  if (!connection.project.empty()) text += fmt::format("project {}\n", connection.project);
  for (const v1::OpenVolumeInfo& volume : status.volumes()) {
    text += fmt::format("volume {}  {}x{}x{}  {:.0f} MiB  {}\n", volume.volume(), volume.dims().i(),
                        volume.dims().j(), volume.dims().k(), mib(volume.memory_bytes()), volume.path());
  }
  text += fmt::format("{} faces, edit {}\n", status.faces(), status.edit());
  for (const v1::JobStatus& job : status.jobs()) {
    text += fmt::format("job {}  {}  {}  {:.0f} %  {} {}  {:.1f} s\n", job.job(), job.what(),
                        job.running() ? "runs" : "waits", 100 * job.progress().fraction(),
                        job.progress().phase(), job.progress().amounts(), job.seconds());
  }
  return text;
}

// What may be different a moment later, while an engine starts.
bool may_come(const Error& error) {
  return error.code() == ErrorCode::kNotFound || error.code() == ErrorCode::kEngine;
}

console::Output run(const Options& options, const JobContext& job) {
  if (!(options.wait_seconds >= 0 && options.wait_seconds <= 1e6)) {
    throw Error(ErrorCode::kUsage, fmt::format("--wait {} is no time", options.wait_seconds),
                "give seconds, 0 or more");
  }
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(options.wait_seconds);
  for (;;) {
    job.check();
    try {
      const service::Connection connection = running_engine(options.engine);
      const v1::StatusReply status = service::EngineClient(connection).status();
      return {json_of(status, connection), in_words(status, connection)};
    } catch (const Error& error) {
      if (!may_come(error) || std::chrono::steady_clock::now() >= end) throw;
    }
    std::this_thread::sleep_for(kPause);
  }
}

}  // namespace

void add_status(console::Program& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add(nullptr, "status", "Tell what a running engine holds and does",
                  [options](console::Console& console) { return run(*options, console.job()); });
  command->add_option(
      "engine", options->engine,
      "A project that is served, @FILE or an address (default: the engine without a project)");
  command->add_option("--wait", options->wait_seconds,
                      "Seconds to wait for an engine that is being started (default 0)");
}

}  // namespace footwall::commands
