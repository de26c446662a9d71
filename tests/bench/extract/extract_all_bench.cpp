// EXTRACT-ALL and single-vertex move-extract cycles on surveys and faces of the size of seed 004's benchmarks
// (section 5.2.1): random triangles of area 1,000, values a hash of the index.
//   mpirun -n 2 bench_extract_all 1|2|3 [--updates N] [--threads T] [--exchange E] [--compute variance,...]
// An update changes the six faces around a vertex. Afterwards every number is compared with a full
// extraction.
#include <omp.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "engine/comm/environment.h"
#include "engine/extract/incremental.h"
#include "storage/base/text.h"

namespace footwall::extract {
namespace {

struct Benchmark {
  survey::Index dims;
  int faces;
};
constexpr std::array<Benchmark, 3> kBenchmarks{
    {{{100, 100, 50}, 5000}, {{200, 200, 100}, 10000}, {{400, 400, 200}, 15000}}};
constexpr double kArea = 1000;
constexpr int kFacesOfVertex = 6;

float value_of(std::int64_t i, std::int64_t j, std::int64_t k) {
  std::uint64_t h = static_cast<std::uint64_t>((i * 4096 + j) * 4096 + k) * 0x9e3779b97f4a7c15ULL;
  h ^= h >> 29;
  h *= 0xbf58476d1ce4e5b9ULL;
  h ^= h >> 32;
  return static_cast<float>(static_cast<std::int32_t>(h % 65536) - 32768) / 8;
}

void read(const survey::Box& box, std::span<float> out) {
  std::size_t n = 0;
  for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
    for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
      for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k) out[n++] = value_of(i, j, k);
    }
  }
}

// Fans of six faces around a vertex, each face of about the area; the vertices lie anywhere in the survey.
class Fans {
 public:
  Fans(const Benchmark& benchmark, unsigned seed) : dims_(benchmark.dims), random_(seed) {
    for (int n = 0; n < benchmark.faces; n += kFacesOfVertex) {
      Fan fan;
      for (std::size_t axis = 0; axis < 3; ++axis)
        fan.centre[axis] = uniform() * static_cast<double>(dims_[axis]);
      const double a = uniform() * 6.283;
      const double tilt = uniform() * 3.14;
      fan.u = {std::cos(a), std::sin(a), 0};
      fan.v = {-std::sin(a) * std::cos(tilt), std::cos(a) * std::cos(tilt), std::sin(tilt)};
      fans_.push_back(fan);
      const int count = std::min(kFacesOfVertex, benchmark.faces - n);
      for (int f = 0; f < count; ++f) faces_.push_back({1, 0, n + f, triangle(fan, f, {0, 0, 0})});
    }
  }
  const std::vector<Face>& faces() const { return faces_; }

  // One vertex goes up to 10 voxels away.
  const std::vector<Face>& move_one() {
    const auto n = static_cast<std::size_t>(random_() % fans_.size());
    const std::array<double, 3> by{uniform() * 20 - 10, uniform() * 20 - 10, uniform() * 20 - 10};
    moved_.clear();
    for (std::size_t at = n * kFacesOfVertex; at < std::min(faces_.size(), (n + 1) * kFacesOfVertex); ++at) {
      faces_[at].triangle = triangle(fans_[n], static_cast<int>(at % kFacesOfVertex), by);
      moved_.push_back(faces_[at]);
    }
    return moved_;
  }

 private:
  using Vector = std::array<double, 3>;
  struct Fan {
    Vector centre, u, v;
  };

  double uniform() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  survey::LatticeTriangle triangle(const Fan& fan, int face, const Vector& by) const {
    // Equilateral faces of a side with the area asked for.
    const double side = std::sqrt(kArea * 4 / std::sqrt(3.0));
    survey::LatticeTriangle t{};
    for (int corner = 0; corner < 3; ++corner) {
      Vector p = fan.centre;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (corner == 0) {
          p[axis] += by[axis];
        } else {
          const double angle = 6.283185307179586 / kFacesOfVertex * (face + corner - 1);
          p[axis] += side * (std::cos(angle) * fan.u[axis] + std::sin(angle) * fan.v[axis]);
        }
        p[axis] = std::round(p[axis] * survey::kLatticePerVoxel);
      }
      t[static_cast<std::size_t>(corner)] = {static_cast<std::int32_t>(p[0]), static_cast<std::int32_t>(p[1]),
                                             static_cast<std::int32_t>(p[2])};
    }
    return t;
  }

  survey::Index dims_;
  std::mt19937_64 random_;
  std::vector<Fan> fans_;
  std::vector<Face> faces_, moved_;
};

