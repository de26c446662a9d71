// A SEG-Y file into a project, as a job.
#pragma once
#include <filesystem>
#include <functional>
#include <string>

#include "storage/formats/segy/segy_file.h"
#include "ui/model/workbench.h"

namespace footwall::ui {

// Into the open project: written and listed on the job's thread; the volume is the one shown where there was
// none. geometry: what a look at the file found; the job refuses a file that has changed since. Returns the
// job's number. Throws what tasks::plan_volume() throws; later failures come as Jobs::finished.
int import_segy(Workbench& workbench, const std::filesystem::path& file,
                const formats::segy::Options& options, const survey::Geometry& geometry,
                const std::string& name, std::function<void(Id)> done = {});

// Into a new project, made whole or not at all; done: in the window's thread.
int import_segy_anew(Jobs& jobs, const std::filesystem::path& project, const std::filesystem::path& file,
                     const formats::segy::Options& options, const std::string& name,
                     std::function<void()> done);

}  // namespace footwall::ui
