// Isosurfaces as triangles for the scene, made from the volume's file on a thread of their own by the
// engine's marching cubes.
#pragma once
#include <array>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "storage/base/job_context.h"
#include "storage/survey/box.h"
#include "ui/model/document.h"
#include "ui/scene3d/coarse_faces.h"
#include "ui/scene3d/ray_tree.h"

namespace footwall::ui {

// Where a volume lies in the scene at exaggeration 1: its voxel (i, j, k) at zero + i a + j b + k c.
struct VolumePlace {
  render::Vec3 zero;
  std::array<render::Vec3, 3> steps;
};

struct IsosurfaceRequest {
  Id isosurface = 0;  // of the display
  Id volume = 0;
  std::string name;  // of the volume
  std::filesystem::path path;
  std::string checksum;
  VolumePlace place;
  double value = 0;
};
// Whether both ask for the same triangles.
bool is_same(const IsosurfaceRequest& a, const IsosurfaceRequest& b);

// Never changed, and never moved, after it was made: the tree looks at the arrays.
struct IsosurfaceShape {
  static constexpr std::array<std::size_t, 2> kCoarse{6000, 1000};  // triangles at most

  Id isosurface = 0;
  double value = 0;
  std::vector<render::Vec3f> positions;             // scene metres at exaggeration 1
  std::vector<std::array<std::int8_t, 4>> normals;  // -127 to 127, to lower values; the fourth is 0
  std::vector<std::uint32_t> corners;
  std::array<CoarseFaces, kCoarse.size()> coarse;
  RayTree tree;
  std::size_t triangles() const { return corners.size() / 3; }
};

class IsosurfaceMaker {
 public:
  // Triangles of one isosurface; one with more is refused, since a picture by the engine is the better way
  // then.
  static constexpr std::size_t kMostTriangles = 2'000'000;
  // Samples that are held at once. A volume of no more stays in memory while one of its isosurfaces is
  // wanted, so that a slider does not read it again.
  static constexpr std::int64_t kMostSampleBytes = std::int64_t{256} << 20;

  // Called on the thread.
  struct Events {
    std::function<void(std::shared_ptr<const IsosurfaceShape>)> made;
    std::function<void(double fraction)> progress;  // of the one under way
    std::function<void(const IsosurfaceRequest&, const std::string& message, const std::string& hint)> failed;
  };
  explicit IsosurfaceMaker(Events events, std::size_t most_triangles = kMostTriangles,
                           std::int64_t most_sample_bytes = kMostSampleBytes);
  // Cancels the one under way.
  ~IsosurfaceMaker();
  IsosurfaceMaker(const IsosurfaceMaker&) = delete;
  IsosurfaceMaker& operator=(const IsosurfaceMaker&) = delete;

  // All that is wanted from now on. What was made or is under way and is the same is not made again; one
  // under way that is not among them, or has another value by now, is cancelled. Returns those for which an
  // answer will come.
  std::set<Id> want(std::vector<IsosurfaceRequest> requests);

 private:
  struct Wanted {
    IsosurfaceRequest request;
    bool is_done = false;
  };
  class Volume;
  void work();
  std::shared_ptr<const IsosurfaceShape> make(const IsosurfaceRequest& request, const JobContext& job);

  const Events events_;
  const std::size_t most_triangles_;
  const std::int64_t most_sample_bytes_;
  std::unique_ptr<Volume> volume_;  // the thread's
  std::mutex mutex_;
  std::condition_variable wake_;
  std::map<Id, Wanted> wanted_;
  Id under_way_ = 0;
  JobContext job_;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace footwall::ui
