#include "engine/service/client/running_tasks.h"

#include <unistd.h>

#include <fstream>
#include <map>
#include <vector>

#include "engine/service/client/engine_client.h"
#include "engine/service/task_files.h"
#include "engine/session/batch.h"
#include "storage/base/error.h"
#include "storage/base/partial_file.h"

namespace footwall::service {
namespace {

std::string own_host() {
  char host[256] = "";
  if (gethostname(host, sizeof host - 1) != 0) throw io_error("ask for the name of", "this host", errno);
  return host;
}

// What the engine sends, beside its places until everything is there; but for what a later run goes on with.
class Outputs {
 public:
  explicit Outputs(const PackedTask& task) : task_(task) {}

  void take(const v1::FilePiece& piece) {
    if (name_ != piece.name()) begin(piece.name());
    out_.write(piece.bytes().data(), static_cast<std::streamsize>(piece.bytes().size()));
    if (piece.last()) out_.close();
    if (!out_) throw io_error("write", files_.back()->path().string(), errno);
    if (!piece.last()) return;
    if (!task_.out_folder.empty() && session::goes_on_with(name_)) {
      // The result of an earlier run does not speak of this part.
      std::filesystem::remove(task_.result);
      files_.back()->commit();
      files_.pop_back();
    }
    name_.clear();
  }
  void commit() {
    if (!name_.empty()) throw Error(ErrorCode::kEngine, "the engine sent half of " + name_);
    for (const auto& file : files_) file->commit();
  }

 private:
  void begin(const std::string& name) {
    if (!name_.empty()) throw Error(ErrorCode::kEngine, "the engine sent half of " + name_);
    const std::filesystem::path place = task_.place_of(name);
    if (!task_.out_folder.empty()) std::filesystem::create_directories(place.parent_path());
    files_.push_back(std::make_unique<PartialFile>(place));
    out_ = std::ofstream(files_.back()->path(), std::ios::binary);
    if (!out_) throw io_error("write", files_.back()->path().string(), errno);
    name_ = name;
  }

  const PackedTask& task_;
  std::vector<std::unique_ptr<PartialFile>> files_;
  std::ofstream out_;
  std::string name_;  // of the file that is being received
};

class RunningTasks final : public session::RunningEngine {
 public:
  explicit RunningTasks(const Connection& connection) : connection_(connection) {}

  std::string run(const session::EngineTask& task, const session::LaunchOptions& options,
                  const JobContext& job) override {
    require(task.words.size() >= 2, "a command and its job");
    PackedTask packed = pack_task(task.words[0], task.words[1], options.volume);
    EngineClient client(connection_);
    if (client.status().host() != own_host()) {
      for (v1::VolumeName& volume : *packed.task.mutable_volumes()) volume.clear_path();
    }
    std::vector<EngineClient::InputFile> in;
    for (const TaskFile& file : packed.in) in.push_back({file.name, file.path.string()});
    Outputs outputs(packed);
    std::string result = client.run_task(
        packed.task, in, [&](const v1::FilePiece& piece) { outputs.take(piece); }, job);
    job.check();
    if (result.empty()) throw Error(ErrorCode::kEngine, "the engine ended the job without a result");
    outputs.commit();
    return result;
  }

 private:
  Connection connection_;
};

}  // namespace

std::shared_ptr<session::RunningEngine> running_tasks(const Connection& connection) {
  return std::make_shared<RunningTasks>(connection);
}

}  // namespace footwall::service
