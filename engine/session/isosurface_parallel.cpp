#include <mpi.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/isosurface/parallel/choose_pillars.h"
#include "engine/isosurface/parallel/collect.h"
#include "engine/isosurface/parallel/mesh_properties.h"
#include "engine/isosurface/parallel/stored_samples.h"
#include "engine/isosurface/parallel/weld.h"
#include "engine/isosurface/registry.h"
#include "engine/session/group_options.h"
#include "engine/session/isosurface_job.h"
#include "engine/session/visible_mesh.h"
#include "engine/session/visible_surface.h"
#include "storage/base/hash.h"
#include "storage/base/partial_file.h"
#include "storage/surface/surface_writer_parallel.h"

namespace footwall::session {
namespace {

using isosurface::Bounds;
using isosurface::MeshPart;
using isosurface::Point;
using isosurface::Triangle;
using Json = nlohmann::json;

// How areas and volumes are told: in metres where heights are, or a velocity makes them so.
struct Units {
  isosurface::Measure measure;
  const char* name = "voxel";
};

Units units_of(const survey::Geometry& geometry, const std::optional<double>& velocity) {
  if (!geometry.has_metric_depth() && !velocity) return {};
  const survey::MapView& map = geometry.map;
  const auto metres = [&](double length) { return geometry.horizontal_metres(length); };
  return {isosurface::Measure({{{metres(map.per_inline_x), metres(map.per_inline_y), 0},
                                {metres(map.per_crossline_x), metres(map.per_crossline_y), 0},
                                {0, 0, geometry.vertical_metres(geometry.interval, velocity.value_or(0))}}}),
          "m"};
}

// Positions, normals and windings as the file has them.
class Frame {
 public:
  Frame(const volume::VolumeInfo& info, bool world) : info_(info), world_(world) {
    const survey::MapView& map = info.geometry.map;
    determinant_ = (map.per_inline_x * map.per_crossline_y - map.per_inline_y * map.per_crossline_x) *
                   info.geometry.interval;
  }
  // Index space is taken for right-handed, and so is the world: X, Y, z as they are written.
  bool turned() const { return world_ && determinant_ < 0; }

  Point index_of(const Point& p) const {
    return {p.i + static_cast<float>(info_.origin[0]), p.j + static_cast<float>(info_.origin[1]),
            p.k + static_cast<float>(info_.origin[2])};
  }
  std::array<double, 3> world_of(const Point& p) const {
    const survey::WorldPoint w = info_.geometry.world_of({p.i, p.j, p.k});
    return {w.x, w.y, w.z};
  }
  Point normal_of(const Point& n) const {
    if (!world_) return n;
    const survey::MapView& map = info_.geometry.map;
    // Normals turn by the inverse transposed map.
    const double sign = determinant_ < 0 ? -1 : 1;
    const double dz = info_.geometry.interval;
    const double x = sign * dz * (n.i * map.per_crossline_y - n.j * map.per_inline_y);
    const double y = sign * dz * (n.j * map.per_inline_x - n.i * map.per_crossline_x);
    const double z = sign * n.k * determinant_ / dz;
    const double length = std::sqrt(x * x + y * y + z * z);
    return {static_cast<float>(x / length), static_cast<float>(y / length), static_cast<float>(z / length)};
  }

 private:
  const volume::VolumeInfo& info_;
  bool world_;
  double determinant_ = 1;
};

class Run {
 public:
  Run(comm::Communicator& world, const IsosurfaceJob& job, const JobContext& context)
      : world_(world), job_(job), context_(context), samples_(world, job.volume) {
    units_ = world.collectively([&] { return units_of(samples_.info().geometry, job.velocity); });
  }

  // 1. Which pillars, and their triangles; or the triangles that can be seen.
  void extract();
  // 2. One mesh, and what it is.
  void weld();
  void measure();
  // 3. The file.
  void write();
  Json result() const;

  void end_of(const char* phase) {
    const double now = omp_get_wtime();
    seconds_[phase] = world_.maximum(now - start_);
    start_ = now;
  }

 private:
  void extract_whole();
  void extract_visible();
  void step(double fraction, const char* phase) {
    world_.collectively([&] { context_.report(fraction, phase); });
  }
  template <class T>
  std::int64_t sum(T value) const {
    return world_.sum(static_cast<std::int64_t>(value));
  }

