// A scripted workload of mesh operations and EXTRACT-ALLs as a value and as a text file (docs/workloads.md).
// Based on: seed 004, appendix B.1; its scripts hold the same, in a format of their own.
#pragma once
#include <iosfwd>
#include <string_view>
#include <vector>

#include "engine/mesh/operation.h"
#include "storage/survey/box.h"

namespace footwall::tasks {

// Operations, and whether EXTRACT-ALL follows them.
struct WorkloadStep {
  std::vector<mesh::Operation> operations;
  bool extract = false;
  friend bool operator==(const WorkloadStep&, const WorkloadStep&) = default;
};

// What is done once, from empty to empty if the script is well made; only mesh ids are counted on.
struct WorkloadRepeat {
  std::vector<WorkloadStep> steps;
  friend bool operator==(const WorkloadRepeat&, const WorkloadRepeat&) = default;
};

struct Workload {
  survey::Index size{0, 0, 0};  // of the survey, in voxels
  std::vector<WorkloadRepeat> repeats;
  friend bool operator==(const Workload&, const Workload&) = default;
};

struct OperationCounts {
  std::int64_t create_mesh = 0;
  std::int64_t destroy_mesh = 0;
  std::int64_t add_face = 0;
  std::int64_t remove_faces = 0;
  std::int64_t remove_face = 0;
  std::int64_t move_vertex = 0;
  std::int64_t split_edge = 0;
  std::int64_t extract_all = 0;
  // As the seed counts: each mesh is created with a face.
  std::int64_t adds() const { return create_mesh + add_face; }
};
void add_counts(const WorkloadRepeat& repeat, OperationCounts& counts);
OperationCounts counts_of(const Workload& workload);

// The lines of the file, in order. `title` is a comment of the first lines, may have several.
void write_script_head(const survey::Index& size, std::string_view title, std::ostream& out);
void write_script_repeat(std::ostream& out);  // before the steps of each repeat
void write_script_step(const WorkloadStep& step, std::ostream& out);

// Throws Error kFormat with "line N: " before what is not understood. Whether the operations fit each other
// is seen when they are run.
Workload parse_script(std::string_view text);

}  // namespace footwall::tasks
