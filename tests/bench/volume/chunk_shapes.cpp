// Chooses the chunk shape by measurement: writes one volume in several chunk shapes and reads it as ranks,
// sections and time slices do, warm, through VolumeReader, so with every hash checked. Not a test: run it by
// hand.
//   bench_volume_chunk_shapes [FOLDER [side [repeats]]]     (default: the temporary folder, 384, 3)
#include <fmt/format.h>
#include <time.h>
#include <unistd.h>
#include <cstdlib>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "storage/base/error.h"
#include "storage/volume/volume_reader.h"
#include "storage/volume/volume_writer.h"

namespace {

using footwall::survey::Box;
using footwall::survey::Index;
using namespace footwall::volume;

// The processor's time, not the clock's: warm reads are copies and hashes, and a shared machine stretches the
// clock.
double cpu_now() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

double seconds_of(const std::function<void()>& f) {
  const double start = cpu_now();
  f();
  return cpu_now() - start;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// Cheap to make, so that the time is the writer's.
float sample_at(std::int64_t i, std::int64_t j, std::int64_t k) {
  return static_cast<float>(((i * 31 + j * 17 + k * 13) & 1023) - 512) * (1.0F + static_cast<float>(k & 7));
}

void fill(const Box& box, std::span<float> values, std::span<std::uint8_t>) {
  std::size_t n = 0;
  for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
    for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
      for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k) values[n++] = sample_at(i, j, k);
    }
  }
}

// Reads the boxes one after another into memory that is warm already; checks one value of each.
double read_all(const VolumeReader& reader, const std::vector<Box>& boxes, std::vector<float>& out) {
  double total = 0;
  for (const Box& box : boxes) {
    const std::span<float> into = std::span(out).first(static_cast<std::size_t>(box.count()));
    total += seconds_of([&] { reader.read(box, into); });
    footwall::require(into.back() == sample_at(box.hi[0] - 1, box.hi[1] - 1, box.hi[2] - 1),
                      "the right samples");
  }
  return total;
}

}  // namespace

int main(int argc, char** argv) {
  const std::filesystem::path folder = argc > 1 ? argv[1] : std::filesystem::temp_directory_path().string();
  const std::filesystem::path path = folder / fmt::format("footwall-bench-{}.h5", ::getpid());
  const std::int64_t n = argc > 2 ? std::atoll(argv[2]) : 384;
  const int repeats = argc > 3 ? std::atoi(argv[3]) : 3;
  if (n < 200) return std::fputs("the side must be at least 200\n", stderr), 2;
  const std::int64_t h = n / 2;
  const std::vector<std::pair<const char*, std::vector<Box>>> kinds{
      {"2 ranks", {{{0, 0, 0}, {h, n, n}}, {{h, 0, 0}, {n, n, n}}}},
      {"4 ranks",
       {{{0, 0, 0}, {h, h, n}}, {{0, h, 0}, {h, n, n}}, {{h, 0, 0}, {n, h, n}}, {{h, h, 0}, {n, n, n}}}},
      {"brick 65^3", {{{64, 64, 64}, {129, 129, 129}}, {{128, 128, 128}, {193, 193, 193}}}},
      {"inline", {{{h + 5, 0, 0}, {h + 6, n, n}}}},
      {"crossline", {{{0, h + 5, 0}, {n, h + 6, n}}}},
      {"time slice", {{{0, 0, h + 5}, {n, n, h + 6}}}}};
  std::vector<float> out(static_cast<std::size_t>(n * n * n), 0.0F);
  fmt::print("{}^3 float32, processor time, median of {}\n{:>13} {:>10}", n, repeats, "chunk", "write MB/s");
  for (const auto& kind : kinds) fmt::print(" {:>15}", kind.first);
  fmt::print("\n");
  for (const Index& chunk : std::vector<Index>{{16, 16, 16},
                                               {32, 32, 32},
                                               {32, 32, 128},
                                               {64, 64, 32},
                                               {64, 64, 64},
                                               {128, 128, 128},
                                               {16, 256, 256},
                                               {16, 16, n},
                                               {64, 64, n}}) {
    WriteOptions options;
    options.geometry.inlines.count = options.geometry.crosslines.count = options.geometry.samples = n;
    options.chunk = chunk;
    double filling = 0;
    const BlockSource source = [&](const Box& box, std::span<float> values, std::span<std::uint8_t> live) {
      filling += seconds_of([&] { fill(box, values, live); });
    };
    const double writing =
        seconds_of([&] { write_volume(path, options, source, footwall::JobContext()); }) - filling;
    const VolumeReader reader(path);
    fmt::print("{:>13} {:>10.0f}", fmt::format("{}x{}x{}", chunk[0], chunk[1], chunk[2]),
               static_cast<double>(n * n * n) * 4e-6 / writing);
    for (const auto& kind : kinds) {
      std::vector<double> times;
      times.reserve(static_cast<std::size_t>(repeats));
      std::int64_t voxels = 0;
      for (const Box& box : kind.second) voxels += box.count();
      for (int r = 0; r < repeats; ++r) times.push_back(read_all(reader, kind.second, out));
      const double time = median(times);
      fmt::print(" {:>7.1f} ms {:>4.1f}", time * 1e3, static_cast<double>(voxels) * 4e-9 / time);
    }
    fmt::print("\n");
    std::fflush(stdout);
  }
  fmt::print("second number: GB/s of the samples asked for\n");
  std::filesystem::remove(path);
  return 0;
}