  comm::Communicator& world_;
  const IsosurfaceJob& job_;
  const JobContext& context_;
  isosurface::StoredSamples samples_;
  Units units_;
  isosurface::Interleaving interleaving_{1, 1, 1};
  std::vector<isosurface::Piece> pieces_;
  std::optional<VisibleSurface> visible_;
  MeshPart part_;
  isosurface::Properties properties_;
  Json seconds_ = Json::object();
  Json counts_ = Json::object();
  double start_ = omp_get_wtime();
};

void Run::extract() {
  if (job_.visible) {
    extract_visible();
  } else {
    extract_whole();
  }
}

void Run::extract_visible() {
  const VisibleView& view = *job_.visible;
  isosurface::VisibleRequest request;
  view.choice.apply_to(request);
  request.isovalue = job_.value;
  request.placement = view.placement;
  request.camera = view.camera;
  request.colour = view.colour;
  request.width = view.width;
  request.height = view.height;
  request.threads = omp_get_max_threads();
  int layers = 0;
  VisibleSurface::AfterPass after_pass;
  if (!view.choice.pass_layers.empty()) {
    after_pass = [&](const render::SurfaceLayer& layer) {
      ++layers;
      world_.collectively([&] {
        if (world_.rank() == 0) layer.write(view.choice.pass_layer(layers));
      });
    };
  }
  visible_.emplace(samples_);
  const DrawnVisible drawn = visible_->draw(world_, request, group_options(world_, 0.1, request.threads),
                                            context_.part(0.02, 0.6), after_pass);
  counts_ = json_of(drawn.report);
  counts_.erase("triangles");
  counts_["mode"] = name_of(view.choice.mode);
  counts_["pass_layers"] = layers;
  counts_["bytes_read"] = sum(samples_.bytes_read());
}

void Run::extract_whole() {
  interleaving_ = world_.collectively([&] {
    if (job_.pillars) return *job_.pillars;
    return isosurface::choose_interleaving(samples_.info().dims, world_.size(), samples_.bricks(), job_.value,
                                           true);
  });
  const auto pillars = isosurface::Pillars(samples_.info().dims, world_.size(), interleaving_);
  isosurface::ParallelOptions options;
  options.kernel = world_.collectively([&] { return isosurface::variant_of(job_.variant).extract; });
  options.kernel_skips = options.kernel == isosurface::variants().front().extract;
  options.keys = true;
  options.cap = job_.cap;
  options.threads = omp_get_max_threads();
  options.bricks = &samples_.bricks();
  isosurface::Extraction extraction;
  isosurface::extract_parallel(world_, pillars, samples_.field_of(), job_.value, options,
                               context_.part(0.02, 0.6), extraction);
  pieces_ = std::move(extraction.pieces);
  const double busy = extraction.busy_seconds;
  double mean = busy / world_.size();
  comm::check(MPI_Allreduce(MPI_IN_PLACE, &mean, 1, MPI_DOUBLE, MPI_SUM, world_.get()), "MPI_Allreduce");
  counts_["busy_seconds"] = {{"mean", mean}, {"max", world_.maximum(busy)}};
  counts_["load_imbalance"] = isosurface::load_imbalance(world_, busy);
  counts_["samples_read"] = sum(extraction.samples_read);
  counts_["bytes_read"] = sum(samples_.bytes_read());
  counts_["overlap_samples"] = pillars.overlap_samples(true);
}

void Run::weld() {
  step(0.6, "weld");
  if (visible_) {
    part_ = visible_mesh(world_, samples_.info().dims, visible_->surfaces());
    visible_.reset();
    return;
  }
  const isosurface::Pillars pillars(samples_.info().dims, world_.size(), interleaving_);
  part_ = isosurface::weld(world_, pillars, true, pieces_);
  counts_["redundant_intersections"] = sum(part_.computed) - static_cast<std::int64_t>(part_.all_vertices);
}

void Run::measure() {
  step(0.7, "measure");
  isosurface::ComponentFilter filter;
  filter.largest = job_.largest;
  filter.min_area = job_.min_area;
  isosurface::MeshProperties found = isosurface::mesh_properties(world_, part_, units_.measure);
  if (!filter.keeps_all()) {
    part_ = isosurface::keep_components(world_, part_, found, units_.measure, filter);
    found = isosurface::mesh_properties(world_, part_, units_.measure);
  }
  properties_ = std::move(found.properties);
}

template <class T>
std::span<const float> floats(const isosurface::PageVector<T>& values) {
  static_assert(sizeof(T) == 3 * sizeof(float));
  return {reinterpret_cast<const float*>(values.data()), values.size() * 3};
}

void Run::write() {
  if (job_.output.empty()) return;
  step(0.8, "write");
  const Frame frame(samples_.info(), job_.world);
  const Bounds vertex_bounds = isosurface::even_bounds(part_.all_vertices, world_.size());
  const Bounds triangle_bounds = isosurface::even_bounds(part_.all_triangles, world_.size());
  const auto own = [&](auto& values) { return std::as_const(values).all().first(part_.own); };
  // What one array needs is gone before the next one is sent.
  auto positions =
      isosurface::collect<Point>(world_, part_.vertex_runs, own(part_.mesh.positions), vertex_bounds);
  part_.mesh.positions.release();
  auto normals =
      isosurface::collect<Point>(world_, part_.vertex_runs, own(part_.mesh.normals), vertex_bounds);
  part_.mesh.normals.release();
  for (Triangle& triangle : part_.mesh.triangles.all()) {
    triangle = {part_.numbers[triangle[0]], part_.numbers[triangle[1]], part_.numbers[triangle[2]]};
    if (frame.turned()) std::swap(triangle[1], triangle[2]);
  }
  auto triangles = isosurface::collect<Triangle>(world_, part_.triangle_runs,
                                                 std::as_const(part_.mesh.triangles).all(), triangle_bounds);
  part_.mesh.triangles.release();
  step(0.9, "write");

  const auto rank = static_cast<std::size_t>(world_.rank());
  std::vector<double> world_positions;
  world_.collectively([&] {
    for (Point& normal : normals.all()) normal = frame.normal_of(normal);
    if (job_.world) {
      world_positions.reserve(positions.size() * 3);
      for (const Point& point : positions.all()) {
        const std::array<double, 3> place = frame.world_of(point);
        world_positions.insert(world_positions.end(), place.begin(), place.end());
      }
    } else {
      for (Point& point : positions.all()) point = frame.index_of(point);
    }
  });
  surface::SurfaceShare share;
  share.first_vertex = vertex_bounds[rank];
  share.first_triangle = triangle_bounds[rank];
  share.world_positions = world_positions;
  if (!job_.world) share.positions = floats(positions);
  share.normals = floats(normals);
  share.triangles = {reinterpret_cast<const std::uint32_t*>(triangles.data()), triangles.size() * 3};
  Json description{{"isosurface", {{"value", job_.value}, {"capped", job_.cap}}},
                   {"volume",
                    {{"file", job_.volume_file.empty() ? job_.volume.filename().string() : job_.volume_file},
                     {"checksum", to_hex(samples_.info().checksum)}}},
                   {"coordinates", job_.world ? "world" : "index"},
                   {"z_positive", "down"},
                   {"normals", "to lower values"}};
  if (job_.visible) description["isosurface"]["only_visible"] = true;
  // The writer throws on all ranks or on none.
  world_.collectively([&] {
    surface::write_surface_parallel(world_.get(), job_.output,
                                    {part_.all_vertices, part_.all_triangles, job_.world, true},
                                    description.dump(-1, ' ', false, Json::error_handler_t::replace), share);
  });
}

Json Run::result() const {
  const isosurface::Properties& found = properties_;
  Json json = counts_;
  json["ranks"] = world_.size();
  json["threads"] = omp_get_max_threads();
  if (!job_.visible) json["pillars"] = isosurface::text_of(interleaving_);
  json["vertices"] = found.vertices;
  json["triangles"] = found.triangles;
  json["components"] = found.components.size();
  json["closed_components"] = found.closed_components;
  json["genus"] = found.genus;
  json["euler"] = found.euler;
  json["area"] = found.area;
  json["enclosed_volume"] = found.volume ? Json(*found.volume) : Json();
  json["unit"] = units_.name;
  json["boundary_edges"] = {{"at_border", found.boundary_edges.at_border},
                            {"inside", found.boundary_edges.inside}};
  json["non_manifold_edges"] = found.non_manifold_edges;
  json["seconds"] = seconds_;
  return json;
}

}  // namespace

void run_isosurface(const comm::Communicator& parent, const std::filesystem::path& job_path,
                    const JobContext& context) {
  run_isosurface(parent, parent.collectively([&] { return read_isosurface_job(job_path); }), context);
}

void run_isosurface(const comm::Communicator& parent, const IsosurfaceJob& job, const JobContext& context) {
  const double start = omp_get_wtime();
  comm::Communicator world(parent.get());
  Run run(world, job, context);
  run.end_of("open");
  run.extract();
  run.end_of("extract");
  run.weld();
  run.end_of("weld");
  run.measure();
  run.end_of("measure");
  run.write();
  run.end_of("write");
  const double total = world.maximum(omp_get_wtime() - start);
  world.collectively([&] {
    // From here on the file stands: no cancel.
    if (world.rank() != 0) return;
    Json result = run.result();
    result["seconds"]["total"] = total;
    write_whole_file(job.result, result.dump(1) + "\n");
  });
}

}  // namespace footwall::session
