// Fault sticks: the format that the content tells, and one of the others.
#include "fuzz/target.h"
#include "storage/base/error.h"
#include "storage/formats/stick_formats.h"

namespace footwall::fuzz {
namespace {

bool sound(const formats::SticksImport& import) {
  std::int64_t points = 0;
  for (const formats::Stick& stick : import.sticks) {
    if (stick.points.empty()) return false;
    for (const survey::WorldPoint& point : stick.points) {
      if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z)) return false;
      ++points;
    }
  }
  return points == import.report.read && import.report.skipped >= 0 &&
         import.report.rejected_count >= static_cast<std::int64_t>(import.report.rejected.size());
}

bool parses(const formats::StickFormat& format, const std::string& bytes) {
  formats::SticksOptions options;
  options.fault = "F";
  options.columns = formats::ColumnMap{.x = 1, .y = 2, .z = 3};
  options.survey = survey::Geometry{};
  try {
    return sound(format.parse(bytes, options));
  } catch (const Error& error) {
    if (error.code() == ErrorCode::kInternal) throw;
    return true;
  }
}

bool run(const std::string& bytes) {
  const auto formats = formats::stick_formats();
  const formats::StickFormat* told = formats::recognise_sticks(bytes);
  if (told != nullptr && !parses(*told, bytes)) return false;
  return parses(formats[bytes.size() % formats.size()], bytes);
}

// Two sticks in every format that can be written.
std::vector<std::string> written() {
  std::vector<formats::Stick> sticks(2);
  for (int n = 0; n < 2; ++n) {
    sticks[static_cast<std::size_t>(n)] = {
        "Fault A", n + 1, {{500000.25 + n, 6700000.5, 100}, {500010, 6700020, 140.5}}};
  }
  formats::SticksWriteOptions options;
  options.survey = survey::Geometry{};
  std::vector<std::string> files{"INLINE- 10 203 500075.00 6700000.00 33.0000 Big Fault 4\n"};
  for (const formats::StickFormat& format : formats::stick_formats()) {
    std::vector<std::string> renamed;
    if (format.write != nullptr) files.push_back(format.write(sticks, options, renamed));
  }
  return files;
}

}  // namespace

Target fuzz_target() {
  return {{"softwareunderground+subsurface/tests/data/faults/faultsticks",
           "equinor+xtgeo-testdata/polygons/reek/1/*.pol", "equinor+xtgeo-testdata/polygons/reek/1/*.csv"},
          written(),
          run};
}

}  // namespace footwall::fuzz
