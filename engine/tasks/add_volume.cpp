#include "engine/tasks/add_volume.h"

#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <fstream>

#include "storage/base/error.h"
#include "storage/base/hash.h"
#include "storage/volume/volume_reader.h"

namespace footwall::tasks {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void mismatch(const std::string& what) {
  throw Error(ErrorCode::kInvalid, "the volume does not fit the project's survey: " + what,
              "--resample survey brings it onto the survey's grid; or import it into a project of its own");
}

std::int64_t line_offset(std::string_view name, const survey::LineAxis& whole, const survey::LineAxis& part) {
  if (part.count > 1 && part.step != whole.step) {
    mismatch(fmt::format("{} step {}, the survey has {}", name, part.step, whole.step));
  }
  if ((part.first - whole.first) % whole.step != 0 || part.first < whole.first ||
      part.last() > whole.last()) {
    mismatch(fmt::format("{} {} to {}, the survey has {} to {} by {}", name, part.first, part.last(),
                         whole.first, whole.last(), whole.step));
  }
  return whole.index_of(part.first);
}

// How far, in voxels, the two maps put the part's corners apart.
double map_distance(const survey::Geometry& whole, const survey::Geometry& part,
                    const survey::Index& origin) {
  double worst = 0;
  for (const double i : {0.0, static_cast<double>(part.inlines.count - 1)}) {
    for (const double j : {0.0, static_cast<double>(part.crosslines.count - 1)}) {
      const survey::IndexPoint at = whole.index_of(part.world_of({i, j, 0}));
      worst = std::max({worst, std::abs(at.i - i - static_cast<double>(origin[0])),
                        std::abs(at.j - j - static_cast<double>(origin[1]))});
    }
  }
  return worst;
}

// A file name that any file system takes, made from the user's name for the volume.
std::string file_stem(const std::string& name) {
  std::string stem;
  for (const char c : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' || c == '.';
    stem += plain ? c : '_';
  }
  if (stem.empty() || stem.front() == '.') stem.insert(0, "volume");
  return stem.substr(0, 100);
}

fs::path free_path(const fs::path& folder, const std::string& name) {
  fs::path path = folder / (file_stem(name) + ".h5");
  for (int n = 2; fs::exists(path); ++n) path = folder / fmt::format("{}-{}.h5", file_stem(name), n);
  return path;
}

project::VolumeRecord record_of(const volume::VolumeInfo& info) {
  project::VolumeRecord record;
  record.dims = info.dims;
  record.origin = info.origin;
  record.bytes = info.bytes;
  record.checksum = to_hex(info.checksum);
  record.min = info.statistics.min;
  record.max = info.statistics.max;
  record.mean = info.statistics.mean;
  record.stddev = info.statistics.stddev;
  record.max_abs = info.statistics.max_abs;
  record.null_count = info.statistics.null_count;
  record.live_traces = info.statistics.live_traces;
  if (info.null_value) record.null_value = *info.null_value;
  record.role = name_of(info.role);
  record.source = info.source;
  record.provenance = info.provenance_json;
  return record;
}

}  // namespace

survey::Index origin_in(const survey::Geometry& survey, const survey::Geometry& part) {
  if (survey.domain != part.domain || survey.vertical_unit != part.vertical_unit) {
    mismatch(fmt::format("{} in {}, the survey is {} in {}", name_of(part.domain),
                         name_of(part.vertical_unit), name_of(survey.domain), name_of(survey.vertical_unit)));
  }
  if (std::abs(part.interval - survey.interval) > 1e-9 * survey.interval) {
    mismatch(fmt::format("sample interval {}, the survey has {}", part.interval, survey.interval));
  }
  const double first = (part.z0 - survey.z0) / survey.interval;
  const double sample = std::nearbyint(first);
  if (std::abs(first - sample) > 1e-3 || sample < 0 ||
      sample + static_cast<double>(part.samples) > static_cast<double>(survey.samples)) {
    mismatch(fmt::format("{} samples from {}, the survey has {} from {}", part.samples, part.z0,
                         survey.samples, survey.z0));
  }
  const survey::Index origin{line_offset("inlines", survey.inlines, part.inlines),
                             line_offset("crosslines", survey.crosslines, part.crosslines),
                             static_cast<std::int64_t>(sample)};
  if (const double apart = map_distance(survey, part, origin); apart > 0.05) {
    mismatch(fmt::format("its X and Y lie up to {:.2f} bins from the survey's for the same lines", apart));
  }
  return origin;
}

