// A file without a name: gone when it is closed, also after a crash.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace footwall::formats::detail {

class ScratchFile {
 public:
  // bytes: its whole size, taken on the disk at once. Throws kIo (no room, no such folder).
  ScratchFile(const std::filesystem::path& folder, std::int64_t bytes);
  ~ScratchFile();
  ScratchFile(ScratchFile&& other) noexcept;
  ScratchFile& operator=(ScratchFile&&) = delete;

  void write_at(std::int64_t offset, std::span<const std::byte> bytes);
  // Throws kIo; the bytes must have been written.
  void read_at(std::int64_t offset, std::span<std::byte> bytes) const;

 private:
  std::filesystem::path folder_;
  int descriptor_ = -1;
};

}  // namespace footwall::formats::detail
