#include "engine/session/render_bench_source.h"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "storage/formats/plain_mesh.h"
#include "storage/formats/raw.h"

namespace footwall::session {
namespace {

constexpr render::Rgba kColour = render::hex(0xd9a066);
constexpr std::int64_t kMostTriangles = 1'000'000'000;

// Sines and cosines of rank 0 on all ranks: what the C library says may differ from host to host.
struct Waves {
  std::vector<float> sine;
  std::vector<float> cosine;
};
Waves waves_of(const comm::Communicator& world, std::size_t count, double step) {
  comm::Bytes bytes(2 * count * sizeof(float));
  Waves waves{std::vector<float>(count), std::vector<float>(count)};
  if (world.rank() == 0) {
    for (std::size_t n = 0; n < count; ++n) {
      waves.sine[n] = static_cast<float>(std::sin(static_cast<double>(n) * step));
      waves.cosine[n] = static_cast<float>(std::cos(static_cast<double>(n) * step));
    }
    std::memcpy(bytes.data(), waves.sine.data(), count * sizeof(float));
    std::memcpy(bytes.data() + count * sizeof(float), waves.cosine.data(), count * sizeof(float));
  }
  bytes = world.broadcast(std::move(bytes), 0);
  std::memcpy(waves.sine.data(), bytes.data(), count * sizeof(float));
  std::memcpy(waves.cosine.data(), bytes.data() + count * sizeof(float), count * sizeof(float));
  return waves;
}

// The triangles [begin, end) of a mesh, with the vertices that they need.
render::OwnedSurface part_of(const formats::PlainMesh& mesh, std::size_t begin, std::size_t end) {
  render::OwnedSurface part;
  part.colour = kColour;
  std::vector<std::int32_t> number(mesh.positions.size(), -1);
  for (std::size_t t = begin; t < end; ++t) {
    render::TriangleIndices corners{};
    for (std::size_t n = 0; n < 3; ++n) {
      const auto v = static_cast<std::size_t>(mesh.triangles[t][n]);
      if (number[v] < 0) {
        number[v] = static_cast<std::int32_t>(part.positions.size());
        const auto& p = mesh.positions[v];
        const auto& normal = mesh.normals[v];
        part.positions.emplace_back(p[0], p[1], p[2]);
        part.normals.emplace_back(normal[0], normal[1], normal[2]);
      }
      corners[n] = number[v];
    }
    part.triangles.push_back(corners);
  }
  if (begin < end) part.runs.push_back({0, static_cast<render::PrimitiveId>(begin)});
  return part;
}

}  // namespace

BenchSource::BenchSource(comm::Communicator& world, const BenchedScene& scene, int threads)
    : threads_(threads), value_(scene.value) {
  using Kind = BenchedScene::Kind;
  world.collectively([&] {
    const bool is_made = scene.kind == Kind::kSphere || scene.kind == Kind::kGyroid;
    if (is_made && (scene.triangles < 8 || scene.triangles > kMostTriangles))
      throw Error(ErrorCode::kUsage, fmt::format("{} triangles cannot be made", scene.triangles),
                  fmt::format("give --triangles 8 to {}", kMostTriangles));
  });
  if (scene.kind == Kind::kRaw) read_samples(world, scene);
  if (scene.kind == Kind::kGyroid) sample_gyroid(world, scene.triangles);
  if (scene.kind == Kind::kSphere) make_sphere(world, scene.triangles);
  if (scene.kind == Kind::kMesh) take_share(world, scene.file);
  if (!is_volume()) return;
  const survey::Index& size = pillars_->volume();
  bounds_.hi = {static_cast<double>(size[0] - 1), static_cast<double>(size[1] - 1),
                static_cast<double>(size[2] - 1)};
  if (scene.pyramid) make_pyramid(world);
}

void BenchSource::take_pillar(comm::Communicator& world, const survey::Index& size) {
  pillars_.emplace(size, world.size(), isosurface::Interleaving{1, 1, 1});
  const std::vector<survey::Box> cells = pillars_->of_rank(world.rank());
  if (cells.empty()) return;  // more ranks than cells
  box_ = pillars_->samples_of(cells.front(), true);
  samples_.resize(static_cast<std::size_t>(box_.count()));
}

void BenchSource::read_samples(comm::Communicator& world, const BenchedScene& scene) {
  world.collectively([&] {
    // The first axis of the file is the fastest: our samples.
    const survey::Index size{scene.dims[2], scene.dims[1], scene.dims[0]};
    const formats::raw::RawFile file(scene.file, size);
    take_pillar(world, size);
    if (!samples_.empty()) file.read_block(box_, samples_);
  });
}

void BenchSource::sample_gyroid(comm::Communicator& world, std::int64_t triangles) {
  // With so many periods along each axis, n^3 samples have about so many triangles over n^2 (measured at n =
  // 248).
  constexpr double kPeriods = 11.5;
  constexpr double kTrianglesPerSquare = 110;
  const auto n =
      static_cast<std::int64_t>(std::sqrt(static_cast<double>(triangles) / kTrianglesPerSquare)) + 2;
  const Waves waves =
      waves_of(world, static_cast<std::size_t>(n), 2 * std::numbers::pi * kPeriods / static_cast<double>(n));
  world.collectively([&] {
    take_pillar(world, {n, n, n});
    if (samples_.empty()) return;
    const auto& [lo, hi] = box_;
#pragma omp parallel for num_threads(threads_)
    for (std::int64_t i = lo[0]; i < hi[0]; ++i) {
      float* to = samples_.data() + (i - lo[0]) * box_.size(1) * box_.size(2);
      const auto a = static_cast<std::size_t>(i);
      for (auto b = static_cast<std::size_t>(lo[1]); b < static_cast<std::size_t>(hi[1]); ++b) {
        for (auto c = static_cast<std::size_t>(lo[2]); c < static_cast<std::size_t>(hi[2]); ++c) {
          *to++ = waves.sine[a] * waves.cosine[b] + waves.sine[b] * waves.cosine[c] +
                  waves.sine[c] * waves.cosine[a];
        }
      }
    }
  });
}

void BenchSource::make_pyramid(comm::Communicator& world) {
  world.collectively([&] {
    pyramid_seconds_ = 0;
    if (samples_.empty()) return;
    const double start = omp_get_wtime();
    ranges_ = isosurface::brick_ranges(field(), threads_);
    pyramid_seconds_ = omp_get_wtime() - start;
    bricks_ = ranges_.tables();
  });
}

isosurface::Field BenchSource::field() const {
  return {samples_, {box_.size(0), box_.size(1), box_.size(2)}, box_.lo, pillars_->volume()};
}

// Circles of latitude from pole to pole; each rank has some of the belts between them.
void BenchSource::make_sphere(comm::Communicator& world, std::int64_t triangles) {
  const auto belts = std::max<std::int64_t>(3, std::llround(std::sqrt(static_cast<double>(triangles) / 4)));
  const std::int64_t around = 2 * belts;
  const Waves latitude =
      waves_of(world, static_cast<std::size_t>(belts + 1), std::numbers::pi / static_cast<double>(belts));
  const Waves longitude =
      waves_of(world, static_cast<std::size_t>(around), 2 * std::numbers::pi / static_cast<double>(around));
  world.collectively([&] {
    const std::int64_t first = belts * world.rank() / world.size();
    const std::int64_t end = belts * (world.rank() + 1) / world.size();
    mesh_.colour = kColour;
    for (std::int64_t circle = first; circle <= end; ++circle) {
      for (std::int64_t n = 0; n < around; ++n) {
        const auto c = static_cast<std::size_t>(circle);
        const auto m = static_cast<std::size_t>(n);
        const render::Vec3f p(latitude.sine[c] * longitude.cosine[m], latitude.sine[c] * longitude.sine[m],
                              latitude.cosine[c]);
        mesh_.positions.push_back(p);
        mesh_.normals.push_back(p);
      }
    }
    for (std::int64_t belt = first; belt < end; ++belt) {
      for (std::int64_t n = 0; n < around; ++n) {
        const auto upper = static_cast<std::int32_t>((belt - first) * around + n);
        const auto upper_next = static_cast<std::int32_t>((belt - first) * around + (n + 1) % around);
        const auto lower = static_cast<std::int32_t>(upper + around);
        const auto lower_next = static_cast<std::int32_t>(upper_next + around);
        // At a pole one of the two has no area.
        if (belt > 0) mesh_.triangles.push_back({upper, lower, upper_next});
        if (belt + 1 < belts) mesh_.triangles.push_back({upper_next, lower, lower_next});
      }
    }
    const std::int64_t before = first == 0 ? 0 : around * (2 * first - 1);
    if (first < end) mesh_.runs.push_back({0, static_cast<render::PrimitiveId>(before)});
    triangles_ = static_cast<std::uint64_t>(around * (2 * belts - 2));
    bounds_ = {{-1, -1, -1}, {1, 1, 1}};
    drawn_ = {mesh_.view()};
  });
}

void BenchSource::take_share(comm::Communicator& world, const std::filesystem::path& path) {
  world.collectively([&] {
    const formats::PlainMesh mesh = formats::read_plain_mesh(path);
    const std::size_t count = mesh.triangles.size();
    const auto rank = static_cast<std::size_t>(world.rank());
    const auto ranks = static_cast<std::size_t>(world.size());
    if (count == 0)
      throw Error(ErrorCode::kInvalid, path.string() + " has no triangles", "give a mesh of triangles");
    mesh_ = part_of(mesh, count * rank / ranks, count * (rank + 1) / ranks);
    triangles_ = count;
    render::Vec3 lo{INFINITY, INFINITY, INFINITY};
    render::Vec3 hi{-INFINITY, -INFINITY, -INFINITY};
    for (const auto& p : mesh.positions) {
      if (!std::isfinite(p[0] + p[1] + p[2])) continue;
      lo = {std::min<double>(lo.x, p[0]), std::min<double>(lo.y, p[1]), std::min<double>(lo.z, p[2])};
      hi = {std::max<double>(hi.x, p[0]), std::max<double>(hi.y, p[1]), std::max<double>(hi.z, p[2])};
    }
    bounds_ = {lo, hi};
    drawn_ = {mesh_.view()};
  });
}

void BenchSource::prepare(comm::Communicator& world) {
  if (!is_volume()) return;
  isosurface::ParallelOptions options;
  options.threads = threads_;
  options.bricks = bricks_ ? &*bricks_ : nullptr;
  options.cuts_around_bricks = false;
  isosurface::extract_parallel(
      world, *pillars_, [&](const survey::Box&) { return field(); }, value_, options, {}, extraction_);
  world.collectively([&] {
    pieces_.clear();
    pieces_.add(extraction_.pieces, 0, kColour, {});
    triangles_ = extraction_.triangles;
  });
}

std::span<const render::LitSurface> BenchSource::surfaces() const {
  return is_volume() ? pieces_.surfaces() : std::span<const render::LitSurface>(drawn_);
}

}  // namespace footwall::session
