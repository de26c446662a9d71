// Interpretation by text: one JSON object per line, each line one undoable edit.
//
//   {"op":"add","what":"fault","name":"F1"}                               -> {"fault":1,"step":1}
//   {"op":"add","what":"pillar","fault":"F1","nodes":[P, P, ...]}         ->
//   {"pillar":3,"nodes":[7,8],"step":2}
//   {"op":"add","what":"node","pillar":3,"at":1,P}                        -> {"node":9,"step":3}   (at:
//   default last)
//   {"op":"move","what":"node","node":7,P}
//   {"op":"move","what":"pillar","pillar":3,"dx":1,"dy":0,"dz":-4}        world units, z positive down; each
//   default 0
//   {"op":"move","what":"fault","fault":"F1","dx":..,"dy":..,"dz":..}     interpolated pillars follow the
//   others
//   {"op":"rename","what":"fault","fault":"F1","name":"F2"}
//   {"op":"set","what":"fault","fault":"F1","property":"colour","value":"#00ff00"}   as set_fault_property
//   has them
//   {"op":"accept","what":"pillar","pillar":4}                            an interpolated pillar becomes
//   interpreted
//   {"op":"delete","what":"fault","fault":"F1"} | {...,"pillar","pillar":3} | {...,"node","node":7}
//
// A position P is "x","y","z" or "inline","crossline","z" (line numbers, may be broken; the project needs a
// survey), or "position":[x,y,z]; in "nodes" an object of the first two kinds or an array [x,y,z]. X, Y in
// the survey's CRS, z in its vertical unit. Faults are named by id or name; "id" stands for the thing's own
// id, "name" for the fault's where nothing else is named. "op":"add_fault" or "add fault" is short for op and
// what. Every other field is refused. Replies carry the ids, the step of the log ("step", 0 when nothing
// differed) and, where there are any, "regenerated" and "removed" interpolated pillars.
#pragma once
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string_view>

#include "storage/base/job_context.h"
#include "storage/project/project.h"

namespace footwall::tasks {

// Throws Error with "line N: " before the message: kInvalid for what is not understood, and what the edit
// throws; nothing of the line is then applied.
nlohmann::json apply_edit_line(project::Project& project, std::string_view line, std::int64_t line_number);

// Every line of `script` but empty ones and those that start with #; stops at the first that fails, the lines
// before it stay applied. `reply` is called after each. Returns the number of lines applied. A cancel stops
// it between two lines (kCancelled).
std::int64_t apply_edit_script(project::Project& project, std::istream& script,
                               const std::function<void(const nlohmann::json&)>& reply,
                               const JobContext& job = {});

// The same with the lines applied by somebody else, who throws what apply_edit_line() throws.
using ApplyLine = std::function<nlohmann::json(std::string_view line, std::int64_t line_number)>;
std::int64_t apply_edit_script(const ApplyLine& apply, std::istream& script,
                               const std::function<void(const nlohmann::json&)>& reply,
                               const JobContext& job = {});

}  // namespace footwall::tasks
