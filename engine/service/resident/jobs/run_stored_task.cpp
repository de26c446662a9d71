#include "engine/service/resident/jobs/run_stored_task.h"

#include <omp.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/comm/shared_text.h"
#include "engine/session/attribute.h"
#include "engine/session/batch.h"
#include "engine/session/isosurface_job.h"
#include "engine/session/render_job.h"
#include "storage/base/error.h"
#include "storage/base/partial_file.h"

namespace footwall::service {
namespace {

using Json = nlohmann::json;
using std::filesystem::path;

constexpr std::size_t kPiece = std::size_t{1} << 20;
constexpr const char* kResult = "result.json";

// Removes what is in in/ and out/, whatever happens, on the rank that has them.
class Emptied {
 public:
  explicit Emptied(path folder) : folder_(std::move(folder)) {}
  ~Emptied() {
    if (folder_.empty()) return;
    for (const char* part : {"in", "out"}) {
      std::error_code ignored;
      for (const auto& entry : std::filesystem::directory_iterator(folder_ / part, ignored)) {
        std::error_code kept;
        std::filesystem::remove_all(entry.path(), kept);
      }
    }
  }
  Emptied(const Emptied&) = delete;
  Emptied& operator=(const Emptied&) = delete;

 private:
  path folder_;
};

std::vector<std::string> names_in(const path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::string name = entry.path().filename().string();
    if (entry.is_regular_file() && is_task_file_name(name)) names.push_back(std::move(name));
  }
  std::sort(names.begin(), names.end(), [](const std::string& a, const std::string& b) {
    return std::pair(a == kResult, std::string_view(a)) < std::pair(b == kResult, std::string_view(b));
  });
  return names;
}

// A file of any size in pieces; an empty one is one empty piece.
void send_file(const path& file, const std::string& name, const Send& send, const JobContext& job) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw io_error("read", file.string(), errno);
  auto left = static_cast<std::uint64_t>(std::filesystem::file_size(file));
  do {
    job.check();
    v1::TaskOutput output;
    v1::FilePiece& piece = *output.mutable_file();
    piece.set_name(name);
    std::string& bytes = *piece.mutable_bytes();
    bytes.resize(std::min<std::uint64_t>(left, kPiece));
    if (!stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) {
      throw io_error("read", file.string(), errno);
    }
    left -= bytes.size();
    piece.set_last(left == 0);
    send(output);
  } while (left > 0);
}

void refuse_unseen(bool seen, const char* what) {
  if (seen) return;
  throw Error(
      ErrorCode::kUnsupported,
      std::string("the hosts of this engine share no folder, and ") + what + " is written by all of them",
      "start the engine with a folder that all hosts see, or give the command fewer hosts");
}

}  // namespace

bool all_ranks_see(const comm::Communicator& world, const path& folder) {
  const std::string name = comm::shared_text(world, world.collectively([&] {
    if (world.rank() != 0) return std::string();
    const path mark = folder / (".seen-" + std::to_string(::getpid()));
    write_whole_file(mark, "x");
    return mark.string();
  }));
  std::error_code ignored;
  const bool all = world.maximum(std::int64_t{std::filesystem::exists(name, ignored) ? 0 : 1}) == 0;
  if (world.rank() == 0) std::filesystem::remove(name, ignored);
  return all;
}

void run_stored_task(const comm::Communicator& world, const v1::StoredTask& stored,
                     const FindVolume& find_volume, int threads, const Send& send, const JobContext& job) {
  const v1::Task& task = stored.task();
  const path folder = stored.folder();
  const Emptied emptied(world.rank() == 0 ? folder : path());

  // 1. Rank 0 turns the task into a job with paths; all ranks read it.
  session::JobFiles files = world.collectively(
      [&] { return world.rank() == 0 ? unpack_task(task, folder, find_volume) : session::JobFiles{}; });
  const bool seen = all_ranks_see(world, folder / "out");
  const JobContext most = job.part(0, 0.95);
  // Of a batch job: parts that the client has.
  std::set<std::string> sent;

  // 2. Run it.
  omp_set_num_threads(threads);
  if (task.kind() == "batch") {
    if (world.rank() == 0) {
      for (const std::string& name : names_in(folder / "out"))
        if (name.ends_with(".part.h5")) sent.insert(name);
    }
    session::BatchOptions options;
    options.threads = threads;
    options.one_writer = !seen;
    // Parts go as they come, so that the client has them whatever becomes of the rest.
    options.part_written = [&](const path& part) {
      send_file(part, part.filename().string(), send, job);
      sent.insert(part.filename().string());
    };
    session::run_batch(world, files, folder / "JOB.json", most, options);
  } else {
    const std::string text = comm::shared_text(world, files.json);
    const std::string what = "the task";
    if (task.kind() == "attribute") {
      const auto made = world.collectively([&] {
        refuse_unseen(seen, "an attribute volume");
        return session::attribute_job_from(Json::parse(text), what);
      });
      session::run_attribute(world, made, most);
    } else if (task.kind() == "isosurface") {
      const auto wanted = world.collectively([&] {
        session::IsosurfaceJob parsed = session::isosurface_job_from(Json::parse(text), what);
        refuse_unseen(seen || parsed.output.empty(), "the file of an isosurface");
        return parsed;
      });
      session::run_isosurface(world, wanted, most);
    } else {
      const auto drawn = world.collectively([&] {
        session::RenderJob parsed = session::render_job_from(Json::parse(text), what);
        parsed.threads = threads;
        return parsed;
      });
      session::run_render(world, drawn, most);
    }
  }

  // 3. What it made, from rank 0.
  world.collectively([&] {
    if (world.rank() != 0) return;
    const std::vector<std::string> names = names_in(folder / "out");
    for (std::size_t n = 0; n < names.size(); ++n) {
      if (sent.contains(names[n])) continue;
      job.report(0.95 + 0.05 * static_cast<double>(n) / static_cast<double>(names.size()), "send");
      send_file(folder / "out" / names[n], names[n], send, job);
    }
  });
}

}  // namespace footwall::service
