#include "ui/model/surface_worker.h"

#include <algorithm>
#include <utility>

#include "engine/extract/fault_side.h"
#include "engine/tasks/fault_faces.h"
#include "storage/base/error.h"

namespace footwall::ui {

std::shared_ptr<const FaultSurface> surface_of(const survey::Geometry& survey, const project::FaultRecord& fault,
                                               const project::MeshRecord& mesh, bool provisional) {
  auto surface = std::make_shared<FaultSurface>();
  surface->fault = fault.id;
  surface->revision = mesh.revision;
  surface->provisional = provisional;
  surface->vertices.reserve(mesh.vertices.size());
  surface->places.reserve(mesh.vertices.size());
  for (const project::MeshVertex& vertex : mesh.vertices) {
    surface->vertices.push_back(vertex.position);
    surface->places.push_back(survey.index_of(vertex.position));
    surface->pillars.push_back(vertex.kind == project::MeshVertex::Owner::kPillar ? vertex.owner : 0);
  }
  surface->faces = mesh.faces;
  surface->lattice.reserve(mesh.faces.size());
  for (const extract::Face& face : tasks::fault_faces(fault, mesh, survey::Lattice(survey), {0, 0, 0})) {
    surface->lattice.push_back(face.triangle);
  }
  surface->side = extract::fault_side(surface->lattice);
  return surface;
}

SurfaceWorker::SurfaceWorker(survey::Geometry survey, std::function<void(MadeSurface)> made)
    : survey_(std::move(survey)), made_(std::move(made)), thread_([this] { work(); }) {}

SurfaceWorker::~SurfaceWorker() {
  job_.cancel();
  {
    const std::scoped_lock lock(mutex_);
    ends_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void SurfaceWorker::ask(SurfaceRequest request) {
  {
    const std::scoped_lock lock(mutex_);
    waiting_.remove_if([&](const SurfaceRequest& other) { return other.fault.id == request.fault.id; });
    if (request.urgent) {
      waiting_.push_front(std::move(request));
    } else {
      waiting_.push_back(std::move(request));
    }
  }
  wake_.notify_one();
}

void SurfaceWorker::forget(Id fault) {
  const std::scoped_lock lock(mutex_);
  waiting_.remove_if([&](const SurfaceRequest& other) { return other.fault.id == fault; });
}

void SurfaceWorker::work() {
  for (;;) {
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [this] { return ends_ || !waiting_.empty(); });
    if (ends_) return;
    const SurfaceRequest request = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    make(request);
  }
}

void SurfaceWorker::make(const SurfaceRequest& request) {
  MadeSurface made;
  made.number = request.number;
  made.fault = request.fault.id;
  try {
    std::vector<std::string> notes;
    made.mesh = tasks::mesh_of_pillars(survey_, request.fault, request.pillars, request.chart, request.options, job_,
                                       &notes);
    made.surface = surface_of(survey_, request.fault, made.mesh, request.provisional);
    for (const std::string& note : notes) made.problem += (made.problem.empty() ? "" : "\n") + note;
  } catch (const Error& error) {
    if (error.code() == ErrorCode::kCancelled) return;
    made.problem = error.hint().empty() ? error.message() : error.message() + ": " + error.hint();
  }
  made_(std::move(made));
}

}  // namespace footwall::ui
