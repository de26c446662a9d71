// A client of a running engine. Safe to use from one thread at a time; cancel goes through the JobContext.
//
// Every call throws what the engine says (the Error with its code, message and hint), kCancelled, or kEngine
// when the engine is gone, within 2 s of its death: "the engine has ended" with what to do.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/service/client/connection_file.h"
#include "engine/service/engine.pb.h"
#include "storage/base/job_context.h"

namespace footwall::service {

class EngineClient {
 public:
  // Connects, and asks for the status once: throws kEngine where nobody answers within 2 s, kInvalid for a
  // wrong token or certificate.
  explicit EngineClient(const Connection& connection);
  ~EngineClient();
  EngineClient(const EngineClient&) = delete;
  EngineClient& operator=(const EngineClient&) = delete;

  v1::StatusReply status();
  bool cancel(std::uint64_t job);
  void shutdown();

  v1::OpenVolumeInfo open_volume(const v1::VolumeName& volume, const JobContext& job);
  void close_volume(const std::string& volume);
  v1::EditModelReply edit(const v1::EditBatch& batch);
  v1::Faces model(std::span<const std::int64_t> faults = {});
  v1::ExtractDone extract(const v1::ExtractRequest& request,
                          const std::function<void(const v1::FaceNumbers&)>& numbers, const JobContext& job);
  std::vector<v1::FaceVoxelsReply> face_voxels(const v1::FaceVoxelsRequest& request);
  std::vector<float> read_box(const v1::ReadBoxRequest& request, const JobContext& job);
  v1::IsosurfaceDone isosurface(const v1::IsosurfaceRequest& request,
                                const std::function<void(const v1::SurfacePiece&)>& piece,
                                const JobContext& job);
  v1::RenderDone render(const v1::RenderRequest& request,
                        const std::function<void(const v1::RenderReply&)>& part, const JobContext& job);

  // A stream of edits and answers. Answers come on a thread of the stream.
  class LiveStream {
   public:
    virtual ~LiveStream() = default;
    // Does not wait for the answer. Throws kEngine, or the Error that ended the stream.
    virtual void send(const v1::EditBatch& batch) = 0;
    // Whether it has ended, by an Error that finish() throws.
    virtual bool has_ended() const = 0;
    // send() where it has not; false where it has.
    virtual bool offer(const v1::EditBatch& batch) = 0;
    // No more edits; waits for the answers on the way.
    virtual void finish() = 0;
  };
  std::unique_ptr<LiveStream> live(const std::string& volume, const v1::ExtractOptions& options,
                                   std::function<void(const v1::LiveReply&)> answer);

  // A job of the command line. in: name and bytes of the files that it needs; out: called for each file that
  // it made, piece by piece. Returns result.json.
  struct InputFile {
    std::string name;
    std::string path;
  };
  std::string run_task(const v1::Task& task, std::span<const InputFile> in,
                       const std::function<void(const v1::FilePiece&)>& out, const JobContext& job);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace footwall::service
