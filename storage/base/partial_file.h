// A file that is written under a temporary name beside its place and takes its name only when whole.
#pragma once
#include <filesystem>

namespace footwall {

class PartialFile {
 public:
  // Picks a private temporary name in final_path's folder; creates nothing. Throws kNotFound without that
  // folder.
  explicit PartialFile(std::filesystem::path final_path);
  // Removes the temporary file unless commit() was reached.
  ~PartialFile();
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  // Where to write; the file must be closed before commit().
  const std::filesystem::path& path() const { return temporary_; }
  // Flushes the bytes to the disk, renames, flushes the folder. Throws kIo; an existing file is replaced.
  void commit();

 private:
  std::filesystem::path final_;
  std::filesystem::path temporary_;
  bool committed_ = false;
};

// Removes what a program that was killed left of files under way to this name. No such program may still run.
void remove_partial_files_of(const std::filesystem::path& final_path);
// For files that the user names: throws kInvalid where a project or a volume file stands at the path, which
// no export is ever meant to replace.
void refuse_to_replace_storage(const std::filesystem::path& path);
// Writes a whole small file through PartialFile.
void write_whole_file(const std::filesystem::path& path, std::string_view bytes);
// Reads a whole file of at most `limit` bytes; throws kNotFound, kIo (also for a folder), or kMemory above
// the limit.
std::string read_whole_file(const std::filesystem::path& path, std::size_t limit);

}  // namespace footwall
