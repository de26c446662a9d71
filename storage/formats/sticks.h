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
  char delimiter = 0;   // 0 = told from the content: tab, semicolon, comma, else blanks; ' ' = runs of blanks
};

struct SticksOptions {
  // z as it is told, over what the file says of itself; unset: what the file says, or else positive down and
  // in the survey's unit, which the report then lists as assumed.
  std::optional<bool> z_positive_up{};  // true: z is elevation, and its sign is turned
  std::string z_unit{};                 // "ms", "s", "m", "ft"; empty: not told
  std::string vertical_unit{};          // the survey's, "ms", "m", "ft"; empty: no survey, z is not converted
  std::string fault{};  // name of the fault where the file has no names; readers of paths put the
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
  std::vector<std::string> notices{};  // what the user should look at, e.g. X/Y that contradict the lines
  std::string format{};                // StickFormat::name; readers of one format leave it empty
};

// What writers need to know beside the sticks. Points come with z positive down in vertical_unit.
struct SticksWriteOptions {
  bool z_positive_up = false;         // turn the sign of z
  bool names_without_blanks = false;  // write blanks in names as '_', for programs that split rows at blanks
  std::string horizontal_unit = "m";
  std::string vertical_unit = "m";  // of the z written: "ms", "s", "m", "ft"; empty: not known (no survey)
  std::optional<survey::Geometry> survey{};  // for formats that state inline and crossline
};

}  // namespace footwall::formats
