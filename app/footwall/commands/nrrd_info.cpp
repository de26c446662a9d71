#include "app/footwall/commands/nrrd_info.h"

#include <fmt/format.h>

#include <cmath>

#include "storage/formats/nrrd.h"

namespace footwall::commands {
namespace {

console::Json number(double value) {
  return std::isnan(value) ? console::Json() : console::Json(value);
}

console::Json numbers(const std::vector<double>& values) {
  if (values.empty()) return nullptr;
  console::Json list = console::Json::array();
  for (const double value : values) list.push_back(number(value));
  return list;
}

}  // namespace

console::Output nrrd_info(const std::string& file) {
  const formats::nrrd::Header header = formats::nrrd::read_header(file);
  console::Json axes = console::Json::array();
  for (const formats::nrrd::Axis& axis : header.axes) {
    axes.push_back({{"size", axis.size},
                    {"spacing", number(axis.spacing)},
                    {"unit", axis.unit.empty() ? console::Json() : console::Json(axis.unit)},
                    {"direction", numbers(axis.direction)}});
  }
  console::Output output;
  output.json = {{"format", fmt::format("NRRD000{}", header.version)},
                 {"type", name_of(header.type)},
                 {"encoding", header.encoding == formats::nrrd::Encoding::kGzip ? "gzip" : "raw"},
                 {"endian", header.big_endian ? "big" : "little"},
                 {"axes", axes},
                 {"space", header.space},
                 {"origin", numbers(header.space_origin)},
                 {"data_files", header.files.size()},
                 {"content", header.content},
                 {"keys", header.keys},
                 {"not_used", header.skipped},
                 {"assumed", header.notes}};
  for (const auto& [key, value] : output.json.items()) {
    if (value.empty()) continue;
    output.text +=
        fmt::format("{:12} {}\n", key, value.is_string() ? value.get<std::string>() : value.dump());
  }
  return output;
}

}  // namespace footwall::commands
