#include "engine/tasks/detail/bench_service_check.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <tuple>

#include "engine/service/client/local_engine.h"
#include "engine/service/wire.h"
#include "engine/tasks/detail/bench_service_inputs.h"
#include "engine/tasks/workload/values.h"
#include "engine/verify/contrast_by_definition.h"

namespace footwall::tasks {
namespace {

constexpr int kByDefinition = 8;  // faces: each takes some milliseconds

// Bits, so that one undefined number is another.
auto bits(const extract::FaceStatistics& of) {
  const auto b = [](double number) { return std::bit_cast<std::uint64_t>(number); };
  return std::tuple(of.count, of.nulls, of.outside, b(of.mean), b(of.variance), b(of.min), b(of.max),
                    b(of.discontinuity), b(of.contrast));
}

Error wrong(const extract::FaceIdentity& face, const char* what, const extract::FaceStatistics& is,
            const extract::FaceStatistics& should) {
  return {ErrorCode::kInternal,
          fmt::format("face {} of mesh {}: {}: {} voxels, mean {}, variance {}, contrast {}; they should be "
                      "{}, {}, {}, {}",
                      face.n, -1 - face.fault, what, is.count, is.mean, is.variance, is.contrast,
                      should.count, should.mean, should.variance, should.contrast)};
}

FaceNumbers extracted_anew(const LiveMoves& moves, const std::filesystem::path& volume,
                           session::LaunchOptions launch, const JobContext& job) {
  launch.ranks = 1;
  service::LocalEngine engine(launch, [&](service::EngineClient& client) {
    v1::VolumeName name;
    name.set_path(volume.string());
    client.open_volume(name, job);
    client.edit(moves.as_made());
    client.edit(moves.as_moved());
  });
  FaceNumbers fresh;
  engine.with_engine(
      [&](service::EngineClient& client) {
        v1::ExtractRequest all;
        all.set_volume(moves.volume());
        *all.mutable_options() = live_options();
        fresh.clear();
        client.extract(
            all,
            [&](const v1::FaceNumbers& numbers) {
              for (const service::NumberedFace& each : service::numbers_from(numbers))
                fresh.emplace(each.face, each.statistics);
            },
            job);
      },
      job);
  return fresh;
}

extract::FaceStatistics by_definition(const survey::LatticeTriangle& triangle, double max_abs) {
  const verify::ValueAt value = [](const survey::Index& p) {
    float one = 0;
    fill_hashed(kBenchDims, kBenchSeed, {p, {p[0] + 1, p[1] + 1, p[2] + 1}}, std::span(&one, 1));
    return one;
  };
  const auto voxels = verify::voxels_in_survey(triangle, kBenchDims);
  auto numbers =
      verify::statistics_by_definition(voxels, kBenchDims, value, max_abs, extract::Outside::kInside);
  numbers.contrast = verify::contrast_by_definition(triangle, kBenchDims, value, max_abs, 1).contrast;
  return numbers;
}

double largest_magnitude() {
  std::vector<float> plane(static_cast<std::size_t>(kBenchDims[1] * kBenchDims[2]));
  double most = 0;
  for (std::int64_t i = 0; i < kBenchDims[0]; ++i) {
    fill_hashed(kBenchDims, kBenchSeed, {{i, 0, 0}, {i + 1, kBenchDims[1], kBenchDims[2]}}, plane);
    for (const float value : plane) most = std::max(most, std::abs(double{value}));
  }
  return most;
}

}  // namespace

void check_numbers(const LiveMoves& moves, const std::filesystem::path& volume,
                   const session::LaunchOptions& launch, const JobContext& job) {
  const FaceNumbers fresh = extracted_anew(moves, volume, launch, job);
  const FaceNumbers& live = moves.numbers();
  if (fresh.size() != live.size()) {
    throw Error(ErrorCode::kInternal,
                fmt::format("the client has numbers of {} faces of {}", live.size(), fresh.size()));
  }
  for (const auto& [face, numbers] : live) {
    const auto found = fresh.find(face);
    if (found == fresh.end())
      throw Error(ErrorCode::kInternal, fmt::format("the client has a face {} that is not there", face.n));
    if (bits(numbers) != bits(found->second))
      throw wrong(face, "not as a fresh extraction has it", numbers, found->second);
  }
  const double max_abs = largest_magnitude();
  const std::size_t step = std::max<std::size_t>(1, live.size() / kByDefinition);
  std::size_t n = 0;
  for (const auto& [face, numbers] : live) {
    if (n++ % step != 0) continue;
    job.check();
    const auto mesh = static_cast<mesh::MeshId>(-1 - face.fault);
    const extract::FaceStatistics should = by_definition(moves.meshes().triangle({mesh, face.n}), max_abs);
    const auto of = [](const extract::FaceStatistics& s) {
      const auto b = [](double number) { return std::bit_cast<std::uint64_t>(number); };
      return std::tuple(s.count, b(s.mean), b(s.variance), b(s.contrast));
    };
    if (of(numbers) != of(should)) throw wrong(face, "not as it is defined", numbers, should);
  }
}

}  // namespace footwall::tasks
