#include "storage/base/error.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <system_error>

namespace footwall {
namespace {

struct Row {
  ErrorCode code;
  std::string_view name;
};

constexpr std::array<Row, 12> kNames{{{ErrorCode::kUsage, "usage"},
                                      {ErrorCode::kInvalid, "invalid"},
                                      {ErrorCode::kNotFound, "not_found"},
                                      {ErrorCode::kFormat, "format"},
                                      {ErrorCode::kCorrupt, "corrupt"},
                                      {ErrorCode::kIo, "io"},
                                      {ErrorCode::kHeld, "held"},
                                      {ErrorCode::kUnsupported, "unsupported"},
                                      {ErrorCode::kMemory, "memory"},
                                      {ErrorCode::kCancelled, "cancelled"},
                                      {ErrorCode::kEngine, "engine"},
                                      {ErrorCode::kInternal, "internal"}}};

}  // namespace

std::string_view name_of(ErrorCode code) {
  for (const Row& row : kNames) {
    if (row.code == code) return row.name;
  }
  return "internal";
}

ErrorCode error_code_from(std::string_view name) {
  for (const Row& row : kNames) {
    if (row.name == name) return row.code;
  }
  return ErrorCode::kInternal;
}

Error::Error(ErrorCode code, std::string message, std::string hint)
    : code_(code), message_(std::move(message)), hint_(std::move(hint)) {
  whole_ = hint_.empty() ? message_ : message_ + " (" + hint_ + ")";
}

void require(bool condition, std::string_view what, const char* file, int line) {
  if (condition) return;
  throw Error(ErrorCode::kInternal, fmt::format("{}:{}: {}", file, line, what),
              "this is a bug of Footwall: please report it with the command that led here");
}

Error io_error(std::string_view doing, const std::string& path, int error_number) {
  const std::string reason = std::generic_category().message(error_number);
  std::string hint;
  if (error_number == ENOSPC || error_number == EDQUOT) hint = "free some space on that disk and try again";
  if (error_number == EACCES || error_number == EPERM)
    hint = "check the permissions of the file and its folder";
  if (error_number == EROFS) hint = "the disk is read-only: choose another folder";
  const ErrorCode code = error_number == ENOENT ? ErrorCode::kNotFound : ErrorCode::kIo;
  return {code, fmt::format("cannot {} {}: {}", doing, path, reason), hint};
}

}  // namespace footwall
