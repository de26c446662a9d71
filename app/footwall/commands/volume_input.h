// A volume's file as a source of samples, whatever its kind: what `new` and `import volume` share.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "app/footwall/commands/options.h"
#include "app/footwall/commands/shape_options.h"
#include "storage/formats/import_report.h"

namespace footwall::commands {

enum class VolumeKind : std::uint8_t { kTold, kSegy, kNrrd, kRaw };  // kTold: by the file's content

// What of the whole import volume_input() takes: SEG-Y's headers stand among its samples.
constexpr double share_of_headers(VolumeKind kind) {
  return kind == VolumeKind::kRaw ? 0 : 0.4;
}

struct VolumeInput {
  tasks::VolumeSource source;
  formats::ImportReport report;       // read: traces, skipped: doubled and dead ones
  std::vector<std::string> warnings;  // about the file, and what was clipped
};

// survey: of the project, if it has one: what the options say must agree with it. scratch: a folder on the
// disk where the project is, for unpacking. Throws kUsage, kInvalid, kFormat and what reading throws.
VolumeInput volume_input(const std::filesystem::path& file, VolumeKind kind, const VolumeOptions& options,
                         const ShapeOptions& shape, const std::optional<survey::Geometry>& survey,
                         const std::filesystem::path& scratch, const JobContext& job);

// The volume that was brought in, in words and in JSON, with the report.
console::Output volume_output(const project::VolumeRecord& volume, const VolumeInput& input);

}  // namespace footwall::commands
