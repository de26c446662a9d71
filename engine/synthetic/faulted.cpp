// The model, from the youngest step back to the oldest:
//
//   amplitude  = wavelet * (reflectivity + noise)       along each trace
//   reflectivity = impedance half a sample below - impedance half a sample above; its response has rms 1
//   noise      = white noise, mixed over 3x3 traces; its response has rms 1 / signal_to_noise
//   impedance  = layer at the stratigraphic depth, which undoes the twisted, the listric and the planar fault
//   and
//                then the folds
#include "engine/synthetic/faulted.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/synthetic/detail/noise.h"
#include "engine/synthetic/detail/strata.h"
#include "engine/synthetic/detail/structure.h"
#include "engine/synthetic/detail/truth.h"
#include "engine/synthetic/detail/wavelet.h"
#include "storage/base/error.h"

namespace footwall::synthetic {
namespace {

using namespace detail;

constexpr int kGeneratorVersion = 1;  // raised whenever the same options give other bytes

[[noreturn]] void refuse(const std::string& what, const std::string& hint) {
  throw Error(ErrorCode::kUsage, what, hint);
}

Options checked(const Options& options) {
  constexpr std::int64_t kMostOnAxis = std::int64_t{1} << 23;
  constexpr std::int64_t kMostVoxels = std::int64_t{1} << 60;  // so that a count of bytes is a count, too
  std::int64_t voxels = 1;
  for (const std::int64_t count : options.size) {
    if (count < 1 || count > kMostOnAxis || voxels > kMostVoxels / count) {
      refuse(fmt::format("a survey of {} x {} x {} voxels cannot be made", options.size[0], options.size[1],
                         options.size[2]),
             "give 1 to 8388608 inlines, crosslines and samples, fewer than 2^60 voxels in all");
    }
    voxels *= count;
  }
  if (!(options.signal_to_noise > 0)) {
    refuse(fmt::format("signal to noise {}", options.signal_to_noise),
           "give a ratio above 0, or inf for no noise");
  }
  if (options.pillar_every_lines < 1) {
    refuse(fmt::format("a pillar on every {} lines", options.pillar_every_lines), "give 1 or more");
  }
  if (!(options.jitter_voxels >= 0) || !std::isfinite(options.jitter_voxels)) {
    refuse(fmt::format("a jitter of {} voxels", options.jitter_voxels), "give 0 or more");
  }
  return options;
}

// Bins of 25 m x 12.5 m, turned by the angle of the 3-4-5 triangle, so that the map is exact in doubles.
survey::Geometry made_geometry(const survey::Index& size) {
  survey::Geometry geometry;
  geometry.inlines = {300, 1, size[0]};
  geometry.crosslines = {600, 2, size[1]};
  geometry.samples = size[2];
  geometry.z0 = 800;
  geometry.interval = 4;
  geometry.domain = survey::Domain::kTime;
  geometry.vertical_unit = survey::VerticalUnit::kMillisecond;
  geometry.map = {433250, 6786400, 15, 20, 10, -7.5};
  geometry.crs = "synthetic, metres";
  geometry.validate();
  return geometry;
}

}  // namespace

struct FaultedSurvey::Model {
  Options options;
  survey::Geometry geometry;
  Wavelet wavelet = ricker();
  Structure structure;
  Strata strata;
  Noise noise;
  std::vector<Fault> faults;

  explicit Model(const Options& o)
      : options(checked(o)),
        geometry(made_geometry(o.size)),
        structure(o.seed, o.size),
        strata(o.seed, o.size[2], structure.modulation_mean_square(), wavelet),
        noise(o.seed, o.signal_to_noise, wavelet) {
    if (!structure.faulted()) return;
    for (const FaultKind kind : kFaultKinds) faults.push_back(made_fault(kind));
  }

  Fault made_fault(FaultKind kind) const {
    Fault fault;
    fault.name = name_of(kind);
    const Sheet sheet = true_sheet(structure, options.size, kind);
    fault.truth.name = fault.name;
    for (const survey::IndexPoint& p : sheet.vertices) fault.truth.vertices.push_back(geometry.world_of(p));
    fault.truth.triangles = sheet.triangles;
    const Picking picking{options.pillar_every_lines, options.jitter_voxels, options.seed};
    for (const PickedPillar& picked : picked_pillars(structure, options.size, kind, picking)) {
      survey::Pillar& pillar = fault.pillars.emplace_back();
      for (const survey::IndexPoint& p : picked) pillar.nodes.push_back({0, geometry.world_of(p)});
    }
    return fault;
  }