double processor_seconds() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) * 1e-6;
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

double at_share(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

void run(const comm::Communicator& world, const Benchmark& benchmark, const Options& options, int updates) {
  constexpr double kLargest = 4096;
  Fans fans(benchmark, 7);
  LoadedSurvey survey(world, benchmark.dims, read, {}, options.pillars);
  std::vector<double> wall;
  std::vector<double> processor;
  Report last;
  Report first;  // with nothing kept from before
  for (int n = 0; n < 6; ++n) {
    const double processor_before = processor_seconds();
    const double before = omp_get_wtime();
    last = survey.extract({benchmark.dims, kLargest, fans.faces()}, options).report;
    if (n == 0) first = last;
    wall.push_back(omp_get_wtime() - before);
    processor.push_back(processor_seconds() - processor_before);
  }
  if (world.rank() == 0) {
    std::printf(
        "%s, %d ranks, %d threads: %lld faces, %lld voxels, %lld bytes in %lld messages the first time\n",
        last.exchange.c_str(), last.ranks, last.threads, static_cast<long long>(last.faces),
        static_cast<long long>(last.voxels), static_cast<long long>(first.bytes_sent),
        static_cast<long long>(first.messages));
    std::printf("EXTRACT-ALL: median %.2f ms, best %.2f ms; processor %.2f ms, best %.2f ms\n",
                at_share(wall, 0.5) * 1e3, at_share(wall, 0) * 1e3, at_share(processor, 0.5) * 1e3,
                at_share(processor, 0) * 1e3);
  }
  if (updates == 0) return;

  Incremental incremental(survey, kLargest, options);
  FaceChanges changes;
  changes.added = fans.faces();
  incremental.update(changes);
  changes = {};
  std::vector<double> cycle;
  std::vector<double> busy;
  for (int n = 0; n < updates; ++n) {
    changes.changed = fans.move_one();
    const double processor_before = processor_seconds();
    const double before = omp_get_wtime();
    incremental.update(changes);
    cycle.push_back(omp_get_wtime() - before);
    busy.push_back(processor_seconds() - processor_before);
  }
  const Result full = survey.extract({benchmark.dims, kLargest, fans.faces()}, options);
  world.collectively([&] {
    if (world.rank() != 0) return;
    const std::uint64_t kept = checksum_of(incremental.faces(), incremental.all_statistics());
    require(kept == full.report.checksum, "what a full extraction gives");
  });
  if (world.rank() == 0) {
    double sum = 0;
    for (const double seconds : busy) sum += seconds;
    std::printf(
        "%d single-vertex updates: p50 %.3f ms, p99 %.3f ms, largest %.3f ms; processor %.3f ms each\n",
        updates, at_share(cycle, 0.5) * 1e3, at_share(cycle, 0.99) * 1e3, at_share(cycle, 1) * 1e3,
        sum / updates * 1e3);
  }
}

}  // namespace
}  // namespace footwall::extract

int main(int argc, char** argv) {
  using namespace footwall;
  const comm::Environment environment(argc, argv);
  try {
    const comm::Communicator world(MPI_COMM_WORLD);
    extract::Options options;
    int updates = 0;
    const int number = argc > 1 ? std::atoi(argv[1]) : 0;
    if (number < 1 || number > 3) throw Error(ErrorCode::kUsage, "give a benchmark: 1, 2 or 3");
    for (int n = 2; n + 1 < argc; n += 2) {
      const std::string name = argv[n];
      const std::string value = argv[n + 1];
      if (name == "--updates")
        updates = std::atoi(value.c_str());
      else if (name == "--threads")
        options.threads = std::atoi(value.c_str());
      else if (name == "--exchange")
        options.exchange = value;
      else if (name == "--balance")
        options.balance = value;
      else if (name == "--compute") {
        for (const std::string_view each : text::split(value, ',')) options.compute.emplace_back(each);
      } else
        throw Error(ErrorCode::kUsage, "there is no option " + name);
    }
    extract::run(world, extract::kBenchmarks[static_cast<std::size_t>(number - 1)], options, updates);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    MPI_Abort(MPI_COMM_WORLD, 1);
    return 1;
  }
}
