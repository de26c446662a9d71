#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>

#include "engine/session/private_folder.h"
#include "engine/tasks/detail/pack_list.h"
#include "engine/tasks/open_volume.h"
#include "engine/tasks/pack.h"
#include "storage/base/error.h"
#include "storage/base/hash.h"
#include "storage/base/partial_file.h"
#include "storage/formats/tar.h"

namespace footwall::tasks {
namespace {

using detail::PackList;

Error not_ours(const std::filesystem::path& archive, const std::string& why) {
  return {ErrorCode::kFormat, fmt::format("{} is not unpacked: {}", archive.string(), why),
          "an archive is made by footwall pack"};
}

Error damaged(const std::filesystem::path& archive, const std::string& why) {
  return {ErrorCode::kCorrupt, fmt::format("{} is damaged or cut short: {}", archive.string(), why),
          "copy or download it again"};
}

void refuse_existing(const std::filesystem::path& path) {
  std::error_code trouble;
  // Not exists(): a link to nowhere is in the way, too.
  if (std::filesystem::symlink_status(path, trouble).type() == std::filesystem::file_type::not_found) return;
  throw Error(ErrorCode::kInvalid, fmt::format("{} already exists", path.string()),
              "unpack into another folder (--into), or move it away first");
}

// A new file that is flushed when it is whole.
class NewFile {
 public:
  explicit NewFile(const std::filesystem::path& path) : path_(path) {
    file_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (file_ < 0) throw io_error("write", path.string(), errno);
  }
  ~NewFile() { ::close(file_); }
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  void write(std::span<const std::byte> bytes) const {
    while (!bytes.empty()) {
      const ssize_t done = ::write(file_, bytes.data(), bytes.size());
      if (done < 0 && errno == EINTR) continue;
      if (done < 0) throw io_error("write", path_.string(), errno);
      bytes = bytes.subspan(static_cast<std::size_t>(done));
    }
  }
  void flush() const {
    if (::fsync(file_) != 0) throw io_error("write", path_.string(), errno);
  }

 private:
  std::filesystem::path path_;
  int file_ = -1;
};

// Renames; never over something that is there.
void put(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return;
  if (errno == EINVAL || errno == ENOSYS) {  // a file system that cannot promise it, as NFS
    refuse_existing(to);
    if (::rename(from.c_str(), to.c_str()) == 0) return;
  }
  if (errno == EEXIST) refuse_existing(to);
  throw io_error("write", to.string(), errno);
}

class Unpacking {
 public:
  Unpacking(const std::filesystem::path& archive, const std::filesystem::path& folder, const JobContext& job)
      : archive_(archive),
        folder_(folder),
        archive_bytes_(static_cast<std::int64_t>(std::filesystem::file_size(archive))),
        staging_(folder),
        job_(job) {}

  // Every entry into the private folder; what they are is told by their order and names alone.
  void extract() {
    formats::TarReader tar(archive_);
    formats::TarReader::Entry entry;
    std::string list;
    while (tar.next(entry)) {
      if (entry.bytes > archive_bytes_)
        throw damaged(archive_, fmt::format("'{}' is longer than it", entry.name));
      if (!list.empty())
        throw not_ours(archive_, fmt::format("'{}' stands behind its list of files", entry.name));
      if (found_.files.empty()) {
        begin_project(entry.name);
      } else if (entry.name == detail::list_name_of(found_.project)) {
        if (static_cast<std::size_t>(entry.bytes) > detail::kLongestList)
          throw not_ours(archive_, "its list of files is too long");
        tar.read([&](std::span<const std::byte> bytes) {
          list.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        });
        continue;
      } else {
        require_volume_file(entry.name);
      }
      write(tar, entry);
    }
    if (list.empty()) throw damaged(archive_, "its list of files, which stands at the end, is not there");
    listed_ = detail::pack_list_from(list);
    if (listed_.project != found_.project || listed_.files != found_.files)
      throw damaged(archive_, "its files are not those of its list");
  }

