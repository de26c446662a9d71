#include "engine/tasks/workload/make.h"

#include <fmt/format.h>
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <numeric>

#include "engine/tasks/workload/grow.h"
#include "storage/base/error.h"
#include "storage/base/partial_file.h"
#include "storage/base/text.h"

namespace footwall::tasks {
namespace {

constexpr std::int64_t kLongestAxis = std::int64_t{1} << 22;
constexpr std::int64_t kMostSteps = 100'000'000;  // operations of a script: some 4 GB of text

void check(bool right, const std::string& message, const char* hint) {
  if (!right) throw Error(ErrorCode::kUsage, message, hint);
}

void check(const WorkloadShape& shape) {
  for (const std::int64_t count : shape.size)
    check(count >= 1 && count <= kLongestAxis,
          fmt::format("a survey cannot have {} voxels along an axis", count),
          "give the size as INLINESxCROSSLINESxSAMPLES");
  check(std::isfinite(shape.area) && shape.area > 0, fmt::format("an area of {} is none", shape.area),
        "give the mean area of a face in voxels^2");
  check(std::isfinite(shape.distance) && shape.distance >= 0,
        fmt::format("vertices cannot move by {} voxels", shape.distance), "give the mean length of a move");
  check(shape.meshes >= 1, fmt::format("there cannot be {} meshes", shape.meshes), "the seed has 16");
  check(shape.faces >= 0, fmt::format("there cannot be {} faces", shape.faces), "give a number from 0 on");
  check(shape.cycles >= 1, fmt::format("{} cycles extract nothing", shape.cycles), "give at least 1");
  check(shape.repeats >= 1, fmt::format("{} repeats do nothing", shape.repeats), "give at least 1");
  check(shape.move_fraction >= 0 && shape.move_fraction <= 1,
        fmt::format("{} is no fraction of the vertices", shape.move_fraction), "give a number from 0 to 1");
  const double vertices = static_cast<double>(shape.faces) + 3.0 * static_cast<double>(shape.meshes);
  const double steps = static_cast<double>(shape.repeats) * vertices *
                       (2 + shape.move_fraction * static_cast<double>(shape.cycles));
  check(steps <= static_cast<double>(kMostSteps), fmt::format("that would be {:.0f} operations", steps),
        "make fewer faces, cycles or repeats; a run can be repeated by itself");
}

struct MeshVertex {
  mesh::MeshId mesh;
  mesh::VertexId vertex;
};

// Makes one repeat after the other; meshes are numbered on through all of them.
class Maker {
 public:
  explicit Maker(const WorkloadShape& shape)
      : shape_(shape), grower_(shape.size, shape.area, shape.distance, shape.seed) {}

  WorkloadRepeat repeat() {
    WorkloadRepeat made;
    // 1. The meshes.
    std::vector<mesh::Operation> operations;
    vertices_.clear();
    const mesh::MeshId first = meshes_.mesh_limit();
    for (std::int64_t n = 0; n < shape_.meshes; ++n) {
      const std::int64_t faces = shape_.faces / shape_.meshes + (n < shape_.faces % shape_.meshes ? 1 : 0);
      const mesh::MeshId id = grower_.grow(faces, meshes_, operations);
      for (mesh::VertexId v = 0; v < meshes_.mesh(id).vertex_limit(); ++v) vertices_.push_back({id, v});
    }
    look_at_new_faces();
    // 2. The cycles.
    for (std::int64_t cycle = 0; cycle < shape_.cycles; ++cycle) {
      if (cycle > 0 || shape_.move_first) move(operations);
      look_at_extracted_faces();
      made.steps.push_back({std::move(operations), true});
      operations.clear();
    }
    // 3. Everything goes, the newest vertex first: it has one face then, so that no other vertex is ever left
    // with faces that do not hang together.
    for (auto v = vertices_.rbegin(); v != vertices_.rend(); ++v)
      apply(mesh::RemoveFaces{v->mesh, v->vertex}, operations);
    for (mesh::MeshId id = first; id < meshes_.mesh_limit(); ++id) apply(mesh::DestroyMesh{id}, operations);
    meshes_.take_changes();
    made.steps.push_back({std::move(operations), false});
    return made;
  }

