#include "engine/session/job.h"

#include <nlohmann/json.hpp>

#include "engine/session/faces_file.h"
#include "storage/base/error.h"
#include "storage/base/hash.h"
#include "storage/base/partial_file.h"
#include "storage/survey/geometry_json.h"

namespace footwall::session {
namespace {

using Json = nlohmann::json;

constexpr int kVersion = 1;
constexpr std::size_t kJsonLimit = std::size_t{64} << 20;
constexpr std::size_t kFacesLimit = std::size_t{16} << 30;

Error bad(const std::string& what) {
  return Error(ErrorCode::kFormat, "JOB.json: " + what, "write the job again");
}

Json optional_number(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json parsed(const std::string& text) {
  Json json;
  try {
    json = Json::parse(text);
  } catch (const Json::exception& error) {
    throw bad(error.what());
  }
  if (!json.is_object() || !json.contains("footwall_job")) throw bad("this is not a job of Footwall");
  const Json& version = json["footwall_job"];
  if (!version.is_number_integer() || version.get<std::int64_t>() != kVersion) {
    throw Error(ErrorCode::kUnsupported,
                "the job has version " + version.dump() + ", this program reads version 1",
                "use the same version of footwall to write and to run it");
  }
  return json;
}

std::filesystem::path beside(const std::filesystem::path& folder, const Json& name) {
  return (folder / name.get<std::string>()).lexically_normal();
}

// The job without its faces; counts gets how many faces each fault has.
Job header_from_json(const Json& json, const std::filesystem::path& folder,
                     std::vector<std::size_t>& counts) {
  Job job;
  job.volume = beside(folder, json.at("volume").at("path"));
  json.at("volume").at("checksum").get_to(job.volume_checksum);
  if (!job.volume_checksum.empty()) hash_from_hex(job.volume_checksum);
  json.at("volume").at("name").get_to(job.volume_name);
  json.at("volume").at("origin").get_to(job.volume_origin);
  job.geometry = survey::geometry_from_json(json.at("geometry"));
  for (const Json& fault : json.at("faults")) {
    job.faults.push_back({fault.at("id").get<std::int64_t>(),
                          fault.at("name").get<std::string>(),
                          {},
                          fault.at("revision").get<std::int64_t>()});
    if (job.faults.back().name.empty()) throw bad("a fault has no name");
    counts.push_back(fault.at("faces").get<std::size_t>());
  }
  const Json& options = json.at("options");
  options.at("exchange").get_to(job.options.exchange);
  options.at("balance").get_to(job.options.balance);
  options.at("voxelizer").get_to(job.options.voxelizer);
  options.at("threads").get_to(job.options.threads);
  job.options.pillars = options.value("pillars", job.options.pillars);
  job.options.cache_bytes = options.value("cache", job.options.cache_bytes);
  options.at("compute").get_to(job.options.compute);
  job.options.snr = options.value("snr", job.options.snr);
  job.options.lot_order = options.value("lot_order", job.options.lot_order);
  job.options.filter = options.value("filter", job.options.filter);
  if (!options.at("velocity").is_null()) job.velocity = options.at("velocity").get<double>();
  if (job.velocity && !(*job.velocity > 0)) throw bad("the velocity must be positive");
  job.output = beside(folder, json.at("output"));
  json.at("run").get_to(job.run);
  return job;
}

}  // namespace

void write_job(const Job& job, const std::filesystem::path& path) {
  std::vector<extract::Face> faces;
  Json faults = Json::array();
  for (const JobFault& fault : job.faults) {
    faults.push_back({{"id", fault.id},
                      {"name", fault.name},
                      {"revision", fault.revision},
                      {"faces", fault.faces.size()}});
    for (const extract::Face& face : fault.faces) {
      if (face.fault != fault.id) {
        throw Error(ErrorCode::kInvalid, "a face of fault " + std::to_string(face.fault) +
                                             " stands under fault '" + fault.name + "'");
      }
      faces.push_back(face);
    }
  }
  const std::string bytes = faces_to_bytes(faces);
  std::filesystem::path faces_path = path;
  faces_path.replace_extension(".faces");
  const Json json{{"footwall_job", kVersion},
                  {"volume",
                   {{"path", job.volume.string()},
                    {"checksum", job.volume_checksum},
                    {"name", job.volume_name},
                    {"origin", job.volume_origin}}},
                  {"geometry", survey::geometry_to_json(job.geometry)},
                  {"faces",
                   {{"path", faces_path.filename().string()},
                    {"count", faces.size()},
                    {"hash", to_hex(hash64(std::as_bytes(std::span(bytes))))}}},
                  {"faults", faults},
                  {"options",
                   {{"exchange", job.options.exchange},
                    {"balance", job.options.balance},
                    {"voxelizer", job.options.voxelizer},
                    {"threads", job.options.threads},
                    {"pillars", job.options.pillars},
                    {"cache", job.options.cache_bytes},
                    {"compute", job.options.compute},
                    {"velocity", optional_number(job.velocity)},
                    {"snr", job.options.snr},
                    {"lot_order", job.options.lot_order},
                    {"filter", job.options.filter}}},
                  {"output", job.output.string()},
                  {"run", job.run}};
  std::string text;
  try {
    text = json.dump(1) + "\n";
  } catch (const Json::exception&) {
    throw Error(ErrorCode::kUnsupported,
                "a job cannot name the path " + job.volume.string() + ": it is not UTF-8", "rename it");
  }
  write_whole_file(faces_path, bytes);
  write_whole_file(path, text);
}

JobFiles read_job_files(const std::filesystem::path& path) {
  JobFiles files;
  files.json = read_whole_file(path, kJsonLimit);
  const Json json = parsed(files.json);
  try {
    files.faces = read_whole_file(
        beside(std::filesystem::absolute(path).parent_path(), json.at("faces").at("path")), kFacesLimit);
  } catch (const Json::exception& error) {
    throw bad(error.what());
  }
  return files;
}

Job parse_job(const JobFiles& files, const std::filesystem::path& folder) {
  const Json json = parsed(files.json);
  try {
    std::vector<std::size_t> counts;
    Job job = header_from_json(json, folder, counts);
    if (hash64(std::as_bytes(std::span(files.faces))) != hash_from_hex(json.at("faces").at("hash"))) {
      throw Error(ErrorCode::kCorrupt, "the faces beside JOB.json are not those that it was written with",
                  "write the job again");
    }
    const std::vector<extract::Face> faces = faces_from_bytes(files.faces);
    std::size_t next = 0;
    for (std::size_t n = 0; n < counts.size(); ++n) {
      JobFault& fault = job.faults[n];
      if (counts[n] > faces.size() - next) throw bad("more faces are listed than there are");
      const auto first = faces.begin() + static_cast<std::ptrdiff_t>(next);
      fault.faces.assign(first, first + static_cast<std::ptrdiff_t>(counts[n]));
      next += counts[n];
      for (const extract::Face& face : fault.faces) {
        if (face.fault != fault.id) throw bad("a face is not of the fault that it is listed under");
      }
      for (std::size_t other = 0; other < n; ++other) {
        if (job.faults[other].id == fault.id)
          throw bad("fault " + std::to_string(fault.id) + " is listed twice");
      }
    }
    if (next != faces.size()) throw bad("there are more faces than are listed");
    return job;
  } catch (const Json::exception& error) {
    throw bad(error.what());
  }
}

Job read_job(const std::filesystem::path& path) {
  return parse_job(read_job_files(path), std::filesystem::absolute(path).parent_path());
}

std::filesystem::path output_of(const std::filesystem::path& job_path) {
  const Json json = parsed(read_whole_file(job_path, kJsonLimit));
  try {
    return beside(std::filesystem::absolute(job_path).parent_path(), json.at("output"));
  } catch (const Json::exception& error) {
    throw bad(error.what());
  }
}

std::uint64_t part_hash(const Job& job, const JobFault& fault) {
  survey::Geometry geometry = job.geometry;
  geometry.crs.clear();
  geometry.assumed.clear();
  const Json settings{{"version", kVersion},
                      {"volume", job.volume_checksum},
                      {"geometry", survey::geometry_to_json(geometry)},
                      {"voxelizer", job.options.voxelizer},
                      {"compute", job.options.compute},
                      {"velocity", optional_number(job.velocity)},
                      {"snr", job.options.snr},
                      {"lot_order", job.options.lot_order},
                      {"filter", job.options.filter}};
  Hasher hasher;
  for (const std::string& bytes : {settings.dump(), faces_to_bytes(fault.faces)}) {
    hasher.add(std::as_bytes(std::span(bytes)));
  }
  return hasher.value();
}

std::uint64_t job_hash(const Job& job) {
  std::vector<std::uint64_t> hashes;
  for (const JobFault& fault : job.faults) hashes.push_back(part_hash(job, fault));
  return hash64(std::as_bytes(std::span(hashes)));
}

}  // namespace footwall::session