void check_free_name(const project::Project& project, const std::string& name) {
  project::check_name("volume", name);
  for (const project::VolumeRecord& other : project.volumes()) {
    if (other.name == name) {
      throw Error(ErrorCode::kInvalid, fmt::format("the project has a volume '{}' already", name),
                  "choose another --name");
    }
  }
}

fs::path free_volume_path(const project::Project& project, const std::string& name) {
  std::error_code failure;
  fs::create_directories(project.volumes_folder(), failure);
  if (failure) throw io_error("create", project.volumes_folder(), failure.value());
  return free_path(project.volumes_folder(), name);
}

project::VolumeRecord list_volume(project::Project& project, const std::string& name, const fs::path& path) {
  project::VolumeRecord record = record_of(volume::VolumeReader(path).info());
  record.name = name;
  record.file = project.relative_file(path);
  record.id = project.add_volume(record);
  return record;
}

PlannedVolume::~PlannedVolume() {
  if (listed_ || path_.empty()) return;
  std::error_code ignored;  // what cannot be removed is a file that nobody lists
  fs::remove(path_, ignored);
  if (made_folder_) fs::remove(path_.parent_path(), ignored);
}

std::unique_ptr<PlannedVolume> plan_volume(const project::Project& project, const std::string& name,
                                           const survey::Geometry& geometry) {
  check_free_name(project, name);  // before the long work, not after it
  geometry.validate();
  std::unique_ptr<PlannedVolume> planned(new PlannedVolume());
  planned->name_ = name;
  if (const auto survey = project.survey()) planned->origin_ = origin_in(*survey, geometry);

  std::error_code failure;
  planned->made_folder_ = fs::create_directories(project.volumes_folder(), failure);
  if (failure) throw io_error("create", project.volumes_folder(), failure.value());
  const fs::path path = free_path(project.volumes_folder(), name);
  if (!std::ofstream(path)) throw io_error("create", path, errno);
  planned->path_ = path;
  return planned;
}

void write_planned(PlannedVolume& planned, const VolumeSource& source, const JobContext& job) {
  volume::WriteOptions options;
  options.geometry = source.geometry;
  if (planned.origin_) options.origin = *planned.origin_;
  options.null_value = source.null_value;
  options.role = source.role;
  options.high_is_fault = source.high_is_fault;
  options.source = source.text;
  options.provenance_json = source.provenance_json;
  volume::write_volume(planned.path_, options, source.fill, job);
}

project::VolumeRecord list_planned(project::Project& project, PlannedVolume& planned,
                                   const VolumeSource& source) {
  check_free_name(project, planned.name_);
  const auto survey = project.survey();
  if (survey.has_value() != planned.origin_.has_value()) {
    throw Error(ErrorCode::kInvalid, "the project got a survey while the volume was written",
                "import it again");
  }
  if (!survey) project.set_survey(source.geometry, source.provenance_json);
  const project::VolumeRecord record = list_volume(project, planned.name_, planned.path_);
  planned.listed_ = true;
  return record;
}

project::VolumeRecord add_volume(project::Project& project, const std::string& name,
                                 const VolumeSource& source, const JobContext& job) {
  const std::unique_ptr<PlannedVolume> planned = plan_volume(project, name, source.geometry);
  write_planned(*planned, source, job);
  return list_planned(project, *planned, source);
}

}  // namespace footwall::tasks
