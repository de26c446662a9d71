#include "engine/session/batch.h"

#include <omp.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/comm/shared_text.h"
#include "engine/extract/balance/area.h"
#include "engine/extract/extract.h"
#include "engine/extract/registry.h"
#include "engine/session/fault_summary.h"
#include "engine/session/job.h"
#include "engine/session/part_file.h"
#include "engine/session/rank_log.h"
#include "engine/session/report_json.h"
#include "engine/session/shared_parts.h"
#include "storage/base/hash.h"
#include "storage/base/log.h"
#include "storage/base/partial_file.h"
#include "storage/volume/volume_reader_parallel.h"

namespace footwall::session {
namespace {

using Json = nlohmann::json;

// How much a stopped job may lose, against the cost of one more round of all ranks.
constexpr std::size_t kFirstGroup = 20000;  // faces
constexpr std::size_t kMostGroups = 20;     // but for what is slow
constexpr double kGroupSeconds = 10;
constexpr std::size_t kSmallestGroup = 500;
constexpr const char* kLog = "log.txt";  // beside result.json

// Rank 0 has the files, everyone parses them.
Job shared_job(const comm::Communicator& world, JobFiles files, const std::filesystem::path& path) {
  files.json = comm::shared_text(world, files.json);
  files.faces = comm::shared_text(world, files.faces);
  return world.collectively([&] { return parse_job(files, std::filesystem::absolute(path).parent_path()); });
}

std::string described(const survey::Geometry& g) {
  return fmt::format(
      "{} x {} x {} voxels, inlines from {} by {}, crosslines from {} by {}, z from {} by {} {}",
      g.inlines.count, g.crosslines.count, g.samples, g.inlines.first, g.inlines.step, g.crosslines.first,
      g.crosslines.step, g.z0, g.interval, name_of(g.vertical_unit));
}

void check_volume(const volume::VolumeInfo& info, Job& job) {
  const std::string checksum = to_hex(info.checksum);
  if (!job.volume_checksum.empty() && job.volume_checksum != checksum) {
    throw Error(ErrorCode::kInvalid,
                fmt::format("the volume {} has checksum {}, the job was written for {}", job.volume.string(),
                            checksum, job.volume_checksum),
                "write the job again, or give it the volume that it was written for");
  }
  job.volume_checksum = checksum;
  // The names of the coordinate system and what was assumed do not change a number.
  survey::Geometry theirs = info.geometry;
  theirs.crs = job.geometry.crs;
  theirs.assumed = job.geometry.assumed;
  if (!(theirs == job.geometry)) {
    throw Error(ErrorCode::kInvalid,
                "the volume does not fit the job's survey: it has " + described(info.geometry) +
                    ", the survey " + described(job.geometry),
                "extract from a volume of this survey");
  }
}

// All but reading, which is done once for all groups, and the total.
void add_phases(const extract::Seconds& group, extract::Seconds& sum) {
  sum.balance += group.balance;
  sum.voxelize += group.voxelize;
  sum.exchange += group.exchange;
  sum.compute += group.compute;
}

// What was computed, over all groups of faults.
class Totals {
 public:
  Totals(const Job& job, int ranks) {
    report_.exchange = job.options.exchange == "auto" ? "reduce" : job.options.exchange;
    report_.balance = job.options.balance;
    report_.ranks = ranks;
    report_.threads = job.options.threads;
  }
  void add(const extract::Report& group) {
    extract::Seconds& sum = report_.seconds;
    sum.read = group.seconds.read;  // once for all groups
    report_.quickest.read = group.quickest.read;
    add_phases(group.seconds, sum);
    add_phases(group.quickest, report_.quickest);
    report_.exchange = group.exchange;
    report_.balance = group.balance;
    report_.reason = group.reason;
    report_.cache_hits += group.cache_hits;
    report_.cache_voxels = group.cache_voxels;  // those kept after the last
    report_.loads.resize(group.loads.size());
    for (std::size_t rank = 0; rank < group.loads.size(); ++rank) report_.loads[rank] += group.loads[rank];
    extract::Seconds& predicted = report_.predicted;
    predicted.balance += group.predicted.balance;
    predicted.voxelize += group.predicted.voxelize;
    predicted.exchange += group.predicted.exchange;
    predicted.compute += group.predicted.compute;
    predicted.total += group.predicted.total;
    report_.bytes_sent += group.bytes_sent;
    report_.messages += group.messages;
    report_.most_bytes += group.most_bytes;
    report_.most_messages += group.most_messages;
    report_.voxels += group.voxels;
    report_.walked_here += group.walked_here;
  }
  // Collective.
  extract::Report report(const comm::Communicator& world) const {
    extract::Report whole = report_;
    whole.load_deviation = extract::load_deviation(whole.loads);
    const std::int64_t most = world.maximum(whole.walked_here);
    if (whole.voxels > 0) {
      whole.load_max_over_mean = static_cast<double>(most) * whole.ranks / static_cast<double>(whole.voxels);
    }
    return whole;
  }

