#include "engine/session/attribute.h"

#include <omp.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "storage/base/hash.h"
#include "storage/base/partial_file.h"
#include "storage/volume/volume_reader_parallel.h"
#include "storage/volume/volume_writer.h"

namespace footwall::session {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kJobLimit = std::size_t{1} << 20;

// The blocks in the order in which the writer asks for them (volume_writer.h).
std::vector<survey::Box> blocks_of(const survey::Index& dims) {
  const survey::Index chunk = volume::default_chunk(dims);
  std::vector<survey::Box> blocks;
  for (std::int64_t i = 0; i < dims[0]; i += chunk[0]) {
    for (std::int64_t j = 0; j < dims[1]; j += chunk[1]) {
      blocks.push_back(
          {{i, j, 0}, {std::min(i + chunk[0], dims[0]), std::min(j + chunk[1], dims[1]), dims[2]}});
    }
  }
  return blocks;
}

// The blocks of one round: block `first + r` is computed by rank r; rank 0 gets them all.
class Rounds {
 public:
  Rounds(const comm::Communicator& parent, const AttributeJob& job)
      : world_(parent.get()),
        // The reader throws on all ranks or on none, so that it may stand inside collectively().
        reader_(world_.collectively([&] { return volume::ParallelVolumeReader(world_.get(), job.volume); })),
        window_(job.window),
        kernel_(world_.collectively([&] {
          const volume::VolumeInfo& info = reader_.info();
          return extract::DiscontinuityVolume(window_, info.dims, info.statistics.max_abs);
        })),
        blocks_(world_.collectively([&] { return blocks_of(reader_.info().dims); })) {}

  comm::Communicator& world() { return world_; }
  const volume::VolumeInfo& info() const { return reader_.info(); }
  std::size_t blocks() const { return blocks_.size(); }
  const survey::Box& block(std::size_t n) const { return blocks_[n]; }
  std::size_t ranks() const { return static_cast<std::size_t>(world_.size()); }

  // Collective: the values of blocks first .. first + ranks - 1 on rank 0.
  std::vector<comm::Bytes> round(std::size_t first, const JobContext& context) {
    return world_.exchange(world_.collectively([&] {
      context.check();
      std::vector<comm::Bytes> outgoing(ranks());
      const std::size_t mine = first + static_cast<std::size_t>(world_.rank());
      if (mine >= blocks_.size()) return outgoing;
      const survey::Box needed = extract::needed_for(blocks_[mine], window_, reader_.info().dims);
      values_.resize(static_cast<std::size_t>(needed.count()));
      reader_.read_independent(needed, values_);
      made_.resize(static_cast<std::size_t>(blocks_[mine].count()));
      kernel_.compute(blocks_[mine], values_, made_);
      const auto raw = std::as_bytes(std::span(made_));
      outgoing[0].assign(raw.begin(), raw.end());
      return outgoing;
    }));
  }

 private:
  comm::Communicator world_;
  volume::ParallelVolumeReader reader_;
  extract::Window window_;
  extract::DiscontinuityVolume kernel_;
  std::vector<survey::Box> blocks_;
  std::vector<float> values_, made_;
};

volume::WriteOptions options_of(const volume::VolumeInfo& info, const AttributeJob& job) {
  volume::WriteOptions options;
  options.geometry = info.geometry;
  options.origin = info.origin;
  options.role = volume::Role::kDiscontinuity;
  options.high_is_fault = true;
  options.source = "discontinuity of " + job.volume.filename().string();
  const Json provenance{
      {"attribute", "discontinuity"},
      {"window", extract::text_of(job.window)},
      {"of", {{"file", job.volume.filename().string()}, {"checksum", to_hex(info.checksum)}}},
      {"high_is", "fault"}};
  options.provenance_json = provenance.dump(-1, ' ', false, Json::error_handler_t::replace);
  return options;
}

// Rank 0: the writer asks for one block after the other; every so often a round of all ranks makes the next
// ones.
volume::VolumeInfo write_all(Rounds& rounds, const AttributeJob& job, const JobContext& context) {
  std::vector<comm::Bytes> made;
  std::size_t next = 0;
  bool together = false;  // inside a round, whose errors all ranks know
  try {
    const auto fill = [&](const survey::Box& box, std::span<float> values, std::span<std::uint8_t>) {
      require(box == rounds.block(next), "the writer's order of blocks");
      if (next % rounds.ranks() == 0) {
        together = true;
        made = rounds.round(next, context);
        together = false;
      }
      const comm::Bytes& bytes = made[next % rounds.ranks()];
      require(bytes.size() == values.size_bytes(), "the values of a block");
      std::memcpy(values.data(), bytes.data(), bytes.size());
      ++next;
    };
    return volume::write_volume(job.output, options_of(rounds.info(), job), fill, context);
  } catch (...) {
    if (together) throw;
    // This rank alone: the others wait in the next round.
    rounds.world().collectively([] { throw; });
  }
  throw Error(ErrorCode::kInternal, "an error that nobody knows");
}

}  // namespace

void write_attribute_job(const AttributeJob& job, const std::filesystem::path& path) {
  const Json json{{"footwall_attribute", 1},
                  {"kind", "discontinuity"},
                  {"window", extract::text_of(job.window)},
                  {"volume", job.volume.string()},
                  {"output", job.output.string()},
                  {"result", job.result.string()}};
  std::string text;
  try {
    text = json.dump(1) + "\n";
  } catch (const Json::exception&) {
    throw Error(ErrorCode::kUnsupported,
                "the engine cannot be told the path " + job.volume.string() + ": it is not UTF-8",
                "rename it");
  }
  write_whole_file(path, text);
}

AttributeJob read_attribute_job(const std::filesystem::path& path) {
  const Json json = Json::parse(read_whole_file(path, kJobLimit), nullptr, false);
  const Error odd(ErrorCode::kFormat, path.string() + " is no attribute job of this version",
                  "use footwall attribute");
  try {
    if (json.at("footwall_attribute") != 1 || json.at("kind") != "discontinuity") throw odd;
    AttributeJob job;
    job.window = extract::parse_window(json.at("window").get<std::string>());
    job.volume = json.at("volume").get<std::string>();
    job.output = json.at("output").get<std::string>();
    job.result = json.at("result").get<std::string>();
    return job;
  } catch (const Json::exception&) {
    throw odd;
  }
}

void run_attribute(const comm::Communicator& parent, const std::filesystem::path& job_path,
                   const JobContext& context) {
  const double start = omp_get_wtime();
  const AttributeJob job = parent.collectively([&] { return read_attribute_job(job_path); });
  Rounds rounds(parent, job);
  comm::Communicator& world = rounds.world();
  std::optional<volume::VolumeInfo> made;
  if (world.rank() == 0) {
    made = write_all(rounds, job, context);
  } else {
    for (std::size_t first = 0; first < rounds.blocks(); first += rounds.ranks())
      rounds.round(first, context);
  }
  // Rank 0 comes here when the file is whole, or not at all.
  world.collectively([&] {
    if (world.rank() != 0) return;
    const Json result{
        {"ranks", world.size()}, {"checksum", to_hex(made->checksum)}, {"seconds", omp_get_wtime() - start}};
    write_whole_file(job.result, result.dump(1) + "\n");
  });
}

}  // namespace footwall::session
