// A buffered file that appears under its name only when whole; every failed write is an error.
#pragma once
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "storage/base/partial_file.h"

namespace footwall::formats::detail {

class OutputFile {
 public:
  // Throws kNotFound without the folder, kInvalid over a project or a volume, kIo.
  explicit OutputFile(const std::filesystem::path& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  // Throws kIo, naming the file and the reason ("No space left on device").
  void write(std::span<const std::byte> bytes);
  void write(std::string_view text) { write(std::as_bytes(std::span(text))); }
  template <class... Values>
  void print(fmt::format_string<Values...> pattern, Values&&... values) {
    line_.clear();
    fmt::format_to(std::back_inserter(line_), pattern, std::forward<Values>(values)...);
    write(std::string_view(line_.data(), line_.size()));
  }
  // Flushes to the disk and gives the file its name.
  void commit();

 private:
  void flush();
  std::filesystem::path path_;
  PartialFile partial_;
  int descriptor_ = -1;
  std::vector<std::byte> buffer_;
  fmt::memory_buffer line_;
};

}  // namespace footwall::formats::detail
