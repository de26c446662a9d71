// Fault sticks as plain values: what every reader of sticks makes and every writer takes.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "storage/formats/import_report.h"
#include "storage/survey/geometry.h"
#include "storage/survey/points.h"

namespace footwall::formats {

struct Stick {
  std::string fault;
  std::int64_t number = 0;  // as the file numbers it
  std::vector<survey::WorldPoint> points;
  // True: x and y of the points are inline and crossline numbers (the file has no X and Y); whoever knows the
  // survey turns them into X and Y.
  bool in_line_numbers = false;
};

// Columns of a table of points for the generic mapper; from 1, 0 = not there. X and Y, or inline and
// crossline, and z are needed.
struct ColumnMap {
  int name = 0, stick = 0, node = 0, x = 0, y = 0, z = 0, inline_number = 0, crossline_number = 0;
  int header_rows = 0;  // rows to skip before the first
  char delimiter = 0;   // 0 = told from the content: tab, semicolon, comma, else blanks
};

struct SticksOptions {
  bool z_positive_up = false;  // the file's z is elevation: its sign is turned
  double z_factor = 1;         // file z times this is z in the survey's vertical unit
  std::string fault{};         // name of the fault where the file has no names; readers of paths put the
                               // file's stem here if it is empty
  std::optional<ColumnMap> columns{};  // for format "columns"
  std::string layout{};                // text of the format file that a column file needs (Landmark)
  // Half a step between lines and samples, in X/Y and z units, for files that neither number their sticks nor
  // part them by blank lines: a stick ends where the plane (inline, crossline or z) of its first knot is
  // left.
  std::optional<survey::Geometry> survey{};
};

struct SticksImport {
  std::vector<Stick> sticks{};
  ImportReport report{};
};

// What writers need to know beside the sticks. Points come with z positive down in vertical_unit.
struct SticksWriteOptions {
  bool z_positive_up = false;
  std::string horizontal_unit = "m";
  std::string vertical_unit = "m";           // of the z written: "ms", "s", "m", "ft"; told, not converted
  std::optional<survey::Geometry> survey{};  // for formats that state inline and crossline
};

}  // namespace footwall::formats
