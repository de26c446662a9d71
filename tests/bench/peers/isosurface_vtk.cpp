// vtkFlyingEdges3D against footwall::isosurface::extract() on one raw file, in turns in one run:
//
//   isosurface_vtk --raw FILE --dims X,Y,Z --value V [--threads T] [--repeat R] [--no-normals] [--tuned]
//
// Fresh: every repeat starts from released buffers, and allocating is part of it. Reused: the same filter, or
// the same Surface, again. Both sides give float32 points and normals; VTK's indices are 64-bit, ours 32-bit.
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/isosurface/brick_ranges.h"
#include "engine/isosurface/case_tables.h"
#include "engine/isosurface/extract.h"
#include "flying_edges.h"
#include "storage/base/error.h"

namespace {

using namespace footwall;
using namespace footwall::isosurface;

struct Arguments {
  std::string raw;
  std::vector<std::int64_t> dims;
  float value = 0;
  int threads = 1;
  int repeat = 7;
  bool no_normals = false;
  bool tuned = false;
};

double seconds_of(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// The medians of wall time and of the processor time of all threads.
struct Times {
  std::vector<double> wall;
  std::vector<double> processor;

  void add(const std::function<void()>& work) {
    const double wall_start = seconds_of(CLOCK_MONOTONIC);
    const double processor_start = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
    work();
    processor.push_back(seconds_of(CLOCK_PROCESS_CPUTIME_ID) - processor_start);
    wall.push_back(seconds_of(CLOCK_MONOTONIC) - wall_start);
  }
  static double median(std::vector<double> all) {
    std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2), all.end());
    return 1e3 * all[all.size() / 2];
  }
};

std::vector<float> read_raw(const Arguments& arguments) {
  std::vector<float> values(
      static_cast<std::size_t>(arguments.dims[0] * arguments.dims[1] * arguments.dims[2]));
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(arguments.raw.c_str(), "rb"),
                                                             &std::fclose);
  if (file == nullptr ||
      std::fread(values.data(), sizeof(float), values.size(), file.get()) != values.size()) {
    throw Error(ErrorCode::kIo, fmt::format("cannot read {} values of {}", values.size(), arguments.raw));
  }
  return values;
}

class Footwall {
 public:
  Footwall(const std::vector<float>& values, const Arguments& arguments, const Bricks* bricks)
      : isovalue_(arguments.value) {
    const survey::Index size{arguments.dims[0], arguments.dims[1], arguments.dims[2]};
    field_ = {values, size, {0, 0, 0}, size};
    options_.normals = !arguments.no_normals;
    options_.threads = arguments.threads;
    options_.bricks = bricks;
  }
  void release() { surface_ = {}; }
  void run() { extract(field_, isovalue_, options_, surface_); }
  const Field& field() const { return field_; }
  const Surface& surface() const { return surface_; }

 private:
  Field field_;
  float isovalue_;
  ExtractOptions options_;
  Surface surface_;
};

// MiB that the work adds at its height, in a process of its own.
double peak_mib(const std::function<void()>& work) {
  int ends[2];
  if (pipe(ends) != 0) throw Error(ErrorCode::kIo, "no pipe");
  const auto status_kib = [](const char* name) {
    double kib = 0;
    char line[256];
    std::FILE* const status = std::fopen("/proc/self/status", "r");
    while (status != nullptr && std::fgets(line, sizeof(line), status) != nullptr) {
      if (std::string(line).rfind(name, 0) == 0) kib = std::atof(line + std::string(name).size());
    }
    if (status != nullptr) std::fclose(status);
    return kib;
  };
  const pid_t child = fork();
  if (child == 0) {
    std::FILE* const clear = std::fopen("/proc/self/clear_refs", "w");
    if (clear != nullptr) {
      std::fputs("5", clear);  // forgets the height so far
      std::fclose(clear);
    }
    const double before = status_kib("VmRSS:");
    work();
    const double mib = (status_kib("VmHWM:") - before) / 1024;
    _exit(write(ends[1], &mib, sizeof(mib)) == sizeof(mib) ? 0 : 1);
  }
  close(ends[1]);
  double mib = 0;
  const bool read_all = child > 0 && read(ends[0], &mib, sizeof(mib)) == sizeof(mib);
  close(ends[0]);
  int status = 0;
  if (child > 0) waitpid(child, &status, 0);
  if (!read_all) throw Error(ErrorCode::kEngine, "the process that measures memory ended early");
  return mib;
}

// The answer before the time: VTK's vertices are those on edges, and only cells that it decides in another
// way than the trilinear field can have other numbers of triangles.
void check(const FlyingEdges& vtk, Footwall& ours, float isovalue) {
  ExtractOptions options;
  options.keys = true;
  Surface with_keys;
  extract(ours.field(), isovalue, options, with_keys);
  const auto centres = std::count_if(with_keys.keys.data(), with_keys.keys.data() + with_keys.keys.size(),
                                     [](VertexKey key) { return (key & 3) == 3; });
  std::int64_t undecided = 0;
  const auto& size = ours.field().size;
  for (std::int64_t i = 0; i + 1 < size[0]; ++i) {
    for (std::int64_t j = 0; j + 1 < size[1]; ++j) {
      for (std::int64_t k = 0; k + 1 < size[2]; ++k) {
        unsigned signs = 0;
        for (unsigned c = 0; c < 8; ++c) {
          const std::int64_t at = ((i + (c & 1U)) * size[1] + j + (c >> 1U & 1U)) * size[2] + k + (c >> 2U);
          if (ours.field().values[static_cast<std::size_t>(at)] >= isovalue) signs |= 1U << c;
        }
        if (is_undecided(signs)) ++undecided;
      }
    }
  }
  const auto vertices = static_cast<std::int64_t>(ours.surface().positions.size());
  const auto triangles = static_cast<std::int64_t>(ours.surface().triangles.size());
  fmt::print("triangles {}, VTK {}; vertices {} of them {} centres, VTK {}; {} undecided cells\n", triangles,
             vtk.triangles(), vertices, centres, vtk.vertices(), undecided);
  constexpr std::int64_t kMostInACell = 12;
  if (vertices - centres != vtk.vertices() ||
      std::abs(triangles - vtk.triangles()) > kMostInACell * undecided) {
    throw Error(ErrorCode::kInternal, "the two surfaces differ");
  }
}

