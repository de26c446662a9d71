#include "storage/formats/stick_formats.h"

#include <fmt/format.h>
#include <algorithm>

#include "storage/base/error.h"
#include "storage/base/partial_file.h"
#include "storage/formats/charisma.h"
#include "storage/formats/columns.h"
#include "storage/formats/opendtect_sticks.h"
#include "storage/formats/other_files.h"
#include "storage/formats/xyz_sticks.h"

namespace footwall::formats {
namespace {

constexpr std::size_t kHead = std::size_t{64} << 10;
constexpr std::size_t kLargest = std::size_t{1} << 30;

// In the order in which a file's content is asked: what starts with a word of its own, then tables with names
// or headings, then bare numbers.
constexpr StickFormat kFormats[] = {
    {"charisma", "Charisma fault sticks", charisma::recognises, charisma::parse, charisma::write},
    {"opendtect-bulk", "OpendTect, several faults", opendtect_sticks::recognises_bulk,
     opendtect_sticks::parse, opendtect_sticks::write_bulk},
    {"columns", "a table with headings or with --columns", columns::recognises, columns::parse,
     columns::write},
    {"opendtect", "OpendTect, one fault", opendtect_sticks::recognises, opendtect_sticks::parse,
     opendtect_sticks::write, true},
    {"dufault", "x y z, a blank line between sticks", xyz_sticks::recognises_groups, xyz_sticks::parse_groups,
     xyz_sticks::write_groups, true},
    {"xyz", "x y z stick", xyz_sticks::recognises, xyz_sticks::parse, xyz_sticks::write, true},
};

std::string names_of_formats(bool written) {
  std::string names;
  for (const StickFormat& format : kFormats) {
    if (!written || format.write != nullptr) names += (names.empty() ? "" : ", ") + std::string(format.name);
  }
  return names;
}

const StickFormat& format_of(const std::string& text, const SticksOptions& options,
                             const std::optional<OtherFile>& other) {
  if (options.columns) return stick_format("columns");
  if (other)
    throw Error(ErrorCode::kFormat, fmt::format("this is {}, not fault sticks", other->what), other->use);
  std::string_view head = text;
  if (head.size() > kHead) head = head.substr(0, std::min(head.rfind('\n', kHead), kHead - 1) + 1);
  if (const StickFormat* format = recognise_sticks(head)) return *format;
  throw Error(
      ErrorCode::kFormat, "no format of fault sticks is seen in the content",
      "--format names one of " + names_of_formats(false) + "; --columns x=1,y=2,z=3,stick=4 reads any table");
}

}  // namespace

std::span<const StickFormat> stick_formats() {
  return kFormats;
}

const StickFormat& stick_format(std::string_view name) {
  for (const StickFormat& format : kFormats) {
    if (format.name == name) return format;
  }
  throw Error(ErrorCode::kUsage, fmt::format("fault sticks of format '{}' are not known", name),
              "formats that are: " + names_of_formats(false));
}

const StickFormat* recognise_sticks(std::string_view head) {
  for (const StickFormat& format : kFormats) {
    if (format.recognises != nullptr && format.recognises(head)) return &format;
  }
  return nullptr;
}

SticksImport read_sticks(const std::filesystem::path& path, std::string_view format,
                         const SticksOptions& options) {
  if (!format.empty()) stick_format(format);
  if (options.columns && !format.empty() && format != "columns") {
    throw Error(ErrorCode::kUsage, fmt::format("columns are told, and the format '{}' has its own", format),
                "leave the one or the other out");
  }
  if (!std::filesystem::exists(path)) {
    throw Error(ErrorCode::kNotFound, fmt::format("there is no file {}", path.string()));
  }
  const std::string text = read_whole_file(path, kLargest);
  const auto other = recognise_other(std::string_view(text).substr(0, kHead), text.size());
  SticksOptions completed = options;
  if (completed.fault.empty()) completed.fault = path.stem().string();
  try {
    const StickFormat& chosen = format.empty() ? format_of(text, options, other) : stick_format(format);
    SticksImport read = chosen.parse(text, completed);
    read.format = chosen.name;
    return read;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kFormat) throw;
    const bool told_wrong = !format.empty() && other;
    throw Error(
        error.code(), fmt::format("{}: {}", path.string(), error.message()),
        told_wrong ? fmt::format("the file looks like {}: {}", other->what, other->use) : error.hint());
  }
}

std::vector<std::string> write_sticks(const std::filesystem::path& path, std::string_view format,
                                      std::span<const Stick> sticks, const SticksWriteOptions& options) {
  const StickFormat& chosen = stick_format(format);
  if (chosen.write == nullptr) {
    throw Error(ErrorCode::kUsage, fmt::format("fault sticks of format '{}' are only read", format),
                "formats that are written: " + names_of_formats(true));
  }
  if (sticks.empty()) throw Error(ErrorCode::kInvalid, "there are no fault sticks to write");
  const std::string& fault = sticks.front().fault;
  std::vector<std::string> renamed;
  if (chosen.one_fault) {
    if (std::any_of(sticks.begin(), sticks.end(), [&](const Stick& stick) { return stick.fault != fault; })) {
      throw Error(ErrorCode::kUsage,
                  fmt::format("a file of format '{}' holds one fault, without its name", format),
                  "--fault names the one to write; charisma, opendtect-bulk and columns hold several");
    }
    renamed.push_back(fault + " -> (the file holds no name)");
  }
  const std::string text = chosen.write(sticks, options, renamed);
  refuse_to_replace_storage(path);
  write_whole_file(path, text);
  return renamed;
}

}  // namespace footwall::formats
