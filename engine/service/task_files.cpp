#include "engine/service/task_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/session/attribute.h"
#include "engine/session/batch.h"
#include "engine/session/isosurface_job.h"
#include "engine/session/job_json.h"
#include "engine/session/render_job.h"
#include "storage/base/error.h"
#include "storage/base/hash.h"
#include "storage/base/partial_file.h"
#include "storage/volume/volume_reader.h"

namespace footwall::service {
namespace {

using Json = nlohmann::json;
using std::filesystem::path;

constexpr std::string_view kVolume = "@volume/";
constexpr std::string_view kIn = "@in/";
constexpr std::string_view kOut = "@out/";
// What is sent of an earlier run, at the most; the rest is computed again.
constexpr std::size_t kMostPartFiles = 900;
constexpr std::uintmax_t kMostPartBytes = std::uintmax_t{512} << 20;
constexpr std::size_t kFacesLimit = std::size_t{16} << 30;
constexpr const char* kFaces = "job.faces";
constexpr const char* kResult = "result.json";

Error unknown_kind(const std::string& kind) {
  return Error(ErrorCode::kUnsupported, fmt::format("an engine cannot be given the job '{}'", kind),
               "run it without --engine");
}

std::string checksum_of(const path& volume) {
  return to_hex(volume::VolumeReader(volume).info().checksum);
}

// Gives the paths of a job their other forms: the client's, or the engine's.
class Paths {
 public:
  virtual ~Paths() = default;
  virtual void volume(path& at) = 0;
  // name: under which the client sends it.
  virtual void output(path& at, const char* name) = 0;
  virtual void numbered(path& at, const char* name) = 0;
};

// The volume's name stays with those who ask for it: what is written into their file.
void change(session::AttributeJob& job, Paths& paths) {
  if (job.volume_file.empty()) job.volume_file = job.volume.filename().string();
  paths.volume(job.volume);
  paths.output(job.output, "volume.h5");
  paths.output(job.result, kResult);
}

void change(session::IsosurfaceJob& job, Paths& paths) {
  if (job.volume_file.empty()) job.volume_file = job.volume.filename().string();
  paths.volume(job.volume);
  if (!job.output.empty()) paths.output(job.output, "surface.h5");
  if (job.visible && !job.visible->choice.pass_layers.empty())
    paths.numbered(job.visible->choice.pass_layers, "pass");
  paths.output(job.result, kResult);
}

void change(session::RenderJob& job, Paths& paths) {
  for (session::RenderJob::Isosurface& each : job.isosurfaces) paths.volume(each.volume);
  if (job.visible && !job.visible->pass_layers.empty()) paths.numbered(job.visible->pass_layers, "pass");
  paths.output(job.layer, "layer");
  paths.output(job.result, kResult);
}

class Packer : public Paths {
 public:
  explicit Packer(PackedTask& packed) : packed_(packed) {}

  void volume(path& at) override {
    const std::string checksum = checksum_of(at);
    at = name_of(at, checksum);
  }
  std::string name_of(const path& file, const std::string& checksum) {
    const auto& known = packed_.task.volumes();
    const bool is_new = std::none_of(known.begin(), known.end(),
                                     [&](const auto& each) { return each.checksum() == checksum; });
    if (is_new) {
      v1::VolumeName& added = *packed_.task.add_volumes();
      added.set_checksum(checksum);
      added.set_path(std::filesystem::absolute(file).string());
    }
    return std::string(kVolume) + checksum;
  }
  void output(path& at, const char* name) override {
    packed_.out.push_back({name, at});
    if (name == std::string_view(kResult)) packed_.result = at;
    at = std::string(kOut) + name;
  }
  void numbered(path& at, const char* name) override {
    packed_.out_numbered = {name, at};
    at = std::string(kOut) + name;
  }