// Reads all of it once.
std::uint64_t streamed(const std::vector<float>& values) {
  const auto* const words = reinterpret_cast<const std::uint32_t*>(values.data());
  std::uint32_t all = 0;
  for (std::size_t n = 0; n < values.size(); ++n) all ^= words[n];
  return all;
}

void compare(const Arguments& arguments) {
  std::vector<float> values = read_raw(arguments);
  FlyingEdges vtk(values, {arguments.dims[0], arguments.dims[1], arguments.dims[2]}, arguments.value,
                  !arguments.no_normals, arguments.threads);
  Footwall ours(values, arguments, nullptr);
  // First of all, before there are threads, which a child would not have.
  const double vtk_mib = peak_mib([&] { vtk.run(); });
  const double our_mib = peak_mib([&] { ours.run(); });

  Times making;
  BrickRanges ranges;
  for (int n = 0; n < arguments.repeat; ++n) {
    making.add([&] { ranges = brick_ranges(ours.field(), arguments.threads); });
  }
  const Bricks bricks = ranges.tables();
  Footwall skipping(values, arguments, &bricks);
  std::size_t active = 0;
  for (std::size_t n = 0; n < ranges.min.size(); ++n) {
    if (ranges.min[n] < arguments.value && arguments.value <= ranges.max[n]) ++active;
  }
  vtk.run();
  ours.run();
  check(vtk, ours, arguments.value);

  Times limit;
  std::uint64_t sum = 0;
  Times fresh[3];
  Times reused[3];
  for (int n = 0; n < arguments.repeat; ++n) {
    limit.add([&] { sum += streamed(values); });
    vtk.release();
    fresh[0].add([&] { vtk.run(); });
    reused[0].add([&] { vtk.run(); });
    vtk.release();
    ours.release();
    fresh[1].add([&] { ours.run(); });
    reused[1].add([&] { ours.run(); });
    ours.release();
    skipping.release();
    fresh[2].add([&] { skipping.run(); });
    reused[2].add([&] { skipping.run(); });
    skipping.release();
  }
  const char* const tunables = std::getenv("GLIBC_TUNABLES");
  fmt::print("VTK {}; {} threads, {}normals, {} repeats; malloc: {}; {:.1f} % of the bricks active ({})\n",
             FlyingEdges::version(), arguments.threads, arguments.no_normals ? "no " : "", arguments.repeat,
             tunables == nullptr ? "as it is" : tunables,
             100.0 * static_cast<double>(active) / static_cast<double>(ranges.min.size()), sum % 10);
  fmt::print("{:<34} {:>10} {:>10} {:>8} {:>14}\n", "medians in ms", "wall", "processor", "ratio",
             "ratio of proc.");
  const auto line = [&](const char* name, const Times& times, const Times& vtk_times) {
    const double wall = Times::median(times.wall);
    const double processor = Times::median(times.processor);
    fmt::print("{:<34} {:>10.2f} {:>10.2f} {:>8.2f} {:>14.2f}\n", name, wall, processor,
               Times::median(vtk_times.wall) / wall, Times::median(vtk_times.processor) / processor);
  };
  line("vtkFlyingEdges3D, fresh", fresh[0], fresh[0]);
  line("footwall, fresh", fresh[1], fresh[0]);
  line("footwall with ranges, fresh", fresh[2], fresh[0]);
  line("vtkFlyingEdges3D, reused", reused[0], reused[0]);
  line("footwall, reused", reused[1], reused[0]);
  line("footwall with ranges, reused", reused[2], reused[0]);
  line("making the ranges", making, fresh[0]);
  line("one streaming read, one thread", limit, fresh[0]);
  fmt::print("peak memory over the input: VTK {:.1f} MiB, footwall {:.1f} MiB\n", vtk_mib, our_mib);
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("vtkFlyingEdges3D and Footwall on the same volume");
  app.add_option("--raw", arguments.raw, "float32 samples, the last axis the fastest")->required();
  app.add_option("--dims", arguments.dims, "samples per axis")->required()->delimiter(',')->expected(3);
  app.add_option("--value", arguments.value, "isovalue")->required();
  app.add_option("--threads", arguments.threads)->check(CLI::PositiveNumber);
  app.add_option("--repeat", arguments.repeat)->check(CLI::PositiveNumber);
  app.add_flag("--no-normals", arguments.no_normals);
  app.add_flag("--tuned", arguments.tuned, "malloc() keeps what is freed, on huge pages");
  CLI11_PARSE(app, argc, argv);
  if (arguments.tuned && std::getenv("GLIBC_TUNABLES") == nullptr) {
    // Read by the C library when a program starts.
    setenv("GLIBC_TUNABLES",
           "glibc.malloc.hugetlb=1:glibc.malloc.mmap_threshold=4294967296:glibc.malloc.trim_threshold="
           "8589934592",
           1);
    execv("/proc/self/exe", argv);
  }
  try {
    compare(arguments);
  } catch (const Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