  MadeWorkload facts() const {
    MadeWorkload facts = facts_;
    facts.mean_area = made_area_ / static_cast<double>(std::max<std::int64_t>(1, facts.faces));
    facts.mean_area_extracted =
        extracted_area_ / static_cast<double>(std::max<std::int64_t>(1, extracted_faces_));
    return facts;
  }

 private:
  void apply(mesh::Operation operation, std::vector<mesh::Operation>& operations) {
    meshes_.apply(operation);
    operations.push_back(std::move(operation));
  }

  void move(std::vector<mesh::Operation>& operations) {
    const double wanted = std::ceil(shape_.move_fraction * static_cast<double>(vertices_.size()));
    const std::size_t count = std::min(vertices_.size(), static_cast<std::size_t>(wanted));
    std::vector<std::size_t> order(vertices_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    // A random part of them, without one twice; all of them in their order.
    for (std::size_t n = 0; n < count && count < order.size(); ++n)
      std::swap(order[n], order[n + grower_.random().below(order.size() - n)]);
    for (std::size_t n = 0; n < count; ++n) {
      const auto [id, v] = vertices_[order[n]];
      apply(mesh::MoveVertex{id, v, grower_.moved(meshes_.mesh(id).position(v))}, operations);
    }
  }

  void look_at_new_faces() {
    for (const mesh::FaceKey& key : meshes_.faces()) {
      const survey::LatticeTriangle triangle = meshes_.triangle(key);
      made_area_ += area_of(triangle);
      ++facts_.faces;
      facts_.faces_outside += !inside(triangle);
    }
  }

  void look_at_extracted_faces() {
    for (const mesh::FaceKey& key : meshes_.faces()) extracted_area_ += area_of(meshes_.triangle(key));
    extracted_faces_ += meshes_.face_count();
  }

  bool inside(const survey::LatticeTriangle& triangle) const {
    constexpr std::int64_t kHalf = survey::kLatticePerVoxel / 2;
    return std::all_of(triangle.begin(), triangle.end(), [&](const survey::LatticePoint& p) {
      const survey::Index at{p.i, p.j, p.k};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (at[axis] < -kHalf || at[axis] > (shape_.size[axis] - 1) * survey::kLatticePerVoxel + kHalf)
          return false;
      }
      return true;
    });
  }

  WorkloadShape shape_;
  Grower grower_;
  mesh::MeshSet meshes_;
  std::vector<MeshVertex> vertices_;
  MadeWorkload facts_;
  double made_area_ = 0, extracted_area_ = 0;
  std::int64_t extracted_faces_ = 0;
};

std::string title_of(const WorkloadShape& shape) {
  return fmt::format(
      "{} repeats of {} meshes with {} faces added, mean area {} voxel^2 asked\n"
      "{} EXTRACT-ALLs a repeat; {} of the vertices move by {} voxels before each{}; seed {}\n"
      "positions are in 1/256 voxel",
      shape.repeats, shape.meshes, shape.faces, text::shortest(shape.area), shape.cycles,
      text::shortest(shape.move_fraction), text::shortest(shape.distance),
      shape.move_first ? "" : " but the first", shape.seed);
}

}  // namespace

MadeWorkload make_workload(const WorkloadShape& shape, const std::filesystem::path& path,
                           const JobContext& job) {
  check(shape);
  refuse_to_replace_storage(path);
  PartialFile file(path);
  std::ofstream out(file.path(), std::ios::binary);
  write_script_head(shape.size, title_of(shape), out);
  Maker maker(shape);
  OperationCounts operations;
  for (std::int64_t n = 0; n < shape.repeats; ++n) {
    job.report(static_cast<double>(n) / static_cast<double>(shape.repeats), "make",
               fmt::format("{} of {} repeats", n, shape.repeats));
    const WorkloadRepeat repeat = maker.repeat();
    write_script_repeat(out);
    for (const WorkloadStep& step : repeat.steps) write_script_step(step, out);
    add_counts(repeat, operations);
  }
  out.close();
  if (!out) throw io_error("write", path.string(), errno);
  file.commit();
  MadeWorkload made = maker.facts();
  made.operations = operations;
  job.report(1, "make", "done");
  return made;
}

}  // namespace footwall::tasks
