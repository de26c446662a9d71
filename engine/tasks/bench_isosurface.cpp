#include "engine/tasks/bench_isosurface.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <utility>

#include "engine/isosurface/brick_ranges.h"
#include "engine/isosurface/canonical.h"
#include "engine/isosurface/cubes.h"
#include "engine/isosurface/plane.h"
#include "engine/isosurface/registry.h"
#include "engine/isosurface/seed_tables.h"
#include "engine/isosurface/vector.h"
#include "engine/synthetic/fields.h"
#include "engine/voxelize/simd.h"
#include "storage/base/error.h"
#include "storage/formats/raw.h"

namespace footwall::tasks {
namespace {

using isosurface::CaseRules;
using isosurface::ExtractOptions;
using isosurface::Field;
using isosurface::Surface;

constexpr int kMostThreads = 1024;
constexpr int kMostRepeats = 10000;
constexpr double kMiB = 1 << 20;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double processor_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// "VmRSS" or "VmHWM" of this process.
double resident_mib(const std::string& what) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double kib = 0;
    if (word == what + ":" && status >> kib) return kib / 1024;
  }
  return 0;
}

// From now on VmHWM is the most since now, where the system lets us say so.
void forget_peak() {
  std::ofstream("/proc/self/clear_refs") << "5";
}

double median_of(std::vector<double> all) {
  std::sort(all.begin(), all.end());
  const std::size_t half = all.size() / 2;
  return all.size() % 2 == 1 ? all[half] : (all[half - 1] + all[half]) / 2;
}

void check_options(const BenchIsosurfaceOptions& options) {
  const auto within = [](const char* what, int number, int most) {
    if (number >= 1 && number <= most) return;
    throw Error(ErrorCode::kUsage, fmt::format("{} {}; 1 to {} are possible", number, what, most));
  };
  within("threads", options.threads, kMostThreads);
  within("repeats", options.repeats, kMostRepeats);
  if (options.variant == "bricks") return;
  if (options.threads != 1) {
    throw Error(ErrorCode::kUsage, fmt::format("the variant {} runs on one thread", options.variant),
                "leave --threads out, or take the variant bricks");
  }
  if (options.pyramid) {
    throw Error(ErrorCode::kUsage, fmt::format("the variant {} reads every sample", options.variant),
                "leave --pyramid out, or take the variant bricks");
  }
}

// What a variant does with what tables.
class Extraction {
 public:
  Extraction(const std::string& variant, const std::string& tables)
      : variant_(isosurface::variant_of(variant)), tables_(tables) {
    if (tables == "seed") tables_ = variant == "plane" ? "seed000" : "seed002";
    if (tables_ == "trilinear") return;
    rules_ = &isosurface::rules_of(tables_);
    if (variant == "cubes") with_rules_ = isosurface::extract_cubes;
    if (variant == "plane") with_rules_ = isosurface::extract_plane;
    if (variant == "vector") with_rules_ = isosurface::extract_vector;
    if (with_rules_ == nullptr) {
      throw Error(ErrorCode::kUsage,
                  fmt::format("the variant {} has no tables but the trilinear ones", variant),
                  "give --variant cubes, plane or vector with --tables");
    }
  }
  void operator()(const Field& field, float value, const ExtractOptions& options, Surface& into) const {
    if (with_rules_ != nullptr) {
      with_rules_(field, value, options, *rules_, into);
    } else {
      variant_.extract(field, value, options, into);
    }
  }
  const std::string& tables() const { return tables_; }
  const CaseRules* rules() const { return rules_; }

 private:
  const isosurface::Variant& variant_;
  std::string tables_;
  const CaseRules* rules_ = nullptr;
  void (*with_rules_)(const Field&, float, const ExtractOptions&, const CaseRules&, Surface&) = nullptr;
};

