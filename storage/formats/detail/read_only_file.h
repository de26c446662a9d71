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
  // Whole pages from an offset on a page boundary into memory on one (storage/base/pages.h), as many as fit
  // and the file has: what is in the page cache comes from there, the rest straight from the disk where the
  // file system can, which leaves no copy in the cache and costs hardly any processor time. Returns how many
  // bytes were read, fewer only at the file's end. Throws kIo.
  std::size_t read_pages(std::int64_t offset, std::span<std::byte> pages) const;
  // Fills `bytes` from `offset` if all of them are in the page cache; else returns false without waiting for
  // the disk, and `bytes` are undefined.
  bool read_if_cached(std::int64_t offset, std::span<std::byte> bytes) const;
  // Starts to read these bytes into the page cache and returns at once.
  void will_need(std::int64_t offset, std::int64_t bytes) const;
  // Tells the system that the file will be read from front to back.
  void expect_sequential() const;
  // ... or here and there.
  void expect_scattered() const;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  int direct_ = -1;  // the same file, past the page cache; -1 where that cannot be
  std::int64_t size_ = 0;
};

// For a file that is shorter than it was: kCorrupt, with the place and the number of bytes missing.
[[noreturn]] void throw_ended(const ReadOnlyFile& file, std::int64_t at, std::int64_t missing);

}  // namespace footwall::formats::detail
