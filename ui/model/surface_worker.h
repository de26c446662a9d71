// Triangulates, and reads and keeps meshes, on a thread and a connection to the project of its own. Of each
// fault only the newest request is done.
#pragma once
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "engine/tasks/triangulate.h"
#include "ui/model/surfaces.h"

namespace footwall::ui {

struct SurfaceRequest {
  std::uint64_t number = 0;
  project::FaultRecord fault;
  std::vector<survey::Pillar> pillars;
  project::Bytes chart;
  std::optional<tasks::TriangulateOptions> options;  // none: those of the stored mesh
  std::optional<double> velocity;
  std::optional<std::string> volume;  // checksum of the volume that a run's numbers must be of; none: of any
  bool provisional = false;
  bool urgent = false;  // before those that are not
  bool stored = false;  // the mesh of the project will do where it is fresh, with what the last run of the
                        // volume says of its faces
};

struct MadeSurface {
  std::uint64_t number = 0;
  Id fault = 0;
  std::shared_ptr<const FaultSurface> surface;  // null where there is none
  project::Bytes chart;
  tasks::TriangulateOptions options;
  bool kept = false;    // the project has a new mesh
  std::string problem;  // why, or what the user should know
  std::optional<project::FaultRun> run;
};

// Vertices and faces of a stored mesh, as views want them.
std::shared_ptr<const FaultSurface> surface_of(const survey::Geometry& survey,
                                               const project::FaultRecord& fault,
                                               const project::MeshRecord& mesh, bool provisional,
                                               const std::optional<double>& velocity);

class SurfaceWorker {
 public:
  // made: called on the worker's thread.
  SurfaceWorker(project::Project project, survey::Geometry survey, std::function<void(MadeSurface)> made);
  // Waits for the one under way, which is cancelled.
  ~SurfaceWorker();
  SurfaceWorker(const SurfaceWorker&) = delete;
  SurfaceWorker& operator=(const SurfaceWorker&) = delete;

  void ask(SurfaceRequest request);
  void forget(Id fault);

 private:
  void work();
  void make(const SurfaceRequest& request);
  project::MeshRecord mesh_for(const SurfaceRequest& request, MadeSurface& made);
  void keep(const SurfaceRequest& request, const project::MeshRecord& mesh, MadeSurface& made);

  project::Project project_;  // of the thread
  const survey::Geometry survey_;
  const std::function<void(MadeSurface)> made_;
  JobContext job_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::list<SurfaceRequest> waiting_;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace footwall::ui
