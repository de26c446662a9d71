// A client that moves vertices of benchmark 2's model, one batch after the other, over an engine's Live
// stream, and keeps the numbers of all faces as they come.
#pragma once
#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <random>
#include <string>

#include "engine/extract/face_changes.h"
#include "engine/mesh/model.h"
#include "engine/service/client/engine_client.h"
#include "engine/tasks/workload/grow.h"
#include "storage/base/job_context.h"

namespace footwall::tasks {

// Count, mean, variance, contrast.
v1::ExtractOptions live_options();

using FaceNumbers = std::map<extract::FaceIdentity, extract::FaceStatistics>;

class LiveMoves {
 public:
  // Makes the model, of so many faces at least, in the engine, extracts all of it, and opens the stream. The
  // client must outlive it.
  LiveMoves(service::EngineClient& client, std::string volume, std::int64_t faces, const JobContext& job);
  ~LiveMoves();
  LiveMoves(const LiveMoves&) = delete;
  LiveMoves& operator=(const LiveMoves&) = delete;

  struct Answer {
    double seconds = 0;         // from the call to the new numbers
    double engine_seconds = 0;  // of them, as the engine says
    std::int64_t faces = 0;     // that were extracted
  };
  // Moves one vertex.
  Answer move_one();
  // Moves vertices until so many faces are touched.
  Answer move_until(std::int64_t faces);
  // Ends the stream in order.
  void finish();

  // What makes the same model anew: its operations, and where all vertices stand now.
  v1::EditBatch as_made() const;
  v1::EditBatch as_moved() const;
  const mesh::MeshSet& meshes() const { return meshes_; }
  const FaceNumbers& numbers() const { return numbers_; }
  const std::string& volume() const { return volume_; }

 private:
  mesh::Operation next_move();
  Answer send(const v1::EditBatch& batch);
  void answered(const v1::LiveReply& reply);

  service::EngineClient& client_;
  std::string volume_;
  JobContext job_;
  Grower grower_;
  std::mt19937_64 random_{7};
  mesh::MeshSet meshes_;
  std::vector<mesh::Operation> made_;
  FaceNumbers numbers_;

  std::mutex mutex_;
  std::condition_variable changed_;
  bool waits_ = false;
  Answer answer_;
  std::string refusal_;
  std::unique_ptr<service::EngineClient::LiveStream> stream_;
};

}  // namespace footwall::tasks
