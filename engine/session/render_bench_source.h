// What `bench render` draws: an isosurface of a raw volume or of a made one, or a mesh, spread over the
// ranks.
#pragma once
#include <filesystem>
#include <optional>
#include <vector>

#include "engine/comm/communicator.h"
#include "engine/isosurface/brick_ranges.h"
#include "engine/isosurface/parallel/extract_parallel.h"
#include "engine/render/composite/geometry_bytes.h"
#include "engine/render/vector.h"
#include "engine/session/drawn_pieces.h"

namespace footwall::session {

struct BenchedScene {
  enum class Kind : std::uint8_t {
    kRaw,     // float32, the first of dims fastest, little endian
    kMesh,    // PLY or STL
    kSphere,  // a mesh of about `triangles`
    kGyroid   // a field, sampled so finely that its isosurface 0 has about `triangles`
  };
  Kind kind = Kind::kSphere;
  std::filesystem::path file;
  survey::Index dims{0, 0, 0};
  float value = 0;
  std::int64_t triangles = 0;
  bool pyramid = false;  // of a volume: bricks that the isovalue cannot cross are skipped
};

class BenchSource {
 public:
  // Collective; the same Error everywhere: kNotFound, kFormat, kUsage, kMemory. Every rank holds its
  // own share alone: of a volume the samples that its cells and their normals need.
  BenchSource(comm::Communicator& world, const BenchedScene& scene, int threads);

  // Collective. Of a volume: the isosurface anew, with normals. A mesh is there already.
  void prepare(comm::Communicator& world);
  bool is_volume() const { return pillars_.has_value(); }
  std::int64_t samples() const { return std::ssize(samples_); }  // of this rank
  // That this rank took to make the bricks' ranges, which a volume file keeps; nothing without them.
  std::optional<double> pyramid_seconds() const { return pyramid_seconds_; }
  // Of this rank; the numbers are those of the whole.
  std::span<const render::LitSurface> surfaces() const;
  std::uint64_t triangles() const { return triangles_; }               // of all ranks
  double extract_seconds() const { return extraction_.busy_seconds; }  // of this rank, of the last prepare()
  const render::Bounds& bounds() const { return bounds_; }

 private:
  // Which samples this rank has.
  void take_pillar(comm::Communicator& world, const survey::Index& size);
  void read_samples(comm::Communicator& world, const BenchedScene& scene);
  void sample_gyroid(comm::Communicator& world, std::int64_t triangles);
  void make_pyramid(comm::Communicator& world);
  isosurface::Field field() const;
  void make_sphere(comm::Communicator& world, std::int64_t triangles);
  void take_share(comm::Communicator& world, const std::filesystem::path& mesh);

  int threads_;
  float value_ = 0;
  std::optional<isosurface::Pillars> pillars_;  // of a volume
  survey::Box box_;                             // of samples_, in the volume
  std::vector<float> samples_;
  isosurface::BrickRanges ranges_;
  std::optional<isosurface::Bricks> bricks_;
  std::optional<double> pyramid_seconds_;
  isosurface::Extraction extraction_;
  DrawnPieces pieces_;
  render::OwnedSurface mesh_;
  std::vector<render::LitSurface> drawn_;
  std::uint64_t triangles_ = 0;
  render::Bounds bounds_;
};

}  // namespace footwall::session
