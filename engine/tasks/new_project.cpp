#include "engine/tasks/new_project.h"

#include "engine/synthetic/registry.h"
#include "storage/base/error.h"
#include "storage/project/fault_colours.h"

namespace footwall::tasks {
namespace {

namespace fs = std::filesystem;

// Removes a project that was being made unless it became whole. Declared before the project, so that it is
// closed by then.
class Unfinished {
 public:
  ~Unfinished() {
    if (path_.empty()) return;
    std::error_code ignored;  // what cannot be removed is at worst an empty project
    for (const char* ending : {"", "-wal", "-shm", "-journal", ".lock"})
      fs::remove(path_.string() + ending, ignored);
  }
  Unfinished() = default;
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;
  void remove_at_end(const fs::path& path) { path_ = path; }
  void keep() { path_.clear(); }

 private:
  fs::path path_;
};

template <class Fill>
project::VolumeRecord made(const fs::path& path, Fill&& fill) {
  Unfinished unfinished;
  project::Project project = project::Project::create(path, std::nullopt);
  unfinished.remove_at_end(path);
  project::VolumeRecord record = fill(project);
  project.close();
  unfinished.keep();
  return record;
}

void add_faults(project::Project& project, const synthetic::FaultedSurvey& survey) {
  project::FaultColours colours(project.faults());
  for (const synthetic::Fault& fault : survey.faults()) {
    project.edit("Pick fault " + fault.name, [&](project::Interpretation& picks) {
      const std::int64_t id = picks.add_fault(fault.name);
      picks.set_fault_property(id, "colour", colours.next());
      for (const survey::Pillar& pillar : fault.pillars) picks.add_pillar(id, pillar);
    });
    project.add_truth(fault.truth, "fault");
  }
}

}  // namespace

void new_empty_project(const fs::path& path) {
  project::Project::create(path, std::nullopt).close();
}

project::VolumeRecord new_project(const fs::path& path, const std::string& volume_name,
                                  const VolumeSource& source, const JobContext& job) {
  return made(path, [&](project::Project& project) { return add_volume(project, volume_name, source, job); });
}

project::VolumeRecord new_synthetic_project(const fs::path& path, const std::string& kind,
                                            const survey::Index& size, std::uint64_t seed,
                                            double signal_to_noise, const JobContext& job) {
  synthetic::Options options;
  options.size = size;
  options.seed = seed;
  options.signal_to_noise = signal_to_noise;
  const synthetic::FaultedSurvey survey = synthetic::make_survey(kind, options);
  return made(path, [&](project::Project& project) {
    project::VolumeRecord record = add_volume(project, "amplitude", synthetic_source(survey, kind), job);
    add_faults(project, survey);
    return record;
  });
}

}  // namespace footwall::tasks
