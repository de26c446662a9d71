// A job of the command line on its way to a running engine, with which it need not share any file: its paths
// become "@volume/CHECKSUM", "@in/NAME" and "@out/NAME" (engine.proto, Task), and paths again over there.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/service/engine.pb.h"
#include "engine/session/job.h"

namespace footwall::service {

struct TaskFile {
  std::string name;  // letters, digits, "-", "_" and "."; none in front
  std::filesystem::path path;
};

// What a client sends, and where what comes back goes.
struct PackedTask {
  v1::Task task;
  std::vector<TaskFile> in;   // to be sent with it
  std::vector<TaskFile> out;  // files that come back under these very names
  TaskFile out_numbered;      // names that begin with this one's and a "-": the rest is added to its path
  std::filesystem::path out_folder;  // where other files go, under their names; empty: there are none
  std::filesystem::path result;      // where "result.json" goes; in `out`, too

  // Where a file that came back under this name goes. Throws Error kEngine for a name that does not belong to
  // the task, or is none: an engine cannot write where the job does not.
  std::filesystem::path place_of(std::string_view name) const;
};

// kind: "batch", "attribute", "isosurface" or "render"; job: its file, as written by session::write_*job().
// Parts of an earlier run of a batch job are sent along, up to 900 files and 512 MiB.
// volume: where the volume of a batch job is here; empty: where the job says. Reads the volumes' checksums
// from their files. Throws Error kUnsupported for another kind, and what reading jobs and volumes throws.
PackedTask pack_task(const std::string& kind, const std::filesystem::path& job,
                     const std::filesystem::path& volume = {});

// The engine's file of a volume. Throws Error kNotFound.
using FindVolume = std::function<std::filesystem::path(const v1::VolumeName&)>;

// The other way, on the engine's side: the job's file with real paths in it, as session::*_job_from() and
// session::parse_job() read it; and, of a batch job, its faces. folder has in/ and out/, absolute.
// Nothing of the task but the three forms above becomes a path: throws Error kInvalid for anything else,
// kUnsupported for a kind that is not known, kNotFound, and what reading jobs throws.
session::JobFiles unpack_task(const v1::Task& task, const std::filesystem::path& folder,
                              const FindVolume& find_volume);

// Whether a file of a task may have this name: 1 to 200 letters, digits, "-", "_" and ".", none in front.
bool is_task_file_name(std::string_view name);

}  // namespace footwall::service
