// Pillars of a project as fault sticks in a file.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "storage/formats/sticks.h"
#include "storage/project/project.h"

namespace footwall::tasks {

struct SticksChoice {
  std::string fault;                  // empty: all
  bool interpolated = false;          // the interpolated pillars too, not the picked and snapped ones alone
  std::optional<bool> z_positive_up;  // unset: down
  std::string z_unit;                 // "ms", "s", "m", "ft"; empty: the survey's vertical unit
  bool names_without_blanks = false;
};

// The pillars as sticks, fault by fault in the order of faults and pillars, z in the chosen unit and still
// positive down; and how they are to be written. Throws kNotFound for a fault that is not there, kUsage for a
// unit that the survey's cannot be turned into, and for any where there is no survey.
struct ProjectSticks {
  std::vector<formats::Stick> sticks;
  formats::SticksWriteOptions how;
};
ProjectSticks project_sticks(const project::Project& project, const SticksChoice& choice);

struct SticksExported {
  std::int64_t faults = 0, pillars = 0, nodes = 0;
  std::vector<std::string> renamed;  // "old -> new", names that the format cannot hold
};
// format: a name of formats::stick_formats(). Throws kInvalid where there are no pillars, and what
// project_sticks() and formats::write_sticks() throw.
SticksExported export_sticks(const project::Project& project, const std::filesystem::path& file,
                             const std::string& format, const SticksChoice& choice);

}  // namespace footwall::tasks
