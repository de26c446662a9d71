#include "engine/tasks/detail/bench_service_live_moves.h"

#include <chrono>
#include <set>

#include "engine/service/wire.h"
#include "engine/tasks/detail/bench_service_inputs.h"

namespace footwall::tasks {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kLook(20);
constexpr std::chrono::seconds kPatience(60);

void add(const mesh::Operation& operation, v1::EditBatch& batch) {
  const auto bytes = mesh::encode(std::span(&operation, 1));
  batch.add_edits()->set_mesh(bytes.data(), bytes.size());
}

void take(const v1::FaceNumbers& from, FaceNumbers& into) {
  for (const service::NumberedFace& each : service::numbers_from(from))
    into.insert_or_assign(each.face, each.statistics);
}

}  // namespace

v1::ExtractOptions live_options() {
  v1::ExtractOptions options;
  for (const char* each : {"count", "mean", "variance", "contrast"}) options.add_compute(each);
  return options;
}

LiveMoves::LiveMoves(service::EngineClient& client, std::string volume, std::int64_t faces,
                     const JobContext& job)
    : client_(client),
      volume_(std::move(volume)),
      job_(job),
      grower_(kBenchDims, kBenchArea, kBenchDistance, kBenchSeed) {
  for (int n = 0; n < kBenchMeshes; ++n) {
    job_.check();
    grower_.grow((faces + kBenchMeshes - 1) / kBenchMeshes, meshes_, made_);
  }
  meshes_.take_changes();
  client_.edit(as_made());
  v1::ExtractRequest all;
  all.set_volume(volume_);
  *all.mutable_options() = live_options();
  client_.extract(
      all, [&](const v1::FaceNumbers& numbers) { take(numbers, numbers_); }, job_);
  stream_ = client_.live(volume_, live_options(), [this](const v1::LiveReply& reply) { answered(reply); });
}

LiveMoves::~LiveMoves() = default;

v1::EditBatch LiveMoves::as_made() const {
  v1::EditBatch batch;
  for (const mesh::Operation& each : made_) add(each, batch);
  return batch;
}

v1::EditBatch LiveMoves::as_moved() const {
  v1::EditBatch batch;
  for (mesh::MeshId id = 0; id < meshes_.mesh_limit(); ++id) {
    const mesh::Mesh& mesh = meshes_.mesh(id);
    for (mesh::VertexId vertex = 0; vertex < mesh.vertex_limit(); ++vertex) {
      const survey::IndexPoint p = mesh.position(vertex);
      constexpr double kUnits = survey::kLatticePerVoxel;  // positions are on the lattice: exact
      add(mesh::MoveVertex{id,
                           vertex,
                           {static_cast<std::int32_t>(p.i * kUnits), static_cast<std::int32_t>(p.j * kUnits),
                            static_cast<std::int32_t>(p.k * kUnits)}},
          batch);
    }
  }
  return batch;
}

mesh::Operation LiveMoves::next_move() {
  const auto id = static_cast<mesh::MeshId>(random_() % static_cast<std::uint64_t>(meshes_.mesh_limit()));
  const mesh::Mesh& mesh = meshes_.mesh(id);
  const auto vertex =
      static_cast<mesh::VertexId>(random_() % static_cast<std::uint64_t>(mesh.vertex_limit()));
  const mesh::MoveVertex move{id, vertex, grower_.moved(mesh.position(vertex))};
  meshes_.apply(move);
  return move;
}

LiveMoves::Answer LiveMoves::move_one() {
  v1::EditBatch batch;
  add(next_move(), batch);
  meshes_.take_changes();
  return send(batch);
}

LiveMoves::Answer LiveMoves::move_until(std::int64_t faces) {
  v1::EditBatch batch;
  std::set<mesh::FaceKey> touched;
  while (static_cast<std::int64_t>(touched.size()) < faces) {
    add(next_move(), batch);
    const mesh::Changes changes = meshes_.take_changes();
    touched.insert(changes.changed.begin(), changes.changed.end());
  }
  return send(batch);
}

LiveMoves::Answer LiveMoves::send(const v1::EditBatch& batch) {
  std::unique_lock lock(mutex_);
  waits_ = true;
  answer_ = {};
  const auto begun = Clock::now();
  lock.unlock();
  stream_->send(batch);
  lock.lock();
  while (waits_) {
    changed_.wait_for(lock, kLook);
    job_.check();
    if (Clock::now() < begun + kPatience) continue;
    lock.unlock();
    stream_->finish();  // throws where the stream has failed
    throw Error(ErrorCode::kEngine, "an edit was not answered within a minute");
  }
  if (!refusal_.empty()) throw Error(ErrorCode::kInternal, "the engine refused an edit: " + refusal_);
  answer_.seconds = std::chrono::duration<double>(Clock::now() - begun).count();
  return answer_;
}

void LiveMoves::answered(const v1::LiveReply& reply) {
  const std::scoped_lock lock(mutex_);
  if (reply.has_failure()) refusal_ = reply.failure().message();
  take(reply.numbers(), numbers_);
  answer_.engine_seconds = reply.engine_seconds();
  answer_.faces = reply.numbers().count_size();
  waits_ = false;
  changed_.notify_all();
}

void LiveMoves::finish() {
  stream_->finish();
  stream_.reset();
}

}  // namespace footwall::tasks
