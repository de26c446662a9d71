#include <sys/resource.h>
#include <unistd.h>

#include <fmt/format.h>
#include <array>
#include <cerrno>
#include <chrono>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>

#include "engine/session/rank_log.h"
#include "storage/base/error.h"

namespace footwall::session {
namespace {

using Json = nlohmann::json;

std::string host_name() {
  std::array<char, 256> name{};
  if (gethostname(name.data(), name.size() - 1) != 0) return "unknown";
  return name.data();
}

std::int64_t peak_memory_bytes() {
  rusage usage = {};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
  return std::int64_t{usage.ru_maxrss} * 1024;
}

Json json_of(const RankPhases& phases) {
  const extract::Seconds& s = phases.seconds;
  return {{"read", s.read}, {"balance", s.balance}, {"voxelize", s.voxelize}, {"exchange", s.exchange},
          {"wait", s.wait}, {"compute", s.compute}, {"write", phases.write},  {"total", phases.total}};
}

std::string time_in_words() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm parts = {};
  gmtime_r(&now, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text.data();
}

}  // namespace

Json rank_log(const comm::Communicator& world, const RankPhases& mine, int threads) {
  const Json own{{"rank", world.rank()},     {"host", host_name()},
                 {"process", ::getpid()},    {"threads", threads},
                 {"seconds", json_of(mine)}, {"peak_memory_bytes", peak_memory_bytes()}};
  const std::string text = own.dump(-1, ' ', false, Json::error_handler_t::replace);
  Json all = Json::array();
  for (int rank = 0; rank < world.size(); ++rank) {
    comm::Bytes bytes;
    if (rank == world.rank()) {
      const auto raw = std::as_bytes(std::span(text));
      bytes.assign(raw.begin(), raw.end());
    }
    bytes = world.broadcast(std::move(bytes), rank);
    if (world.rank() == 0)
      all.push_back(Json::parse(reinterpret_cast<const char*>(bytes.data()),
                                reinterpret_cast<const char*>(bytes.data()) + bytes.size()));
  }
  return world.rank() == 0 ? all : Json();
}

void append_rank_log(const std::filesystem::path& path, const std::string& outcome, const Json& ranks) {
  std::ofstream file(path, std::ios::app);
  file << time_in_words() << " " << outcome << "\n";
  for (const Json& each : ranks) {
    file << fmt::format("  rank {} on {}, process {}, {} threads:", each.at("rank").get<int>(),
                        each.at("host").get<std::string>(), each.at("process").get<int>(),
                        each.at("threads").get<int>());
    for (const auto& [phase, seconds] : each.at("seconds").items())
      file << fmt::format(" {} {:.3f} s,", phase, seconds.get<double>());
    file << fmt::format(" peak {} MB\n", each.at("peak_memory_bytes").get<std::int64_t>() / 1000000);
  }
  file.close();
  if (!file) throw io_error("write", path.string(), errno);
}

}  // namespace footwall::session
