#include "engine/tasks/export_volume.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/tasks/open_volume.h"
#include "engine/tasks/section_plane.h"
#include "engine/tasks/triangulate.h"
#include "storage/base/error.h"
#include "storage/formats/nrrd.h"
#include "storage/formats/vti.h"

namespace footwall::tasks {
namespace {

volume::VolumeReader opened(const project::Project& project, const std::string& name) {
  return open_volume(project, project.volume(name));
}

auto boxes_of(const volume::VolumeReader& reader) {
  return [&reader](const survey::Box& box, std::span<float> values) { reader.read(box, values); };
}

}  // namespace

std::int64_t export_raw(const project::Project& project, const std::string& volume,
                        const std::filesystem::path& file, const formats::raw::WriteOptions& options,
                        const JobContext& job) {
  const volume::VolumeReader reader = opened(project, volume);
  const volume::VolumeInfo& info = reader.info();
  const auto read = [&](const survey::Box& box, std::span<float> values) {
    reader.read(box, values);
    if (!info.null_value) return;
    for (float& value : values) {
      if (std::isnan(value)) value = *info.null_value;
    }
  };
  formats::raw::write(file, info.dims, read, info.chunk[static_cast<std::size_t>(options.order[0])], job,
                      options);
  return info.dims[0] * info.dims[1] * info.dims[2];
}

RawSection export_raw_section(const project::Project& project, const std::string& volume,
                              const std::string& words, const std::filesystem::path& file, bool big_endian,
                              const JobContext& job) {
  const project::VolumeRecord record = project.volume(volume);
  const SectionPlane plane = section_plane(words, required_survey(project, "a section"));
  const auto axis = static_cast<std::size_t>(plane.axis);
  const std::int64_t at = plane.index - record.origin[axis];
  if (at < 0 || at >= record.dims[axis]) {
    throw Error(ErrorCode::kInvalid, fmt::format("volume {} has no {}", record.name, words),
                fmt::format("it covers {} planes of the survey from number {} on", record.dims[axis],
                            record.origin[axis] + 1));
  }
  const volume::VolumeReader reader = open_volume(project, record);
  survey::Index dims = record.dims;
  dims[axis] = 1;
  formats::raw::WriteOptions how;
  how.big_endian = big_endian;
  const auto read = [&](survey::Box box, std::span<float> values) {
    box.lo[axis] += at;
    box.hi[axis] += at;
    reader.read(box, values);
  };
  formats::raw::write(file, dims, read, reader.info().chunk[0], job, how);
  RawSection done{plane.axis, plane.index, {}};
  for (std::size_t a = 0, n = 0; a < 3; ++a) {
    if (a != axis) done.dims[n++] = dims[a];
  }
  return done;
}

void export_nrrd(const project::Project& project, const std::string& volume,
                 const std::filesystem::path& file, const formats::raw::AxisOrder& order,
                 const JobContext& job) {
  const volume::VolumeReader reader = opened(project, volume);
  formats::nrrd::write(file, reader.info().geometry, order, project.volume(volume).name, boxes_of(reader),
                       job);
}

void export_vti(const project::Project& project, const std::string& volume, const std::filesystem::path& file,
                bool z_up, const JobContext& job) {
  const volume::VolumeReader reader = opened(project, volume);
  formats::vti::write(file, reader.info().geometry, boxes_of(reader), {project.volume(volume).name, z_up},
                      job);
}

formats::segy::Written export_segy(const project::Project& project, const std::string& volume,
                                   const std::filesystem::path& file, const SegyExport& options,
                                   const JobContext& job) {
  const volume::VolumeReader reader = opened(project, volume);
  const volume::VolumeInfo& info = reader.info();
  formats::segy::WriteOptions how;
  how.format = options.format;
  how.holes = options.holes;
  how.null_value = options.null_value;
  how.title = project.volume(volume).name + " of " + project.path().filename().string();
  how.source = info.source;
  return formats::segy::write(file, info.geometry, reader.live_mask(), boxes_of(reader), info.chunk[0], how,
                              job);
}

}  // namespace footwall::tasks
