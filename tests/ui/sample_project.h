// Small synthetic projects for the editor's tests, each in a folder that goes with it.
#pragma once
#include <QTemporaryDir>
#include <filesystem>

#include "engine/tasks/new_project.h"
#include "storage/project/project.h"

namespace footwall::ui {

class SampleProject {
 public:
  // kind: of `footwall new --synthetic`.
  explicit SampleProject(const std::string& kind = "faulted", const survey::Index& size = {48, 40, 64})
      : path_(std::filesystem::path(folder_.path().toStdString()) / "sample.footwall") {
    tasks::new_synthetic_project(path_, kind, size, 1, 20, {});
  }
  const std::filesystem::path& path() const { return path_; }
  project::Project open(project::OpenMode mode = project::OpenMode::kWrite) const {
    return project::Project::open(path_, mode);
  }

 private:
  QTemporaryDir folder_;
  std::filesystem::path path_;
};

}  // namespace footwall::ui
