#include "engine/tasks/pack.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <map>
#include <set>
#include <vector>

#include "engine/tasks/detail/pack_list.h"
#include "engine/tasks/open_volume.h"
#include "storage/base/error.h"
#include "storage/base/hash.h"
#include "storage/base/partial_file.h"
#include "storage/formats/tar.h"
#include "storage/volume/volume_bytes.h"

namespace footwall::tasks {
namespace {

using detail::PackList;
using Piece = std::span<const std::byte>;

// A file that stands beside the archive while it is made.
class CopiedProject {
 public:
  CopiedProject(const project::Project& project, const std::filesystem::path& folder, const JobContext& job)
      : place_(folder / project.path().filename()) {
    project.copy_database(place_.path(), job);
  }
  const std::filesystem::path& path() const { return place_.path(); }

  // Where the volumes will lie beside the unpacked project. Opening for writing leaves it closed cleanly.
  void set_files(const std::map<std::int64_t, std::string>& files) {
    project::Project copy = project::Project::open(path(), project::OpenMode::kWrite);
    for (project::VolumeRecord volume : copy.volumes()) {
      const auto file = files.find(volume.id);
      if (file == files.end() || volume.file == file->second) continue;
      volume.file = file->second;
      copy.update_volume(volume);
    }
    copy.close();
  }

 private:
  PartialFile place_;
};

// One volume's file as it will be called in the volumes folder; several volumes may share one.
class Names {
 public:
  std::string name_for(const project::VolumeRecord& volume, const std::filesystem::path& path) {
    const auto known = given_.find(path);
    if (known != given_.end()) return known->second;
    std::string name = path.filename().string();
    if (!formats::unfit_for_tar(name).empty()) name = fmt::format("volume-{}.h5", volume.id);
    for (int n = 2; !taken_.insert(name).second; ++n) name = fmt::format("volume-{}-{}.h5", volume.id, n);
    return given_.emplace(path, name).first->second;
  }

 private:
  std::map<std::filesystem::path, std::string> given_;
  std::set<std::string> taken_;
};

// The archive as it grows: what is written is hashed, listed and reported.
class Archive {
 public:
  Archive(const std::filesystem::path& path, std::int64_t expected, const JobContext& job)
      : tar_(path), expected_(std::max<std::int64_t>(expected, 1)), job_(job) {}

  void begin(const std::string& name, std::int64_t bytes) {
    tar_.begin(name, bytes);
    list_.files.push_back({name, bytes, 0});
    hasher_.emplace();
  }
  void write(Piece piece) {
    tar_.write(piece);
    hasher_->add(piece);
    done_ += static_cast<std::int64_t>(piece.size());
    job_.report(static_cast<double>(done_) / static_cast<double>(expected_), "pack",
                fmt::format("{} of {} MiB", done_ >> 20, expected_ >> 20));
  }
  void end() { list_.files.back().hash = hasher_->value(); }

  void finish(const PackList& about) {
    list_.project = about.project;
    list_.volumes = about.volumes;
    list_.missing = about.missing;
    const std::string text = detail::to_json(list_);
    tar_.begin(detail::list_name_of(list_.project), static_cast<std::int64_t>(text.size()));
    tar_.write(std::as_bytes(std::span(text)));
    tar_.close();
  }

 private:
  formats::TarWriter tar_;
  PackList list_;
  std::optional<Hasher> hasher_;
  std::int64_t done_ = 0;
  std::int64_t expected_;
  const JobContext& job_;
};

void add_plain_file(Archive& archive, const std::string& name, const std::filesystem::path& path,
                    std::int64_t bytes) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw io_error("read", path.string(), errno);
  archive.begin(name, bytes);
  std::vector<char> piece(1 << 20);
  for (std::int64_t left = bytes; left > 0;) {
    in.read(piece.data(), std::min<std::int64_t>(left, static_cast<std::int64_t>(piece.size())));
    if (in.gcount() == 0) throw io_error("read", path.string(), errno);
    archive.write(std::as_bytes(std::span(piece).first(static_cast<std::size_t>(in.gcount()))));
    left -= in.gcount();
  }
  archive.end();
}

void require_room(const std::filesystem::path& folder, std::int64_t bytes) {
  std::error_code trouble;
  const auto space = std::filesystem::space(folder, trouble);
  if (trouble || space.available >= static_cast<std::uintmax_t>(bytes)) return;
  const auto mib = [](auto amount) { return static_cast<double>(amount) / (1 << 20); };
  throw Error(ErrorCode::kIo,
              fmt::format("{} has {:.1f} MiB free, and {:.1f} MiB are needed", folder.string(),
                          mib(space.available), mib(bytes)),
              "choose another folder, or make room");
}

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

}  // namespace

Packed pack_project(const project::Project& project, const std::filesystem::path& archive,
                    const PackOptions& options, const JobContext& job) {
  if (std::filesystem::exists(archive)) {
    throw Error(ErrorCode::kInvalid, fmt::format("{} already exists", archive.string()),
                "choose another name, or remove it first");
  }
  PartialFile file(archive);
  // Tried first, because an error of the project's copy would not tell which of the two folders is at fault.
  if (!std::ofstream(file.path())) throw io_error("write", archive.string(), errno);

  // 1. The project as it is now; all that follows goes by this copy.
  CopiedProject copied(project, folder_of(archive), job.part(0, 0.05));
  PackList list;
  list.project = project.path().filename().string();
  std::map<std::int64_t, std::string> files;
  std::int64_t total = static_cast<std::int64_t>(std::filesystem::file_size(copied.path()));
  std::vector<project::VolumeRecord> present;
  {
    const project::Project copy = project::Project::open(copied.path(), project::OpenMode::kRead);
    Names names;
    std::set<std::filesystem::path> counted;
    for (const project::VolumeRecord& volume : copy.volumes()) {
      const std::filesystem::path path = project.volume_path(volume);
      std::error_code trouble;
      if (!std::filesystem::exists(path, trouble)) {
        list.missing.push_back(volume.name);
        continue;
      }
      open_volume(project, volume);  // the project's own, and whole so far as its length tells
      files[volume.id] = names.name_for(volume, path);
      list.volumes.push_back(volume.name);
      if (!counted.insert(path).second) continue;
      present.push_back(volume);
      total += volume.bytes;
    }
  }
  if (!list.missing.empty() && !options.without_missing) {
    throw Error(ErrorCode::kNotFound,
                fmt::format("the project's volume {} {} not there", fmt::join(list.missing, ", "),
                            list.missing.size() == 1 ? "is" : "are"),
                "footwall relink tells where they are now; --without-missing packs without them");
  }
  copied.set_files(files);
  require_room(folder_of(archive), total);

  // 2. Everything in one stream, each volume's chunks checked on the way.
  const JobContext streaming = job.part(0.05, 1);
  Archive out(file.path(), total, streaming);
  add_plain_file(out, list.project, copied.path(),
                 static_cast<std::int64_t>(std::filesystem::file_size(copied.path())));
  for (const project::VolumeRecord& volume : present) {
    const std::filesystem::path path = project.volume_path(volume);
    out.begin(detail::volumes_folder_of(list.project) + "/" + files.at(volume.id),
              static_cast<std::int64_t>(std::filesystem::file_size(path)));
    volume::each_verified_piece(path, streaming, [&](Piece piece) { out.write(piece); });
    out.end();
  }
  out.finish(list);
  streaming.check();
  file.commit();
  return {archive, static_cast<std::int64_t>(std::filesystem::file_size(archive)), list.volumes,
          list.missing};
}

}  // namespace footwall::tasks
