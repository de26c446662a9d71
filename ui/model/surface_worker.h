// Triangulates on a thread of its own. Of each fault only the newest request is done.
#pragma once
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
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
  tasks::TriangulateOptions options;
  bool provisional = false;
  bool urgent = false;  // before those that are not
};

struct MadeSurface {
  std::uint64_t number = 0;
  Id fault = 0;
  std::shared_ptr<const FaultSurface> surface;  // null where there is none
  project::MeshRecord mesh;
  std::string problem;  // why, or what the user should know
};

// Vertices and faces of a stored mesh, as views want them.
std::shared_ptr<const FaultSurface> surface_of(const survey::Geometry& survey, const project::FaultRecord& fault,
                                               const project::MeshRecord& mesh, bool provisional);

class SurfaceWorker {
 public:
  // made: called on the worker's thread.
  SurfaceWorker(survey::Geometry survey, std::function<void(MadeSurface)> made);
  // Waits for the one under way, which is cancelled.
  ~SurfaceWorker();
  SurfaceWorker(const SurfaceWorker&) = delete;
  SurfaceWorker& operator=(const SurfaceWorker&) = delete;

  void ask(SurfaceRequest request);
  void forget(Id fault);

 private:
  void work();
  void make(const SurfaceRequest& request);

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
