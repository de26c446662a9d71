#include "engine/tasks/make_attribute.h"

#include <nlohmann/json.hpp>

#include "engine/session/attribute.h"
#include "engine/session/private_folder.h"
#include "engine/tasks/add_volume.h"
#include "engine/tasks/job_home.h"
#include "engine/tasks/open_volume.h"
#include "storage/base/partial_file.h"

namespace footwall::tasks {

MadeAttribute make_attribute(project::Project& project, const AttributeOptions& options,
                             const JobContext& context) {
  const project::VolumeRecord of = present_volume(project, options.volume);
  const std::string name = options.name.empty() ? of.name + " discontinuity" : options.name;
  check_free_name(project, name);
  const session::PrivateFolder folder(home_of_job(project));
  session::AttributeJob job;
  job.volume = std::filesystem::absolute(project.volume_path(of));
  job.output = std::filesystem::absolute(free_volume_path(project, name));
  job.result = folder.path() / "result.json";
  job.window = options.window;
  const std::filesystem::path job_file = folder.path() / "ATTRIBUTE.json";
  session::write_attribute_job(job, job_file);
  try {
    const std::string result = session::run_engine(
        options.launch, {{"attribute", job_file.string()}, job.result}, context.part(0, 0.98));
    const nlohmann::json json = nlohmann::json::parse(result);
    return {list_volume(project, name, job.output), of.name, json.at("ranks").get<int>(),
            json.at("seconds").get<double>()};
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(job.output, ignored);  // not listed, so not kept
    remove_partial_files_of(job.output);           // of an engine that was killed
    throw;
  }
}

}  // namespace footwall::tasks