// Cells that their signs leave open, and those of them that the rules decide otherwise than the field does.
void count_other_cells(const Field& field, float value, const CaseRules& rules,
                       BenchIsosurfaceResult& result) {
  const CaseRules& right = isosurface::trilinear_rules();
  std::uint64_t undecided = 0, other = 0;
  const survey::Box cells = isosurface::cells_of(field);
  const std::int64_t row = field.size[2], plane = field.size[1] * row;
  for (std::int64_t i = cells.lo[0]; i < cells.hi[0]; ++i) {
    for (std::int64_t j = cells.lo[1]; j < cells.hi[1]; ++j) {
      for (std::int64_t k = cells.lo[2]; k < cells.hi[2]; ++k) {
        std::array<float, 8> values;
        unsigned signs = 0;
        bool null = false;
        for (int corner = 0; corner < 8; ++corner) {
          const std::int64_t at =
              (i + (corner & 1)) * plane + (j + (corner >> 1 & 1)) * row + k + (corner >> 2);
          values[corner] = field.values[static_cast<std::size_t>(at)];
          null = null || std::isnan(values[corner]);
          signs |= (values[corner] >= value ? 1U : 0U) << corner;
        }
        if (null || !right.undecided(signs)) continue;
        ++undecided;
        const isosurface::Alternative theirs =
            rules.undecided(signs) ? rules.decide(signs, values, value) : isosurface::Alternative{0};
        if (theirs != right.decide(signs, values, value)) ++other;
      }
    }
  }
  result.undecided_cells = undecided;
  result.other_cells = other;
}

void check_answer(const Extraction& extraction, const BenchIsosurfaceOptions& options, const Field& field,
                  float value, const Surface& surface, BenchIsosurfaceResult& result) {
  result.checked_against = options.variant == "plane" ? "cubes" : "plane";
  ExtractOptions how;
  how.normals = options.normals;
  Surface other;
  Extraction(result.checked_against, extraction.tables())(field, value, how, other);
  if (const auto found = isosurface::difference(surface, other, field.volume_size)) {
    throw Error(ErrorCode::kInternal, fmt::format("{} and {} give different surfaces: {}", options.variant,
                                                  result.checked_against, *found));
  }
}

double part_of_active(const isosurface::BrickRanges& ranges, float value) {
  std::size_t active = 0;
  for (std::size_t n = 0; n < ranges.min.size(); ++n) {
    active += ranges.min[n] < value && value <= ranges.max[n] ? 1 : 0;
  }
  return static_cast<double>(active) / static_cast<double>(ranges.min.size());
}

Field field_of(const BenchVolume& volume) {
  return {volume.values, volume.size, {0, 0, 0}, volume.size};
}

}  // namespace

BenchVolume load_bench_volume(const BenchIsosurfaceOptions& options, const JobContext& job) {
  if (options.raw.empty() == options.synthetic.empty()) {
    throw Error(ErrorCode::kUsage,
                options.raw.empty() ? "no volume was given" : "a file and a synthetic volume were given",
                "give either --raw FILE --dims X,Y,Z --value V or --synthetic NAME");
  }
  BenchVolume volume;
  job.report(0, "read");
  if (options.raw.empty()) {
    synthetic::SampledField made = synthetic::make_field(options.synthetic, options.size);
    volume = {
        std::move(made.values), {options.size, options.size, options.size}, made.isovalue, options.synthetic};
  } else {
    if (!options.value) throw Error(ErrorCode::kUsage, "no isovalue was given", "give --value V");
    volume.size = {options.dims[2], options.dims[1], options.dims[0]};
    const formats::raw::RawFile file(options.raw, volume.size);
    volume.values.resize(static_cast<std::size_t>(volume.size[0] * volume.size[1] * volume.size[2]));
    file.read_block({{0, 0, 0}, volume.size}, volume.values);
    volume.name = options.raw.filename().string();
  }
  if (options.value) volume.value = *options.value;
  if (!options.write_raw.empty()) {
    formats::raw::write(
        options.write_raw, volume.size,
        [&](const survey::Box& box, std::span<float> into) {
          const std::int64_t plane = volume.size[1] * volume.size[2];
          std::copy_n(volume.values.begin() + box.lo[0] * plane, into.size(), into.begin());
        },
        1, job);
  }
  return volume;
}

