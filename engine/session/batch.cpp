#include "engine/session/batch.h"

#include <omp.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/extract/extract.h"
#include "engine/extract/face_geometry.h"
#include "engine/extract/registry.h"
#include "engine/session/job.h"
#include "engine/session/part_file.h"
#include "storage/base/hash.h"
#include "storage/base/partial_file.h"
#include "storage/volume/volume_reader_parallel.h"

namespace footwall::session {
namespace {

using Json = nlohmann::json;

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

// The whole parts of an earlier run that belong to this very job; the others are left empty.
std::vector<std::optional<Part>> earlier_parts(const Job& job) {
  std::vector<std::optional<Part>> parts(job.faults.size());
  for (std::size_t n = 0; n < parts.size(); ++n) {
    const JobFault& fault = job.faults[n];
    const std::filesystem::path path = part_path(job.output, fault.id);
    if (!std::filesystem::exists(path)) continue;
    try {
      Part part = read_part(path);
      if (part.hash == part_hash(job, fault) && part.faces == fault.faces) parts[n] = std::move(part);
    } catch (const Error&) {
      // Not whole, or not ours: it is computed and written again.
    }
  }
  return parts;
}

Part new_part(const Job& job, const JobFault& fault, std::span<const extract::FaceStatistics> statistics) {
  Part part{fault.id, fault.name, part_hash(job, fault), fault.faces, {statistics.begin(), statistics.end()},
            {}};
  for (const extract::Face& face : part.faces) {
    part.geometry.push_back(extract::face_geometry(job.geometry, face.triangle, job.velocity));
  }
  return part;
}

Json summary(const Job& job, const std::filesystem::path& job_path, const extract::Report& report,
             const std::vector<Part>& parts, const std::vector<bool>& reused, double total_seconds) {
  std::vector<extract::Face> faces;
  std::vector<extract::FaceStatistics> statistics;
  Json files = Json::array();
  std::int64_t voxels = 0;
  for (std::size_t n = 0; n < parts.size(); ++n) {
    const Part& part = parts[n];
    faces.insert(faces.end(), part.faces.begin(), part.faces.end());
    statistics.insert(statistics.end(), part.statistics.begin(), part.statistics.end());
    for (const extract::FaceStatistics& face : part.statistics) voxels += face.count + face.nulls;
    files.push_back({{"fault", part.fault},
                     {"name", job.faults[n].name},
                     {"file", part_path({}, part.fault).string()},
                     {"faces", part.faces.size()},
                     {"reused", static_cast<bool>(reused[n])}});
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
          {"checksum", to_hex(extract::checksum_of(faces, statistics))},
          {"seconds",
           {{"read", report.seconds.read},
            {"voxelize", report.seconds.voxelize},
            {"exchange", report.seconds.exchange},
            {"compute", report.seconds.compute},
            {"total", total_seconds}}},
          {"volume", {{"path", job.volume.string()}, {"checksum", job.volume_checksum}}},
          {"parts", files}};
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) throw io_error("make the folder", folder.string(), failure.value());
  std::filesystem::remove(folder / "result.json", failure);
  if (failure) throw io_error("remove", (folder / "result.json").string(), failure.value());
}

}  // namespace

void run_batch(const comm::Communicator& world, const std::filesystem::path& job_path,
               const JobContext& context) {
  const double start = omp_get_wtime();
  const bool root = world.rank() == 0;

  // 1 Read the job; look at the volume.
  Job job = shared_job(world, job_path);
  world.collectively([&] { extract::validate(job.options); });
  // The reader throws on all ranks or on none, so that it may stand inside collectively().
  auto reader = world.collectively([&] { return volume::ParallelVolumeReader(world.get(), job.volume); });
  world.collectively([&] { check_volume(reader.info(), job); });

  // 2 Which faults are done already?
  std::vector<std::optional<Part>> parts = world.collectively([&] {
    if (!root) return std::vector<std::optional<Part>>(job.faults.size());
    make_folder(job.output);
    return earlier_parts(job);
  });
  comm::Bytes done(job.faults.size());
  for (std::size_t n = 0; n < done.size(); ++n)
    done[n] = static_cast<std::byte>(parts[n].has_value() ? 1 : 0);
  done = world.broadcast(std::move(done), 0);

  // 3 EXTRACT-ALL over the others.
  std::vector<extract::Face> faces;
  std::vector<bool> reused;
  for (std::size_t n = 0; n < done.size(); ++n) {
    reused.push_back(done[n] != std::byte{0});
    if (!reused[n]) faces.insert(faces.end(), job.faults[n].faces.begin(), job.faults[n].faces.end());
  }
  extract::Result result;
  result.report.exchange = job.options.exchange == "auto" ? "reduce" : job.options.exchange;
  result.report.balance = job.options.balance;
  result.report.ranks = world.size();
  result.report.threads = job.options.threads;
  if (!faces.empty()) {
    const extract::Input input{reader.info().dims, reader.info().statistics.max_abs, faces};
    const auto read = [&](const survey::Box& box, std::span<float> values) {
      reader.read_collective(box, values);
    };
    result = extract::extract_all(world, input, job.options, read, context.part(0, 0.9));
  }

  // 4 One part file for each fault, then the summary. Rank 0 has all results and writes them.
  world.collectively([&] {
    if (!root) return;
    std::vector<Part> whole;
    std::size_t next = 0;
    for (std::size_t n = 0; n < job.faults.size(); ++n) {
      context.report(0.9 + 0.1 * static_cast<double>(n) / static_cast<double>(job.faults.size()), "write",
                     fmt::format("{} of {} faults", n, job.faults.size()));
      const JobFault& fault = job.faults[n];
      if (reused[n]) {
        whole.push_back(std::move(*parts[n]));
        continue;
      }
      whole.push_back(new_part(job, fault, std::span(result.faces).subspan(next, fault.faces.size())));
      next += fault.faces.size();
      write_part(whole.back(), part_path(job.output, fault.id));
    }
    const Json json = summary(job, job_path, result.report, whole, reused, omp_get_wtime() - start);
    write_whole_file(job.output / "result.json", json.dump(1) + "\n");
    context.report(1, "write", "done");
  });
}

}  // namespace footwall::session
