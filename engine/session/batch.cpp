#include "engine/session/batch.h"

#include <omp.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/extract/balance/area.h"
#include "engine/extract/extract.h"
#include "engine/extract/registry.h"
#include "engine/session/fault_summary.h"
#include "engine/session/job.h"
#include "engine/session/part_file.h"
#include "engine/session/shared_parts.h"
#include "storage/base/hash.h"
#include "storage/base/partial_file.h"
#include "storage/volume/volume_reader_parallel.h"

namespace footwall::session {
namespace {

using Json = nlohmann::json;

// How much a stopped job may lose, against the cost of one more round of all ranks.
constexpr std::size_t kSmallestGroup = 20000;  // faces
constexpr std::size_t kMostGroups = 20;

std::string shared_text(const comm::Communicator& world, const std::string& text) {
  const auto raw = std::as_bytes(std::span(text));
  const comm::Bytes bytes = world.broadcast(comm::Bytes(raw.begin(), raw.end()), 0);
  return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

// Rank 0 reads the files, everyone parses them.
Job shared_job(const comm::Communicator& world, const std::filesystem::path& path) {
  JobFiles files = world.collectively([&] { return world.rank() == 0 ? read_job_files(path) : JobFiles{}; });
  files.json = shared_text(world, files.json);
  files.faces = shared_text(world, files.faces);
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

Json phases(const extract::Seconds& seconds) {
  return {{"read", seconds.read},
          {"balance", seconds.balance},
          {"voxelize", seconds.voxelize},
          {"exchange", seconds.exchange},
          {"compute", seconds.compute}};
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

// Of the slowest rank in each phase.
Json with_total(Json seconds, double total) {
  seconds["total"] = total;
  return seconds;
}

Json summary(const Job& job, const std::filesystem::path& job_path, const extract::Report& report,
             const SharedParts& parts, double total_seconds) {
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
  return {{"job", job_path.filename().string()},
          {"ranks", report.ranks},
          {"threads", report.threads},
          {"exchange", report.exchange},
          {"balance", report.balance},
          {"voxelizer", job.options.voxelizer},
          {"faces", faces.size()},
          {"voxels", voxels},
          {"bytes_sent", report.bytes_sent},
          {"messages", report.messages},
          {"load_max_over_mean", report.load_max_over_mean},
          {"load_deviation", report.load_deviation},
          {"pillars", job.options.pillars},
          {"cache_hits", report.cache_hits},
          {"cache_voxels", report.cache_voxels},
          {"reason", report.reason},
          {"predicted",
           {{"balance", report.predicted.balance},
            {"voxelize", report.predicted.voxelize},
            {"exchange", report.predicted.exchange},
            {"compute", report.predicted.compute},
            {"total", report.predicted.total}}},
          {"checksum", to_hex(extract::checksum_of(faces, statistics))},
          {"seconds", with_total(phases(report.seconds), total_seconds)},
          {"quickest_seconds", phases(report.quickest)},
          {"volume", {{"path", job.volume.string()}, {"checksum", job.volume_checksum}}},
          {"faults", faults},
          {"parts", files}};
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

}  // namespace

void run_batch(const comm::Communicator& world, const std::filesystem::path& job_path,
               const JobContext& context, const BatchOptions& options) {
  const double start = omp_get_wtime();

  // 1 Read the job; look at the volume.
  Job job = shared_job(world, job_path);
  if (options.threads > 0) job.options.threads = options.threads;
  if (!options.volume.empty()) job.volume = std::filesystem::absolute(options.volume);
  world.collectively([&] { extract::validate(job.options); });
  // The reader throws on all ranks or on none, so that it may stand inside collectively().
  auto reader = world.collectively([&] { return volume::ParallelVolumeReader(world.get(), job.volume); });
  world.collectively([&] { check_volume(reader.info(), job); });

  // 2 Which faults are done already?
  world.collectively([&] {
    if (world.rank() == 0) make_folder(job.output);
  });
  SharedParts parts(world, job);
  std::size_t all_faces = 0;
  for (std::size_t n = 0; n < job.faults.size(); ++n) {
    if (!parts.done(n)) all_faces += job.faults[n].faces.size();
  }
  const auto groups = parts.groups(std::max(kSmallestGroup, all_faces / kMostGroups));

  // 3 EXTRACT-ALL over the others, group by group; the parts of each are on disk before the next.
  Totals totals(job, world.size());
  if (!groups.empty()) {
    const auto read = [&](const survey::Box& box, std::span<float> values) {
      reader.read_collective(box, values);
    };
    extract::LoadedSurvey survey(world, reader.info().dims, read, context.part(0, 0.5), job.options.pillars);
    std::size_t before = 0;
    for (const std::vector<std::size_t>& group : groups) {
      std::vector<extract::Face> faces;
      for (const std::size_t n : group)
        faces.insert(faces.end(), job.faults[n].faces.begin(), job.faults[n].faces.end());
      const auto share = [&](std::size_t n) {
        return all_faces == 0 ? 0.98 : 0.5 + 0.48 * static_cast<double>(n) / static_cast<double>(all_faces);
      };
      const double done = share(before + faces.size());
      const extract::Input input{reader.info().dims, reader.info().statistics.max_abs, faces};
      const extract::Result result = survey.extract(input, job.options, context.part(share(before), done));
      parts.write(group, result.faces, result.blobs,
                  survey.faults(input, job.options, context.part(done, done)));
      totals.add(result.report);
      before += faces.size();
    }
  }

  // 4 The summary.
  const extract::Report report = totals.report(world);
  world.collectively([&] {
    if (world.rank() != 0) return;
    const Json json = summary(job, job_path, report, parts, omp_get_wtime() - start);
    write_whole_file(job.output / "result.json",
                     json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
    context.report(1, "write", "done");
  });
}

}  // namespace footwall::session
