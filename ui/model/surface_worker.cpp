#include "ui/model/surface_worker.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>
#include <utility>

#include "engine/extract/face_geometry.h"
#include "engine/extract/fault_side.h"
#include "engine/tasks/fault_faces.h"
#include "storage/base/error.h"

namespace footwall::ui {
namespace {

void set_geometry(const survey::Geometry& survey, const std::optional<double>& velocity,
                  FaultSurface& surface) {
  using Geometry = extract::FaceGeometry;
  constexpr std::pair<const char*, double Geometry::*> kColumns[] = {
      {"area_voxels", &Geometry::area_voxels},
      {"area", &Geometry::area},
      {"dip", &Geometry::dip},
      {"dip_azimuth", &Geometry::dip_azimuth},
      {"metres_along_normal", &Geometry::metres_along_normal}};
  std::vector<std::vector<double>*> columns;
  for (const auto& [name, member] : kColumns) {
    columns.push_back(&surface.geometry[name]);
    columns.back()->resize(surface.faces.size());
  }
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    const Geometry geometry = extract::face_geometry(survey, surface.lattice[f], velocity);
    for (std::size_t c = 0; c < columns.size(); ++c) (*columns[c])[f] = geometry.*kColumns[c].second;
  }
}

bool is_before(const project::MeshFace& a, const project::MeshFace& b) {
  return std::pair(a.panel, a.n) < std::pair(b.panel, b.n);
}

void sort_names(FaultSurface& surface) {
  if (std::ranges::is_sorted(surface.faces, is_before)) return;
  surface.by_name.resize(surface.faces.size());
  std::iota(surface.by_name.begin(), surface.by_name.end(), 0U);
  std::ranges::sort(surface.by_name, [&](std::uint32_t a, std::uint32_t b) {
    return is_before(surface.faces[a], surface.faces[b]);
  });
}

tasks::TriangulateOptions options_of(const project::MeshRecord& mesh) {
  tasks::TriangulateOptions options;
  const auto json = nlohmann::json::parse(mesh.parameters, nullptr, false);
  if (!json.is_object()) return options;
  const auto take = [&json](const char* name, double& into) {
    const auto found = json.find(name);
    if (found != json.end() && found->is_number() && found->get<double>() > 0) into = found->get<double>();
  };
  take("detail", options.detail);
  take("max_edge", options.max_edge);
  take("tie", options.tie);
  return options;
}

// What the last run that has the fault says of it.
std::optional<project::FaultRun> last_run_of(const project::Project& project, Id fault,
                                             const std::optional<std::string>& volume) {
  const auto runs = project.runs();
  for (auto run = runs.rbegin(); run != runs.rend(); ++run) {
    if (volume && run->volume_checksum != *volume) continue;
    const auto faults = project.run_faults(run->id);
    if (std::ranges::find(faults, fault) != faults.end()) return project.fault_statistics(run->id, fault);
  }
  return std::nullopt;
}

}  // namespace

std::size_t FaultSurface::place_of(Id panel, std::int32_t n, std::size_t guess) const {
  const auto is_it = [&](std::size_t f) { return faces[f].panel == panel && faces[f].n == n; };
  if (guess < faces.size() && is_it(guess)) return guess;
  const project::MeshFace wanted{.panel = panel, .n = n, .vertices = {}};
  if (by_name.empty()) {
    const auto found =
        static_cast<std::size_t>(std::ranges::lower_bound(faces, wanted, is_before) - faces.begin());
    return found < faces.size() && is_it(found) ? found : faces.size();
  }
  const auto found =
      std::ranges::lower_bound(by_name, wanted, is_before, [&](std::uint32_t f) { return faces[f]; });
  return found != by_name.end() && is_it(*found) ? *found : faces.size();
}

std::shared_ptr<const FaultSurface> surface_of(const survey::Geometry& survey,
                                               const project::FaultRecord& fault,
                                               const project::MeshRecord& mesh, bool provisional,
                                               const std::optional<double>& velocity) {
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
  set_geometry(survey, velocity, *surface);
  sort_names(*surface);
  return surface;
}

SurfaceWorker::SurfaceWorker(project::Project project, survey::Geometry survey,
                             std::function<void(MadeSurface)> made)
    : project_(std::move(project)),
      survey_(std::move(survey)),
      made_(std::move(made)),
      thread_([this] { work(); }) {}

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

// A fault without pillars is an imported surface.
project::MeshRecord SurfaceWorker::mesh_for(const SurfaceRequest& request, MadeSurface& made) {
  const Id fault = request.fault.id;
  std::optional<project::MeshRecord> former;
  if (request.stored || !request.options) former = project_.mesh(fault);
  made.options = request.options ? *request.options
                 : former        ? options_of(*former)
                                 : tasks::TriangulateOptions{};
  made.chart = request.chart.empty() && former ? former->chart : request.chart;
  if (request.stored) made.run = last_run_of(project_, fault, request.volume);
  if (request.stored && former && former->revision == request.fault.revision &&
      !project_.mesh_is_stale(fault)) {
    return std::move(*former);
  }
  std::vector<std::string> notes;
  project::MeshRecord mesh = request.pillars.empty()
                                 ? tasks::mesh_of_fault(project_, request.fault, made.options, job_, &notes)
                                 : tasks::mesh_of_pillars(survey_, request.fault, request.pillars, made.chart,
                                                          made.options, job_, &notes);
  for (const std::string& note : notes) made.problem += (made.problem.empty() ? "" : "\n") + note;
  made.chart = mesh.chart;  // the one that served
  if (!request.provisional) keep(request, mesh, made);
  return mesh;
}

// Unless the fault is gone or has another shape by now: the next request brings its mesh.
void SurfaceWorker::keep(const SurfaceRequest& request, const project::MeshRecord& mesh, MadeSurface& made) {
  if (project_.read_only()) return;
  try {
    if (project_.fault(request.fault.id).revision != mesh.revision) return;
    project_.store_mesh(request.fault.id, mesh);
    made.kept = true;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kNotFound)
      made.problem = "its mesh could not be stored: " + error.message();
  }
}

void SurfaceWorker::make(const SurfaceRequest& request) {
  MadeSurface made;
  made.number = request.number;
  made.fault = request.fault.id;
  try {
    const project::MeshRecord mesh = mesh_for(request, made);
    made.surface = surface_of(survey_, request.fault, mesh, request.provisional, request.velocity);
  } catch (const Error& error) {
    if (error.code() == ErrorCode::kCancelled) return;
    made.problem = error.hint().empty() ? error.message() : error.message() + ": " + error.hint();
  }
  made_(std::move(made));
}

}  // namespace footwall::ui
