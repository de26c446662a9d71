#include "storage/formats/tar.h"

#include <archive.h>
#include <archive_entry.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <locale.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <set>

#include "storage/base/error.h"
#include "storage/base/text.h"
#include "storage/formats/detail/utf8.h"

namespace footwall::formats {
namespace {

constexpr std::size_t kMostEntries = 100'000;
constexpr std::size_t kLongestName = 1000;

// libarchive turns names from and to the thread's locale, which may know no letter beyond ASCII.
class Utf8Here {
 public:
  Utf8Here() : utf8_(::newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr)) {
    if (utf8_ != nullptr) before_ = ::uselocale(utf8_);
  }
  ~Utf8Here() {
    if (utf8_ == nullptr) return;
    ::uselocale(before_);
    ::freelocale(utf8_);
  }
  Utf8Here(const Utf8Here&) = delete;
  Utf8Here& operator=(const Utf8Here&) = delete;

 private:
  locale_t utf8_;
  locale_t before_ = nullptr;
};

std::string reason_of(archive* from) {
  const char* text = archive_error_string(from);
  return text != nullptr ? text : "unknown reason";
}

// For messages: an entry's name may hold what a terminal obeys.
std::string shown(const std::string& name) {
  std::string text = detail::as_utf8(name.substr(0, 200));
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return text;
}

bool is_text(const std::string& name) {
  for (const unsigned char c : name) {
    if (c < 0x20 || c == 0x7f) return false;
  }
  return detail::as_utf8(name) == name;
}

}  // namespace

std::string unfit_for_tar(const std::string& name) {
  if (name.empty()) return "it is empty";
  if (name.size() > kLongestName) return fmt::format("it is longer than {} bytes", kLongestName);
  if (!is_text(name)) return "it holds control characters or is not UTF-8";
  if (name.front() == '/' || name.find('\\') != std::string::npos) return "it is not a plain relative path";
  for (const std::string_view part : text::split(name, '/')) {
    if (part.empty() || part == "." || part == "..") return "it is not a plain relative path";
  }
  return {};
}

struct TarWriter::State {
  std::filesystem::path path;
  archive* out = nullptr;
  std::string name;
  std::int64_t left = 0;

  ~State() {
    if (out != nullptr) archive_write_free(out);
  }
  void checked(int result) const {
    if (result == ARCHIVE_OK) return;
    const int number = archive_errno(out);
    if (number > 0) throw io_error("write", path.string(), number);
    throw Error(ErrorCode::kIo, fmt::format("cannot write {}: {}", path.string(), reason_of(out)));
  }
  void require_whole() const {
    if (left == 0) return;
    throw Error(ErrorCode::kInvalid, fmt::format("{} lacks {} bytes in the archive", name, left));
  }
};

TarWriter::TarWriter(const std::filesystem::path& path) : state_(std::make_unique<State>()) {
  state_->path = path;
  state_->out = archive_write_new();
  if (state_->out == nullptr) throw std::bad_alloc();
  state_->checked(archive_write_set_format_pax_restricted(state_->out));
  state_->checked(archive_write_set_bytes_per_block(state_->out, 1 << 20));
  state_->checked(archive_write_set_bytes_in_last_block(state_->out, 512));
  state_->checked(archive_write_open_filename(state_->out, path.c_str()));
}

TarWriter::~TarWriter() {
  if (state_->out == nullptr) return;
  archive_write_fail(state_->out);  // no end of archive
}

void TarWriter::begin(const std::string& name, std::int64_t bytes) {
  state_->require_whole();
  if (const std::string why = unfit_for_tar(name); !why.empty() || bytes < 0) {
    throw Error(ErrorCode::kInvalid, fmt::format("'{}' cannot be a name in an archive: {}", shown(name), why),
                "rename the file");
  }
  const Utf8Here utf8;
  const std::unique_ptr<archive_entry, void (*)(archive_entry*)> entry(archive_entry_new(),
                                                                       archive_entry_free);
  if (!entry) throw std::bad_alloc();
  archive_entry_set_pathname(entry.get(), name.c_str());
  archive_entry_set_filetype(entry.get(), AE_IFREG);
  archive_entry_set_perm(entry.get(), 0644);
  archive_entry_set_size(entry.get(), bytes);
  archive_entry_set_mtime(entry.get(), std::time(nullptr), 0);
  state_->checked(archive_write_header(state_->out, entry.get()));
  state_->name = name;
  state_->left = bytes;
}

void TarWriter::write(std::span<const std::byte> bytes) {
  if (static_cast<std::int64_t>(bytes.size()) > state_->left) {
    throw Error(ErrorCode::kInvalid,
                fmt::format("{} has more bytes than when it was looked at", state_->name),
                "it was written to meanwhile; pack it again");
  }
  while (!bytes.empty()) {
    const la_ssize_t done = archive_write_data(state_->out, bytes.data(), bytes.size());
    if (done <= 0) state_->checked(ARCHIVE_FATAL);
    state_->left -= done;
    bytes = bytes.subspan(static_cast<std::size_t>(done));
  }
}

void TarWriter::close() {
  state_->require_whole();
  state_->checked(archive_write_close(state_->out));
}

struct TarReader::State {
  std::filesystem::path path;
  archive* in = nullptr;
  std::set<std::string> names;
  std::string name;
  std::int64_t bytes = 0;