 private:
  PackedTask& packed_;
};

Error strange(const path& at, const char* wanted) {
  return Error(ErrorCode::kInvalid,
               fmt::format("the task names '{}' where {} is expected", at.string(), wanted),
               "use @volume/CHECKSUM, @in/NAME and @out/NAME: an engine opens no other file for a task");
}

// The part of `words` behind `head`; a task file's name, or it throws.
std::string name_behind(std::string_view head, const path& at, const char* wanted) {
  const std::string words = at.string();
  if (!words.starts_with(head)) throw strange(at, wanted);
  std::string name = words.substr(head.size());
  if (!is_task_file_name(name)) throw strange(at, wanted);
  return name;
}

class Unpacker : public Paths {
 public:
  Unpacker(const v1::Task& task, path folder, const FindVolume& find)
      : task_(task), folder_(std::move(folder)), find_(find) {}

  void volume(path& at) override {
    const std::string checksum = name_behind(kVolume, at, "a volume");
    hash_from_hex(checksum);
    v1::VolumeName name;
    name.set_checksum(checksum);
    try {
      at = find_(name);
    } catch (const Error& error) {
      // Not known by its checksum: where the client has it, if that is a file here.
      const auto hint = std::find_if(task_.volumes().begin(), task_.volumes().end(),
                                     [&](const auto& each) { return each.checksum() == checksum; });
      if (error.code() != ErrorCode::kNotFound || hint == task_.volumes().end() || hint->path().empty() ||
          !std::filesystem::exists(hint->path())) {
        throw;
      }
      at = find_(*hint);
    }
  }
  void output(path& at, const char* /*name*/) override {
    at = folder_ / "out" / name_behind(kOut, at, "a file to write");
  }
  void numbered(path& at, const char* name) override { output(at, name); }
  path input(const path& at) const {
    return folder_ / "in" / name_behind(kIn, at, "a file that comes along");
  }

