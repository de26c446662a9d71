// What tasks that ask the engine for only what can be seen have in common.
#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "engine/render/fault_picture.h"
#include "engine/session/visible_choice.h"
#include "storage/base/job_context.h"

namespace footwall::tasks {

// PNG files of a picture after each pass: FOLDER/pass-001.png and so on. Files of other names, or of more
// passes that were made before, are left alone.
class PassImages {
 public:
  // Makes the folder where it is not there; empty: no pictures are wanted. Throws Error kUsage for a file of
  // that name, kIo.
  explicit PassImages(std::filesystem::path folder);

  bool are_wanted() const { return !folder_.empty(); }
  // The engine drew `count` layers, kSamples times as large as the picture, for choice.pass_layer(1) and so
  // on. Throws what reading, drawing and writing throws.
  void write(const session::VisibleChoice& choice, int count, const render::Composition& made, int width,
             int height, int threads, const JobContext& job);
  const std::vector<std::string>& paths() const { return paths_; }

 private:
  std::filesystem::path folder_;
  std::vector<std::string> paths_;
};

// The report of one isosurface (session/visible_choice.h) counts uncovered samples, of which a picture has
// kSamples x kSamples a pixel: as pixels, rounded up.
void count_pixels(nlohmann::json& report);

// Empty, or what ended the passes over `name`, and how much is left to be seen. report: after count_pixels().
std::string end_notice(const std::string& name, const session::VisibleChoice& choice,
                       const nlohmann::json& report);

}  // namespace footwall::tasks
