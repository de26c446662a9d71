// HDF5's C calls with ownership and Footwall's errors. HDF5 types stay inside this folder.
#pragma once
#include <hdf5.h>

#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "storage/base/error.h"

namespace footwall::volume {

// HDF5 as it is built here serves one thread at a time, its account of the last failure included. Every
// function that calls it holds one of these for as long as its calls belong together, and lets go of it for
// what needs no HDF5 (hashing, waiting for a source). A thread may hold several. Collective calls hold none
// while they wait for other ranks: a process with several ranks' worth of HDF5 uses it from one thread.
class Hdf5Use {
 public:
  // Turns HDF5's printing to stderr off, too.
  Hdf5Use();

 private:
  std::unique_lock<std::recursive_mutex> lock_;
};

// Closes what it holds with the function that HDF5 wants for it.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle() = default;
  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  ~Handle() { reset(); }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  hid_t id() const { return id_; }
  explicit operator bool() const { return id_ >= 0; }
  // False if HDF5 could not close it (for a file: could not write what was left).
  bool reset();

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

// HDF5's own account of its last failure in one line; clears it.
std::string last_hdf5_reason();

// Throws Error(code, "<what>: <HDF5's reason>", hint).
[[noreturn]] void throw_hdf5(ErrorCode code, const std::string& what, const std::string& hint = {});

// Turns HDF5's printing to stderr off for this thread; call before any other HDF5 call of a public function.
void quiet_hdf5();

// Read-only, file locking off. Throws kFormat or kCorrupt.
Handle open_file_read_only(const std::filesystem::path& path, hid_t access_properties);

// An object reached through hard links only, so that a file cannot lead us into another one; throws kFormat.
Handle open_dataset(hid_t file, const std::string& name, const std::filesystem::path& path);

// Attributes are UTF-8 strings of at most kLongestAttribute bytes.
inline constexpr std::size_t kLongestAttribute = 1U << 20;
void write_attribute(hid_t object, const std::string& name, std::string_view text);
// Nothing where there is none; throws kFormat for one of another type or size.
std::optional<std::string> read_attribute(hid_t object, const std::string& name,
                                          const std::filesystem::path& path);

}  // namespace footwall::volume
