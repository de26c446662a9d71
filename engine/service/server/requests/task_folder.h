// The files of one job of the command line, in a folder that is there as long as the call is.
#pragma once
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>

#include "engine/service/engine.pb.h"

namespace footwall::service {

class TaskFolder {
 public:
  static constexpr std::int64_t kMostBytes = std::int64_t{1} << 30;
  static constexpr std::size_t kMostFiles = 1000;

  // Makes a private folder with in/ and out/ under `scratch`. Throws Error kIo.
  explicit TaskFolder(const std::filesystem::path& scratch);
  // Removes all of it.
  ~TaskFolder();
  TaskFolder(const TaskFolder&) = delete;
  TaskFolder& operator=(const TaskFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  // Adds a piece to in/NAME, mode 0600; pieces of a file follow one another. Throws Error kInvalid for a name
  // that is not plain or a file that is whole already, kMemory beyond what there may be, kIo.
  void add(const v1::FilePiece& piece);
  // No more comes. Throws Error kInvalid where a file is not whole.
  void close() const;

 private:
  std::filesystem::path path_;
  std::string open_;  // the file that pieces come for
  std::set<std::string> whole_;
  std::int64_t bytes_ = 0;
};

// Whether a file name is letters, digits, "-", "_" and ".", begins with none of ".", and has 1 to 100 of
// them.
bool is_plain_name(const std::string& name);

}  // namespace footwall::service