  // The project and its volumes, as they lie on the disk now.
  void verify() const {
    const project::Project project =
        project::Project::open(staging_.path() / found_.project, project::OpenMode::kRead);
    if (const auto report = project.check(); !report.ok()) throw damaged(archive_, report.problems.front());
    const auto volumes = project.volumes();
    for (std::size_t n = 0; n < volumes.size(); ++n) {
      const project::VolumeRecord& volume = volumes[n];
      const bool left_out =
          std::find(listed_.missing.begin(), listed_.missing.end(), volume.name) != listed_.missing.end();
      if (left_out) continue;
      const std::string entry = detail::volumes_folder_of(found_.project) + "/" + volume.file;
      const bool packed = std::any_of(found_.files.begin(), found_.files.end(),
                                      [&](const PackList::File& file) { return file.name == entry; });
      if (!packed) throw damaged(archive_, fmt::format("the volume '{}' is not in it", volume.name));
      const auto share = [&](std::size_t done) {
        return static_cast<double>(done) / static_cast<double>(volumes.size());
      };
      open_volume(project, volume).verify(job_.part(0.6 + 0.4 * share(n), 0.6 + 0.4 * share(n + 1)));
    }
  }

  Unpacked publish() {
    const auto volumes = detail::volumes_folder_of(found_.project);
    const bool has_volumes = std::filesystem::exists(staging_.path() / volumes);
    job_.check();
    if (has_volumes) put(staging_.path() / volumes, folder_ / volumes);
    try {
      put(staging_.path() / found_.project, folder_ / found_.project);
    } catch (const Error&) {
      if (has_volumes) put(folder_ / volumes, staging_.path() / volumes);
      throw;
    }
    return {folder_ / found_.project, listed_.volumes, listed_.missing};
  }

 private:
  void begin_project(const std::string& name) {
    if (name.find('/') != std::string::npos)
      throw not_ours(archive_, fmt::format("it begins with '{}'", name));
    refuse_existing(folder_ / name);
    refuse_existing(folder_ / detail::volumes_folder_of(name));
    found_.project = name;
  }

  void require_volume_file(const std::string& name) const {
    const std::string folder = detail::volumes_folder_of(found_.project) + "/";
    if (!name.starts_with(folder) || name.find('/', folder.size()) != std::string::npos)
      throw not_ours(archive_, fmt::format("its entry '{}' belongs to no project", name));
    std::filesystem::create_directories(staging_.path() / detail::volumes_folder_of(found_.project));
  }

  void write(formats::TarReader& tar, const formats::TarReader::Entry& entry) {
    const NewFile file(staging_.path() / entry.name);
    Hasher hasher;
    tar.read([&](std::span<const std::byte> bytes) {
      file.write(bytes);
      hasher.add(bytes);
      done_ += static_cast<std::int64_t>(bytes.size());
      job_.report(
          0.6 * static_cast<double>(done_) / static_cast<double>(std::max<std::int64_t>(archive_bytes_, 1)),
          "unpack", fmt::format("{} of {} MiB", done_ >> 20, archive_bytes_ >> 20));
    });
    file.flush();
    found_.files.push_back({entry.name, entry.bytes, hasher.value()});
  }

  std::filesystem::path archive_, folder_;
  std::int64_t archive_bytes_;
  session::PrivateFolder staging_;
  const JobContext& job_;
  PackList found_, listed_;
  std::int64_t done_ = 0;
};

}  // namespace

Unpacked unpack_project(const std::filesystem::path& archive, const std::filesystem::path& folder,
                        const JobContext& job) {
  std::error_code trouble;
  if (!std::filesystem::is_directory(folder, trouble)) {
    throw Error(ErrorCode::kNotFound, fmt::format("there is no folder {}", folder.string()),
                "create it, or choose another one");
  }
  const formats::TarReader is_one(archive);
  const auto bytes = std::filesystem::file_size(archive);
  const auto space = std::filesystem::space(folder, trouble);
  if (!trouble && space.available < bytes) {
    const auto mib = [](auto amount) { return static_cast<double>(amount) / (1 << 20); };
    throw Error(ErrorCode::kIo,
                fmt::format("{} has {:.1f} MiB free, and {:.1f} MiB are needed", folder.string(),
                            mib(space.available), mib(bytes)),
                "choose another folder, or make room");
  }
  Unpacking unpacking(archive, folder, job);
  unpacking.extract();
  unpacking.verify();
  return unpacking.publish();
}

}  // namespace footwall::tasks