  ~State() {
    if (in != nullptr) archive_read_free(in);
  }
  Error damaged() const {
    return {ErrorCode::kCorrupt, fmt::format("{} is damaged or cut short: {}", path.string(), reason_of(in)),
            "copy or download it again"};
  }
  Error refused(const std::string& entry, const std::string& why) const {
    return {ErrorCode::kFormat,
            fmt::format("{} is not unpacked: its entry '{}' {}", path.string(), shown(entry), why),
            "it was not made by footwall pack"};
  }
  std::string checked_name(archive_entry* entry) const;
};

TarReader::TarReader(const std::filesystem::path& path) : state_(std::make_unique<State>()) {
  state_->path = path;
  std::error_code trouble;
  if (!std::filesystem::exists(path, trouble)) {
    throw Error(ErrorCode::kNotFound, fmt::format("there is no file {}", path.string()));
  }
  if (!std::filesystem::is_regular_file(path, trouble)) {
    throw Error(ErrorCode::kFormat, fmt::format("{} is not an archive", path.string()));
  }
  std::ifstream file(path, std::ios::binary);
  unsigned char head[512] = {};
  if (!file) throw io_error("read", path.string(), errno);
  file.read(reinterpret_cast<char*>(head), sizeof head);
  const bool whole = file.gcount() == static_cast<std::streamsize>(sizeof head);
  // "ustar" stands at byte 257 of every POSIX tar; nothing else is asked to guess what this might be.
  if (!whole || std::memcmp(head + 257, "ustar", 5) != 0) {
    const bool gzip = head[0] == 0x1f && head[1] == 0x8b;
    const bool zstd = head[0] == 0x28 && head[1] == 0xb5 && head[2] == 0x2f && head[3] == 0xfd;
    const bool xz = std::memcmp(head,
                                "\xfd"
                                "7zXZ",
                                5) == 0;
    throw Error(ErrorCode::kFormat, fmt::format("{} is not a tar archive", path.string()),
                gzip || zstd || xz ? "it is compressed: decompress it first (gunzip, unzstd or unxz)"
                                   : "an archive is made by footwall pack");
  }
  state_->in = archive_read_new();
  if (state_->in == nullptr) throw std::bad_alloc();
  archive_read_support_filter_none(state_->in);
  archive_read_support_format_tar(state_->in);
  if (archive_read_open_filename(state_->in, path.c_str(), 1 << 20) != ARCHIVE_OK) throw state_->damaged();
}

TarReader::~TarReader() = default;

std::string TarReader::State::checked_name(archive_entry* entry) const {
  const char* text = archive_entry_pathname(entry);
  if (text == nullptr) throw refused("?", "has no name that can be read");
  std::string plain = text;
  while (plain.starts_with("./")) plain.erase(0, 2);
  const bool folder = archive_entry_filetype(entry) == AE_IFDIR;
  if (folder) {
    while (plain.ends_with('/')) plain.pop_back();
    if (plain.empty() || plain == ".") return {};
  }
  if (const std::string why = unfit_for_tar(plain); !why.empty())
    throw refused(plain, "has no plain name: " + why);
  if (archive_entry_hardlink(entry) != nullptr || archive_entry_symlink(entry) != nullptr)
    throw refused(plain, "is a link");
  if (!folder && archive_entry_filetype(entry) != AE_IFREG)
    throw refused(plain, "is neither file nor folder");
  if (archive_entry_sparse_count(entry) > 0) throw refused(plain, "is a sparse file");
  return folder ? std::string() : plain;
}

bool TarReader::next(Entry& entry) {
  const Utf8Here utf8;
  for (;;) {
    archive_entry* raw = nullptr;
    const int result = archive_read_next_header(state_->in, &raw);
    if (result == ARCHIVE_EOF) return false;
    if (result != ARCHIVE_OK) throw state_->damaged();
    const std::string name = state_->checked_name(raw);
    if (state_->names.size() >= kMostEntries) {
      throw Error(ErrorCode::kMemory,
                  fmt::format("{} has more than {} entries", state_->path.string(), kMostEntries));
    }
    if (name.empty()) {
      // A folder says nothing that the files do not; empty ones are counted all the same.
      state_->names.insert(fmt::format("\n{}", state_->names.size()));
      continue;
    }
    if (!state_->names.insert(name).second) throw state_->refused(name, "stands there twice");
    if (!archive_entry_size_is_set(raw) || archive_entry_size(raw) < 0)
      throw state_->refused(name, "has no size");
    state_->name = name;
    state_->bytes = archive_entry_size(raw);
    entry = {name, state_->bytes};
    return true;
  }
}

void TarReader::read(const std::function<void(std::span<const std::byte>)>& take) {
  std::int64_t done = 0;
  for (;;) {
    const void* data = nullptr;
    std::size_t size = 0;
    la_int64_t offset = 0;
    const int result = archive_read_data_block(state_->in, &data, &size, &offset);
    if (result == ARCHIVE_EOF) break;
    if (result != ARCHIVE_OK) throw state_->damaged();
    if (offset != done || static_cast<std::int64_t>(size) > state_->bytes - done)
      throw state_->refused(state_->name, "is not as long as it says");
    done += static_cast<std::int64_t>(size);
    if (size > 0) take({static_cast<const std::byte*>(data), size});
  }
  if (done != state_->bytes) throw state_->refused(state_->name, "is not as long as it says");
}

}  // namespace footwall::formats
