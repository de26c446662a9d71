// Puts a volume into a project: streams it into the volumes folder, then lists it. A failure or cancel leaves
// neither.
#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "storage/base/job_context.h"
#include "storage/project/project.h"
#include "storage/volume/volume_writer.h"

namespace footwall::tasks {

// Where a volume comes from; `fill` as volume::BlockSource says, and for any box inside the geometry, in any
// order: crop_volume.h and resample_volume.h ask for other boxes than the writer does.
struct VolumeSource {
  survey::Geometry geometry;
  volume::BlockSource fill;
  std::optional<float> null_value;
  volume::Role role = volume::Role::kAmplitude;
  bool high_is_fault = true;           // of a discontinuity: what high values mean
  std::string text;                    // in words, e.g. "SEG-Y f3.sgy"
  std::string provenance_json = "{}";  // how it was made
  // What only reading the samples can tell, in words, e.g. how many did not fit into a float32; may be empty.
  // For the caller, who tells the user once the volume is in.
  std::function<std::vector<std::string>()> notes_after_reading;
};

// The first volume gives a project without a survey its survey; later ones must lie on its grid.
// Throws kInvalid with the numbers where they do not, or where the name is taken; and what writing throws.
project::VolumeRecord add_volume(project::Project& project, const std::string& name,
                                 const VolumeSource& source, const JobContext& job);

// The same in three steps, where the project belongs to another thread than the long work. An unlisted file
// goes with its PlannedVolume.
class PlannedVolume {
 public:
  PlannedVolume(const PlannedVolume&) = delete;
  PlannedVolume& operator=(const PlannedVolume&) = delete;
  ~PlannedVolume();

 private:
  PlannedVolume() = default;
  friend std::unique_ptr<PlannedVolume> plan_volume(const project::Project&, const std::string&,
                                                    const survey::Geometry&);
  friend void write_planned(PlannedVolume&, const VolumeSource&, const JobContext&);
  friend project::VolumeRecord list_planned(project::Project&, PlannedVolume&, const VolumeSource&);
  std::string name_;
  std::filesystem::path path_;  // an empty file until it is written: nobody else takes the place
  std::optional<survey::Index> origin_;
  bool made_folder_ = false;
  bool listed_ = false;
};
// 1, the project's thread: checks name and geometry, and takes a place for the file. Throws as add_volume().
std::unique_ptr<PlannedVolume> plan_volume(const project::Project& project, const std::string& name,
                                           const survey::Geometry& geometry);
// 2, any thread, the long work. Throws what writing throws.
void write_planned(PlannedVolume& planned, const VolumeSource& source, const JobContext& job);
// 3, the project's thread: lists it. Throws as add_volume() where the project has changed since.
project::VolumeRecord list_planned(project::Project& project, PlannedVolume& planned,
                                   const VolumeSource& source);

// Throws kInvalid where the project has a volume of that name, or no volume can be called so.
void check_free_name(const project::Project& project, const std::string& name);
// A path in the volumes folder, which is made if need be, at which no file stands yet. Throws kIo.
std::filesystem::path free_volume_path(const project::Project& project, const std::string& name);
// Lists a whole volume file that stands in the volumes folder already. Throws what opening it throws.
project::VolumeRecord list_volume(project::Project& project, const std::string& name,
                                  const std::filesystem::path& path);

// The index of part's first voxel in the survey. Throws kInvalid, with both numbers, where line numbers,
// steps, interval, domain or map differ, or where the part reaches outside.
survey::Index origin_in(const survey::Geometry& survey, const survey::Geometry& part);

}  // namespace footwall::tasks
