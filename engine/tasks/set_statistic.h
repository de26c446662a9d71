// Numbers of the user for each face, kept as a run of their own: no volume, one statistic.
#pragma once
#include <iosfwd>
#include <string>

#include "storage/project/project.h"

namespace footwall::tasks {

struct SetStatistic {
  std::string name;        // of the statistic
  std::string unit = "1";  // recorded; "1": none
  std::string run;         // its name; empty: that of the statistic
};

struct StatisticSet {
  std::int64_t run = 0;
  std::string run_name;
  std::int64_t faces = 0;      // with a number
  std::int64_t undefined = 0;  // of the faces that are there, those without
  bool replaced = false;       // a former run of this name and statistic
};

// Reads the numbers as formats::face_values_csv says. The faces are those of the present meshes; a fault
// column is needed only for names that several faults have. Faces without a number are undefined. A former
// run of this statistic and run name that was set by hand is replaced. Outside undo, like every run. Throws
// kInvalid for a name that the program's own statistics or columns have, for a unit other than the one that
// other runs of this statistic were set in, and for faces that are not there or stand twice, by name and
// number; what face_values_csv throws. Nothing is changed then.
StatisticSet set_statistic(project::Project& project, const SetStatistic& what, std::istream& values);

// The statistic that a run was set for by hand; empty for a run that was computed.
std::string statistic_set_by_hand(const project::RunRecord& run);

}  // namespace footwall::tasks