 private:
  extract::Report report_;
};

Json summary(const Job& job, const std::filesystem::path& job_path, const extract::Report& report,
             const SharedParts& parts, const Json& each_rank, double total_seconds) {
  std::vector<extract::Face> faces;
  std::vector<extract::FaceStatistics> statistics;
  Json files = Json::array();
  Json faults = Json::array();
  std::int64_t voxels = 0;
  for (std::size_t n = 0; n < job.faults.size(); ++n) {
    const JobFault& fault = job.faults[n];
    const std::vector<extract::FaceStatistics>& computed = parts.statistics()[n];
    faces.insert(faces.end(), fault.faces.begin(), fault.faces.end());
    statistics.insert(statistics.end(), computed.begin(), computed.end());
    for (const extract::FaceStatistics& face : computed) voxels += face.count + face.nulls;
    faults.push_back(fault_summary(parts.wholes()[n]));
    faults.back().update({{"fault", fault.id}, {"name", fault.name}, {"faces", fault.faces.size()}});
    files.push_back({{"fault", fault.id},
                     {"name", fault.name},
                     {"file", part_path({}, fault.id).string()},
                     {"faces", fault.faces.size()},
                     {"reused", parts.reused(n)}});
  }
  // Amounts and seconds are of what was computed, the rest of everything.
  Json json = report_json(report, job.options);
  json["job"] = job_path.filename().string();
  json["faces"] = faces.size();
  json["voxels"] = voxels;
  json["seconds"]["total"] = total_seconds;
  json["each_rank"] = each_rank;
  json["checksum"] = to_hex(extract::checksum_of(faces, statistics));
  json["volume"] = {{"path", job.volume.string()}, {"checksum", job.volume_checksum}};
  json["faults"] = std::move(faults);
  json["parts"] = std::move(files);
  return json;
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) throw io_error("make the folder", folder.string(), failure.value());
  std::filesystem::remove(folder / "result.json", failure);
  if (failure) throw io_error("remove", (folder / "result.json").string(), failure.value());
  // Halves of parts that a killed run left.
  for (const auto& entry : std::filesystem::directory_iterator(folder, failure)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(".fault-") && name.find(".part.h5.partial-") != std::string::npos)
      std::filesystem::remove(entry.path(), failure);
  }
}

// The job between reading and its summary.
class Batch {
 public:
  Batch(const comm::Communicator& world, Job job, const std::filesystem::path& job_path,
        const JobContext& context, const BatchOptions& options)
      : world_(world), job_(std::move(job)), job_path_(job_path), context_(context), options_(options) {}

  void run();

 private:
  void extract_missing(volume::ParallelVolumeReader& reader, SharedParts& parts, Totals& totals);
  void tell(const std::vector<std::size_t>& written);
  void add(const extract::Seconds& group);
  Json log() {
    phases_.total = omp_get_wtime() - start_;
    return rank_log(world_, phases_, job_.options.threads);
  }
  void log_failure(const Error& error);

  const comm::Communicator& world_;
  Job job_;
  const std::filesystem::path& job_path_;
  const JobContext& context_;
  const BatchOptions& options_;
  double start_ = omp_get_wtime();
  RankPhases phases_;
};

void Batch::add(const extract::Seconds& group) {
  add_phases(group, phases_.seconds);
  phases_.seconds.read = group.read;
  phases_.seconds.wait += group.wait;
}

void Batch::tell(const std::vector<std::size_t>& written) {
  world_.collectively([&] {
    if (world_.rank() != 0) return;
    for (const std::size_t n : written) options_.part_written(part_path(job_.output, job_.faults[n].id));
  });
}

