// A folder that only this run uses: for MPI's session and shared-memory files, or for a job on disk.
#pragma once
#include <filesystem>

namespace footwall::session {

class PrivateFolder {
 public:
  // Makes <home>/footwall-<user>-<host>-<process>-XXXXXX, for this user alone; removes those of this user and
  // host whose process is gone. Throws Error kIo.
  explicit PrivateFolder(const std::filesystem::path& home);
  // Removes it with all that is in it.
  ~PrivateFolder();
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

// Where there is one, /dev/shm; else temporary_home().
std::filesystem::path home_in_memory();
// $TMPDIR, or /tmp. Throws Error kIo where it is no folder.
std::filesystem::path temporary_home();

}  // namespace footwall::session