  // Samples first .. first + count - 1 of one trace, count <= kRun.
  static constexpr int kRun = 1024;
  void fill_run(std::int64_t i, std::int64_t j, std::int64_t first, int count, const NoiseRun& noise_run,
                float* values) const {
    constexpr int kMost = kRun + 2 * kWaveletHalf;
    std::array<double, kMost + 1> impedance;
    std::array<double, kMost> input;
    std::array<double, kRun> output;
    const int needed = count + 2 * kWaveletHalf;
    const Trace trace = structure.trace(static_cast<double>(i), static_cast<double>(j));
    const double top = static_cast<double>(first - kWaveletHalf) - 0.5;
    for (int n = 0; n <= needed; ++n) impedance[n] = trace.stratigraphic_depth(top + n);
    for (int n = 0; n <= needed; ++n) impedance[n] = strata.impedance(impedance[n], trace.modulation);
    for (int n = 0; n < needed; ++n) input[n] = impedance[n + 1] - impedance[n];
    noise_run.add_to(input.data());
    convolve(wavelet, input.data(), count, output.data());
    for (int n = 0; n < count; ++n) values[n] = static_cast<float>(output[n]);
  }
};

FaultedSurvey::FaultedSurvey(const Options& options)
    : model_(std::make_unique<const Model>(checked(options))) {}
FaultedSurvey::~FaultedSurvey() = default;
FaultedSurvey::FaultedSurvey(FaultedSurvey&&) noexcept = default;
FaultedSurvey& FaultedSurvey::operator=(FaultedSurvey&&) noexcept = default;

const survey::Geometry& FaultedSurvey::geometry() const {
  return model_->geometry;
}
const std::vector<Fault>& FaultedSurvey::faults() const {
  return model_->faults;
}

void FaultedSurvey::fill(const survey::Box& box, std::span<float> values) const {
  if (box.empty()) {
    require(values.empty(), "an empty box has no values");
    return;
  }
  require(survey::intersection(box, geometry().box()) == box, "the box lies inside the survey");
  require(values.size() == static_cast<std::size_t>(box.count()), "one value for every voxel of the box");

  // Pieces of neighbouring traces, so that each trace's noise is drawn once for three crosslines.
  constexpr std::int64_t kTraces = 64;
  constexpr std::int64_t kWorthThreads = 1 << 18;  // voxels; some 3 ms of work
  const std::int64_t strips = (box.size(1) + kTraces - 1) / kTraces;
  const std::int64_t runs = (box.size(2) + Model::kRun - 1) / Model::kRun;
  const std::int64_t pieces = box.size(0) * strips * runs;
#pragma omp parallel for schedule(dynamic) if (box.count() > kWorthThreads)
  for (std::int64_t piece = 0; piece < pieces; ++piece) {
    const std::int64_t i = box.lo[0] + piece / (strips * runs);
    const std::int64_t j_from = box.lo[1] + piece / runs % strips * kTraces;
    const std::int64_t j_to = std::min(j_from + kTraces, box.hi[1]);
    const std::int64_t first = box.lo[2] + piece % runs * Model::kRun;
    const auto count = static_cast<int>(std::min<std::int64_t>(Model::kRun, box.hi[2] - first));
    NoiseRun noise(model_->noise, i, j_from, first - kWaveletHalf, count + 2 * kWaveletHalf);
    for (std::int64_t j = j_from; j < j_to; ++j, noise.next_crossline()) {
      const std::int64_t place =
          ((i - box.lo[0]) * box.size(1) + (j - box.lo[1])) * box.size(2) + first - box.lo[2];
      model_->fill_run(i, j, first, count, noise, values.data() + place);
    }
  }
}

std::string FaultedSurvey::description_json() const {
  const Options& options = model_->options;
  const Structure::LargestThrows& throws = model_->structure.largest_throws();
  nlohmann::ordered_json json{{"generator", "faulted"},
                              {"version", kGeneratorVersion},
                              {"size", options.size},
                              {"seed", options.seed},
                              {"signal_to_noise", nullptr},
                              {"pillar_every_lines", options.pillar_every_lines},
                              {"jitter_voxels", options.jitter_voxels},
                              {"signal_rms", 1},
                              {"wavelet", {{"kind", "ricker"}, {"cycles_per_sample", kDominantFrequency}}},
                              {"faults", nlohmann::ordered_json::array()}};
  if (std::isfinite(options.signal_to_noise)) json["signal_to_noise"] = options.signal_to_noise;
  for (const FaultKind kind : kFaultKinds) {
    if (!model_->structure.faulted()) break;
    const double largest = kind == FaultKind::kPlanar    ? throws.planar
                           : kind == FaultKind::kListric ? throws.listric
                                                         : throws.twisted;
    json["faults"].push_back(
        {{"name", name_of(kind)},
         {"largest_throw_samples", largest},
         {"pillars_on", kind == FaultKind::kTwisted ? "crosslines" : "inlines"},
         {"pillar_every_lines", effective_spacing(options.size, kind, options.pillar_every_lines)}});
  }
  return json.dump();
}

}  // namespace footwall::synthetic