void Batch::extract_missing(volume::ParallelVolumeReader& reader, SharedParts& parts, Totals& totals) {
  std::size_t all_faces = 0;
  for (std::size_t n = 0; n < job_.faults.size(); ++n) {
    if (!parts.done(n)) all_faces += job_.faults[n].faces.size();
  }
  std::size_t most = kFirstGroup;
  std::vector<std::size_t> group = parts.next_group(most);
  if (group.empty()) return;
  const auto read = [&](const survey::Box& box, std::span<float> values) {
    reader.read_collective(box, values);
  };
  extract::LoadedSurvey survey(world_, reader.info().dims, read, context_.part(0, 0.5), job_.options.pillars);
  const auto share = [&](std::size_t n) {
    return all_faces == 0 ? 0.98 : 0.5 + 0.48 * static_cast<double>(n) / static_cast<double>(all_faces);
  };
  std::size_t before = 0;
  for (; !group.empty(); group = parts.next_group(most)) {
    const double start = omp_get_wtime();
    std::vector<extract::Face> faces;
    for (const std::size_t n : group)
      faces.insert(faces.end(), job_.faults[n].faces.begin(), job_.faults[n].faces.end());
    const double done = share(before + faces.size());
    const extract::Input input{reader.info().dims, reader.info().statistics.max_abs, faces};
    const extract::Result result = survey.extract(input, job_.options, context_.part(share(before), done));
    const double extracted = omp_get_wtime();
    parts.write(group, result.faces, result.blobs,
                survey.faults(input, job_.options, context_.part(done, done)));
    if (options_.part_written) tell(group);
    phases_.write += omp_get_wtime() - extracted;
    add(survey.own_seconds());
    totals.add(result.report);
    before += faces.size();
    // All ranks take the same next group: that of the slowest's clock.
    const double seconds = std::max(world_.maximum(omp_get_wtime() - start), 1e-6);
    const double in_time = kGroupSeconds * static_cast<double>(faces.size()) / seconds;
    const std::size_t upper = std::max(kFirstGroup, all_faces / kMostGroups);
    most = in_time < static_cast<double>(upper) ? std::max(kSmallestGroup, static_cast<std::size_t>(in_time))
                                                : upper;
  }
}

void Batch::run() {
  // 1 Look at the volume.
  world_.collectively([&] { extract::validate(job_.options); });
  // The reader throws on all ranks or on none, so that it may stand inside collectively().
  auto reader = world_.collectively([&] { return volume::ParallelVolumeReader(world_.get(), job_.volume); });
  world_.collectively([&] { check_volume(reader.info(), job_); });

  // 2 Which faults are done already?
  world_.collectively([&] {
    if (world_.rank() == 0) make_folder(job_.output);
  });
  try {
    SharedParts parts(world_, job_, options_.one_writer ? 1 : world_.size());

    // 3 EXTRACT-ALL over the others, group by group; the parts of each are on disk before the next.
    Totals totals(job_, world_.size());
    extract_missing(reader, parts, totals);

    // 4 The summary.
    const extract::Report report = totals.report(world_);
    const Json ranks = log();
    world_.collectively([&] {
      if (world_.rank() != 0) return;
      const Json json = summary(job_, job_path_, report, parts, ranks, omp_get_wtime() - start_);
      append_rank_log(job_.output / kLog, fmt::format("{}: done", job_path_.filename().string()), ranks);
      write_whole_file(job_.output / "result.json",
                       json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
      context_.report(1, "write", "done");
    });
  } catch (const comm::AgreedError& error) {
    log_failure(error);
    throw;
  }
}

// All ranks are here with the same error. That it cannot be noted is a lesser one.
void Batch::log_failure(const Error& error) {
  const Json ranks = log();
  if (world_.rank() != 0) return;
  try {
    append_rank_log(job_.output / kLog,
                    fmt::format("{}: ended early: {}", job_path_.filename().string(), error.message()),
                    ranks);
  } catch (const Error& failure) {
    log::warn(failure.what());
  }
}

}  // namespace

bool goes_on_with(std::string_view name) {
  return name == kLog || (name.starts_with("fault-") && name.ends_with(".part.h5"));
}

void run_batch(const comm::Communicator& world, const std::filesystem::path& job_path,
               const JobContext& context, const BatchOptions& options) {
  run_batch(world,
            world.collectively([&] { return world.rank() == 0 ? read_job_files(job_path) : JobFiles{}; }),
            job_path, context, options);
}

void run_batch(const comm::Communicator& world, const JobFiles& files, const std::filesystem::path& job_path,
               const JobContext& context, const BatchOptions& options) {
  Job job = shared_job(world, files, job_path);
  if (options.threads > 0) job.options.threads = options.threads;
  if (!options.volume.empty()) job.volume = std::filesystem::absolute(options.volume);
  Batch(world, std::move(job), job_path, context, options).run();
}

}  // namespace footwall::session
