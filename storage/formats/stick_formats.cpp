#include "storage/formats/stick_formats.h"

#include <fmt/format.h>

#include "storage/base/error.h"
#include "storage/formats/charisma.h"

namespace footwall::formats {
namespace {

// In the order in which a file's content is asked.
constexpr StickFormat kFormats[] = {
    {"charisma", "Charisma fault sticks", nullptr, charisma::parse, nullptr},
};

}  // namespace

std::span<const StickFormat> stick_formats() {
  return kFormats;
}

const StickFormat& stick_format(std::string_view name) {
  std::string known;
  for (const StickFormat& format : kFormats) {
    if (format.name == name) return format;
    known += (known.empty() ? "" : ", ") + std::string(format.name);
  }
  throw Error(ErrorCode::kUsage, fmt::format("fault sticks of format '{}' are not known", name),
              "formats that are: " + known);
}

const StickFormat* recognise_sticks(std::string_view head) {
  for (const StickFormat& format : kFormats) {
    if (format.recognises != nullptr && format.recognises(head)) return &format;
  }
  return nullptr;
}

SticksImport read_sticks(const std::filesystem::path& path, std::string_view format,
                         const SticksOptions& options) {
  if (!format.empty() && format != "charisma") stick_format(format);
  return charisma::read(path, options);
}

}  // namespace footwall::formats