BenchIsosurfaceResult bench_isosurface(const BenchIsosurfaceOptions& options, const JobContext& job) {
  check_options(options);
  const Extraction extraction(options.variant, options.tables);
  BenchIsosurfaceResult result;
  result.simd = voxelize::simd_in_use();
  const BenchVolume volume = load_bench_volume(options, job);
  const Field field = field_of(volume);
  result.variant = options.variant;
  result.tables = extraction.tables();
  result.volume = volume.name;
  result.dims = {volume.size[2], volume.size[1], volume.size[0]};
  result.value = volume.value;
  result.threads = options.threads;
  result.input_mib = static_cast<double>(volume.values.size() * sizeof(float)) / kMiB;

  ExtractOptions how;
  how.normals = options.normals;
  how.threads = options.threads;
  isosurface::BrickRanges ranges;
  isosurface::Bricks bricks;
  if (options.pyramid) {
    const auto start = std::chrono::steady_clock::now();
    ranges = isosurface::brick_ranges(field, options.threads);
    result.pyramid_seconds = seconds_since(start);
    result.bricks_active = part_of_active(ranges, volume.value);
    bricks = ranges.tables();
    how.bricks = &bricks;
  }

  forget_peak();
  const double before = resident_mib("VmRSS");
  const double processor_before = processor_seconds();
  const auto step = [&](int run) {
    job.report(0.1 + 0.6 * run / (2.0 * options.repeats), "extract",
               fmt::format("run {} of {}", run + 1, 2 * options.repeats));
  };
  for (int n = 0; n < options.repeats; ++n) {
    step(n);
    const auto start = std::chrono::steady_clock::now();
    Surface surface;
    extraction(field, volume.value, how, surface);
    result.seconds.push_back(seconds_since(start));
  }
  result.cpu_seconds = (processor_seconds() - processor_before) / options.repeats;
  result.peak_mib = std::max(0.0, resident_mib("VmHWM") - before);
  Surface surface;
  extraction(field, volume.value, how, surface);
  for (int n = 0; n < options.repeats; ++n) {
    step(options.repeats + n);
    const auto start = std::chrono::steady_clock::now();
    extraction(field, volume.value, how, surface);
    result.seconds_reused.push_back(seconds_since(start));
  }

  job.report(0.7, "check");
  if (options.check) check_answer(extraction, options, field, volume.value, surface, result);
  job.report(0.85, "measure");
  result.properties = isosurface::properties_of(surface, isosurface::Measure(), &field);
  if (extraction.rules() != nullptr) count_other_cells(field, volume.value, *extraction.rules(), result);
  result.median = median_of(result.seconds);
  result.median_reused = median_of(result.seconds_reused);
  if (result.median > 0) {
    result.voxels_per_second = static_cast<double>(volume.values.size()) / result.median;
    result.triangles_per_second = static_cast<double>(result.properties.triangles) / result.median;
  }
  job.report(1, "done");
  return result;
}

std::vector<SweepRow> sweep_isovalues(const BenchIsosurfaceOptions& options, const IsovalueSweep& sweep,
                                      const JobContext& job) {
  if (sweep.count < 1 || sweep.count > 10000 || !std::isfinite(sweep.first) || !std::isfinite(sweep.last)) {
    throw Error(ErrorCode::kUsage, "the sweep has no isovalues", "give --sweep FIRST:LAST:COUNT");
  }
  BenchIsosurfaceOptions with_value = options;
  with_value.value = sweep.first;
  check_options(with_value);
  const BenchVolume volume = load_bench_volume(with_value, job);
  const Field field = field_of(volume);
  ExtractOptions how;
  how.normals = options.normals;
  std::vector<SweepRow> rows;
  for (int n = 0; n < sweep.count; ++n) {
    job.report(static_cast<double>(n) / sweep.count, "extract",
               fmt::format("isovalue {} of {}", n + 1, sweep.count));
    SweepRow row;
    const float part = sweep.count == 1 ? 0 : static_cast<float>(n) / static_cast<float>(sweep.count - 1);
    row.value = sweep.first + part * (sweep.last - sweep.first);
    std::vector<double> cubes, vector;
    for (int run = 0; run < options.repeats; ++run) {
      Surface by_cubes, by_vector;
      auto start = std::chrono::steady_clock::now();
      isosurface::extract_cubes(field, row.value, how, by_cubes);
      cubes.push_back(seconds_since(start));
      start = std::chrono::steady_clock::now();
      isosurface::extract_vector(field, row.value, how, by_vector);
      vector.push_back(seconds_since(start));
      if (run > 0) continue;
      row.triangles = by_cubes.triangles.size();
      if (const auto found = isosurface::difference(by_cubes, by_vector, volume.size)) {
        throw Error(ErrorCode::kInternal,
                    fmt::format("cubes and vector give different surfaces at {}: {}", row.value, *found));
      }
    }
    row.cubes_seconds = median_of(cubes);
    row.vector_seconds = median_of(vector);
    row.gain = row.vector_seconds > 0 ? row.cubes_seconds / row.vector_seconds : 0;
    rows.push_back(row);
  }
  job.report(1, "done");
  return rows;
}

}  // namespace footwall::tasks