 private:
  const v1::Task& task_;
  path folder_;
  const FindVolume& find_;
};

Json parsed(const v1::Task& task) {
  Json json = Json::parse(task.job(), nullptr, false);
  if (json.is_discarded() || !json.is_object())
    throw Error(ErrorCode::kFormat, "the task's job is no JSON", "send it again");
  return json;
}

template <typename Job>
session::JobFiles unpacked(Job job, Unpacker& paths) {
  if constexpr (requires { job.volume_file; }) {
    if (path(job.volume_file).filename() != job.volume_file)
      throw strange(job.volume_file, "the name of a volume's file");
  }
  change(job, paths);
  return {json_of(job).dump(), {}};
}

// The parts and the log of an earlier run of a batch job, which has them beside its result.
void take_up(const path& in, const path& out) {
  std::vector<path> files;
  for (const auto& entry : std::filesystem::directory_iterator(in)) {
    if (session::goes_on_with(entry.path().filename().string())) files.push_back(entry.path());
  }
  for (const path& file : files) std::filesystem::rename(file, out / file.filename());
}

// A batch job keeps its own text: only its three paths change.
session::JobFiles unpacked_batch(const v1::Task& task, Unpacker& paths) {
  Json json = parsed(task);
  try {
    const path faces = paths.input(json.at("faces").at("path").get<std::string>());
    path volume = json.at("volume").at("path").get<std::string>();
    paths.volume(volume);
    if (json.at("output") != "@out") throw strange(json.at("output").dump(), "@out");
    json["volume"]["path"] = volume.string();
    json["faces"]["path"] = faces.string();
    json["output"] = (faces.parent_path().parent_path() / "out").string();
    session::JobFiles files{json.dump(), read_whole_file(faces, kFacesLimit)};
    static_cast<void>(session::parse_job(files, faces.parent_path()));
    take_up(faces.parent_path(), faces.parent_path().parent_path() / "out");
    return files;
  } catch (const Json::exception& error) {
    throw Error(ErrorCode::kFormat, fmt::format("the task's job is no batch job: {}", error.what()));
  }
}

void add_earlier(PackedTask& packed) {
  std::error_code none;  // no folder yet, no parts
  std::uintmax_t bytes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(packed.out_folder, none)) {
    std::string name = entry.path().filename().string();
    if (!entry.is_regular_file() || !is_task_file_name(name) || !session::goes_on_with(name)) continue;
    bytes += entry.file_size();
    if (packed.in.size() == kMostPartFiles || bytes > kMostPartBytes) return;
    packed.in.push_back({std::move(name), entry.path()});
  }
}

PackedTask pack_batch(const path& job_path, const path& volume) {
  const session::Job job = session::read_job(job_path);
  PackedTask packed;
  const path file = volume.empty() ? job.volume : std::filesystem::absolute(volume);
  // What the job was written for decides: whether the file is that is seen where it is read.
  const std::string checksum = job.volume_checksum.empty() ? checksum_of(file) : job.volume_checksum;
  // Read again as text: what this program does not know of it stays.
  Json json = Json::parse(session::read_job_files(job_path).json);
  const path folder = std::filesystem::absolute(job_path).parent_path();
  packed.in.push_back({kFaces, (folder / json.at("faces").at("path").get<std::string>()).lexically_normal()});
  packed.out_folder = job.output;
  packed.result = job.output / kResult;
  packed.out.push_back({kResult, packed.result});
  add_earlier(packed);
  json["volume"]["path"] = Packer(packed).name_of(file, checksum);
  json["faces"]["path"] = std::string(kIn) + kFaces;
  json["output"] = "@out";
  packed.task.set_job(json.dump());
  return packed;
}

template <typename Job>
PackedTask packed_from(Job job) {
  PackedTask packed;
  Packer paths(packed);
  change(job, paths);
  packed.task.set_job(json_of(job).dump());
  return packed;
}

PackedTask packed_task(const std::string& kind, const path& job, const path& volume) {
  if (kind == "batch") return pack_batch(job, volume);
  if (kind == "attribute") return packed_from(session::read_attribute_job(job));
  if (kind == "isosurface") return packed_from(session::read_isosurface_job(job));
  if (kind == "render") return packed_from(session::read_render_job(job));
  throw unknown_kind(kind);
}

}  // namespace

bool is_task_file_name(std::string_view name) {
  constexpr std::size_t kLongest = 200;
  const auto may_be = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_' || c == '.';
  };
  return !name.empty() && name.size() <= kLongest && name.front() != '.' &&
         std::all_of(name.begin(), name.end(), may_be);
}

path PackedTask::place_of(std::string_view name) const {
  if (is_task_file_name(name)) {
    for (const TaskFile& each : out) {
      if (each.name == name) return each.path;
    }
    const std::string head = out_numbered.name + "-";
    if (!out_numbered.path.empty() && name.starts_with(head)) {
      path numbered = out_numbered.path;
      numbered += name.substr(out_numbered.name.size());
      return numbered;
    }
    if (!out_folder.empty()) return out_folder / name;
  }
  throw Error(ErrorCode::kEngine, fmt::format("the engine sent a file '{}' that nobody asked for", name),
              "use an engine of the same version");
}

PackedTask pack_task(const std::string& kind, const path& job, const path& volume) {
  PackedTask packed = packed_task(kind, job, volume);
  packed.task.set_kind(kind);
  return packed;
}

session::JobFiles unpack_task(const v1::Task& task, const path& folder, const FindVolume& find_volume) {
  Unpacker paths(task, folder, find_volume);
  const std::string what = "the task";
  if (task.kind() == "batch") return unpacked_batch(task, paths);
  if (task.kind() == "attribute") return unpacked(session::attribute_job_from(parsed(task), what), paths);
  if (task.kind() == "isosurface") return unpacked(session::isosurface_job_from(parsed(task), what), paths);
  if (task.kind() == "render") return unpacked(session::render_job_from(parsed(task), what), paths);
  throw unknown_kind(task.kind());
}

}  // namespace footwall::service
