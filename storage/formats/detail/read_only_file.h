// A file that is read at given places, by several threads if need be.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace footwall::formats::detail {

class ReadOnlyFile {
 public:
  // Throws kNotFound, kIo; kFormat for anything but a plain file.
  explicit ReadOnlyFile(std::filesystem::path path);
  ~ReadOnlyFile();
  ReadOnlyFile(ReadOnlyFile&& other) noexcept;
  ReadOnlyFile& operator=(ReadOnlyFile&&) = delete;

  std::int64_t size() const { return size_; }  // when it was opened
  const std::filesystem::path& path() const { return path_; }
  // Fills `bytes` from `offset`. Throws kIo, kCorrupt where the file ends before.
  void read_at(std::int64_t offset, std::span<std::byte> bytes) const;
  // Tells the system that the file will be read from front to back.
  void expect_sequential() const;
  // ... or here and there.
  void expect_scattered() const;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::int64_t size_ = 0;
};

}  // namespace footwall::formats::detail
