#include "engine/session/attribute.h"

#include <omp.h>

#include <algorithm>
#include <deque>
#include <nlohmann/json.hpp>

#include "engine/session/job_json.h"
#include "storage/base/hash.h"
#include "storage/base/partial_file.h"
#include "storage/volume/volume_reader_parallel.h"
#include "storage/volume/volume_writer_parallel.h"

namespace footwall::session {
namespace {

using Json = nlohmann::json;

// What a rank needs to make blocks of the new volume.
class Maker {
 public:
  Maker(const comm::Communicator& world, const AttributeJob& job)
      // The reader throws on all ranks or on none, so that it may stand inside collectively().
      : reader_(world.collectively([&] { return volume::ParallelVolumeReader(world.get(), job.volume); })),
        window_(job.window),
        kernel_(world.collectively([&] {
          const volume::VolumeInfo& info = reader_.info();
          return extract::DiscontinuityVolume(window_, info.dims, info.statistics.max_abs);
        })) {}

  const volume::VolumeInfo& info() const { return reader_.info(); }

  // Not collective. Blocks come in the writer's order: what the next one needs, too, is read once.
  void make(const survey::Box& block, std::span<float> out) {
    const survey::Box needed = extract::needed_for(block, window_, info().dims);
    values_.resize(static_cast<std::size_t>(needed.count()));
    const std::int64_t width = volume::default_chunk(info().dims)[1];
    const bool goes_on = !slices_.empty() && slices_.front().box.lo[0] == needed.lo[0] &&
                         slices_.front().box.hi[0] == needed.hi[0] &&
                         slices_.front().box.lo[1] <= needed.lo[1];
    if (!goes_on) slices_.clear();
    while (!slices_.empty() && slices_.front().box.hi[1] <= needed.lo[1]) slices_.pop_front();
    std::int64_t next = slices_.empty() ? needed.lo[1] / width * width : slices_.back().box.hi[1];
    for (; next < needed.hi[1]; next = slices_.back().box.hi[1]) read_slice(needed, next, next + width);
    for (const Slice& slice : slices_) copy_part(slice, needed);
    kernel_.compute(block, values_, out);
  }

 private:
  // Values of a range of crosslines that ends where chunks of the source do, if they are as wide as ours.
  struct Slice {
    survey::Box box;
    std::vector<float> values;
  };

  void read_slice(const survey::Box& needed, std::int64_t first, std::int64_t end) {
    Slice slice;
    slice.box = needed;
    slice.box.lo[1] = first;
    slice.box.hi[1] = std::min(end, info().dims[1]);
    slice.values.resize(static_cast<std::size_t>(slice.box.count()));
    reader_.read_independent(slice.box, slice.values);
    slices_.push_back(std::move(slice));
  }

  void copy_part(const Slice& slice, const survey::Box& needed) {
    const survey::Box part = survey::intersection(slice.box, needed);
    const std::int64_t samples = needed.size(2);
    for (std::int64_t i = 0; i < needed.size(0); ++i) {
      const std::int64_t from = i * slice.box.size(1) + part.lo[1] - slice.box.lo[1];
      const std::int64_t to = i * needed.size(1) + part.lo[1] - needed.lo[1];
      std::copy_n(slice.values.data() + from * samples, part.size(1) * samples,
                  values_.data() + to * samples);
    }
  }

  volume::ParallelVolumeReader reader_;
  extract::Window window_;
  extract::DiscontinuityVolume kernel_;
  std::deque<Slice> slices_;  // one after the other
  std::vector<float> values_;
};

volume::WriteOptions options_of(const volume::VolumeInfo& info, const AttributeJob& job) {
  volume::WriteOptions options;
  options.geometry = info.geometry;
  options.origin = info.origin;
  options.role = volume::Role::kDiscontinuity;
  options.high_is_fault = true;
  const std::string file = job.volume_file.empty() ? job.volume.filename().string() : job.volume_file;
  options.source = "discontinuity of " + file;
  const Json provenance{{"attribute", "discontinuity"},
                        {"window", extract::text_of(job.window)},
                        {"of", {{"file", file}, {"checksum", to_hex(info.checksum)}}},
                        {"high_is", "fault"}};
  options.provenance_json = provenance.dump(-1, ' ', false, Json::error_handler_t::replace);
  return options;
}

}  // namespace

Json json_of(const AttributeJob& job) {
  Json json{{"footwall_attribute", 1},
            {"kind", "discontinuity"},
            {"window", extract::text_of(job.window)},
            {"volume", job.volume.string()},
            {"output", job.output.string()},
            {"result", job.result.string()}};
  if (!job.volume_file.empty()) json["volume_file"] = job.volume_file;
  return json;
}

void write_attribute_job(const AttributeJob& job, const std::filesystem::path& path) {
  write_job_json(json_of(job), path, "the path " + job.volume.string() + ": it is not UTF-8");
}

AttributeJob read_attribute_job(const std::filesystem::path& path) {
  return attribute_job_from(read_job_json(path), path.string());
}

AttributeJob attribute_job_from(const Json& json, const std::string& what) {
  const Error odd(ErrorCode::kFormat, what + " is no attribute job of this version",
                  "use footwall attribute");
  try {
    if (json.at("footwall_attribute") != 1 || json.at("kind") != "discontinuity") throw odd;
    AttributeJob job;
    job.window = extract::parse_window(json.at("window").get<std::string>());
    job.volume = json.at("volume").get<std::string>();
    job.output = json.at("output").get<std::string>();
    job.result = json.at("result").get<std::string>();
    job.volume_file = json.value("volume_file", "");
    return job;
  } catch (const Json::exception&) {
    throw odd;
  }
}

void run_attribute(const comm::Communicator& parent, const std::filesystem::path& job_path,
                   const JobContext& context) {
  run_attribute(parent, parent.collectively([&] { return read_attribute_job(job_path); }), context);
}

void run_attribute(const comm::Communicator& parent, const AttributeJob& job, const JobContext& context) {
  const double start = omp_get_wtime();
  const comm::Communicator world(parent.get());
  Maker maker(world, job);
  // As the reader: the writer throws on all ranks or on none.
  const volume::VolumeInfo made = world.collectively([&] {
    const auto fill = [&](const survey::Box& block, std::span<float> values, std::span<std::uint8_t>) {
      maker.make(block, values);
    };
    return volume::write_volume_parallel(world.get(), job.output, options_of(maker.info(), job), fill,
                                         context);
  });
  world.collectively([&] {
    if (world.rank() != 0) return;
    const Json result{
        {"ranks", world.size()}, {"checksum", to_hex(made.checksum)}, {"seconds", omp_get_wtime() - start}};
    write_whole_file(job.result, result.dump(1) + "\n");
  });
}

}  // namespace footwall::session
