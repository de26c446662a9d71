// One archive of several files, as POSIX tar (pax, plain ustar wherever that suffices): any tar unpacks it.
// Written and read by libarchive. Reading trusts nothing: only plain files and folders with plain relative
// names, each once; no links, devices, sparse files, no compression, no name that leaves the folder.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>

namespace footwall::formats {

class TarWriter {
 public:
  // Replaces an existing file. Throws kIo.
  explicit TarWriter(const std::filesystem::path& path);
  ~TarWriter();
  TarWriter(const TarWriter&) = delete;
  TarWriter& operator=(const TarWriter&) = delete;

  // Starts a file of exactly `bytes` bytes. name: UTF-8, '/' between folders. Throws kInvalid for a name that
  // TarReader would refuse, or where the file before has not all its bytes.
  void begin(const std::string& name, std::int64_t bytes);
  // Throws kInvalid beyond the announced bytes, kIo.
  void write(std::span<const std::byte> bytes);
  // Ends the archive; without it there is no whole one. Throws kInvalid where the last file is not whole,
  // kIo.
  void close();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

class TarReader {
 public:
  struct Entry {
    std::string name;  // UTF-8, relative, without "." and ".." and without a leading "./"
    std::int64_t bytes = 0;
  };

  // Throws kNotFound, kIo, kFormat (not a tar, with a hint where it is a compressed one).
  explicit TarReader(const std::filesystem::path& path);
  ~TarReader();
  TarReader(const TarReader&) = delete;
  TarReader& operator=(const TarReader&) = delete;

  // The next file (folders are checked and skipped); false at the end. Throws kFormat naming the entry for
  // anything else than a plain file with a plain name that did not come before; kCorrupt for a damaged
  // or cut archive; kMemory beyond 100,000 entries.
  bool next(Entry& entry);
  // The bytes of the file that next() gave, in pieces. Throws kCorrupt where the archive is cut. What `take`
  // throws passes through.
  void read(const std::function<void(std::span<const std::byte>)>& take);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Why `name` is not a plain relative path of printable UTF-8 as both sides want it; empty when it is.
std::string unfit_for_tar(const std::string& name);

}  // namespace footwall::formats
