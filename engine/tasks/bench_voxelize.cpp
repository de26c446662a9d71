#include "engine/tasks/bench_voxelize.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <exception>
#include <fstream>
#include <iterator>
#include <memory>
#include <mutex>
#include <utility>

#include "engine/voxelize/registry.h"
#include "engine/voxelize/simd.h"
#include "storage/base/error.h"
#include "storage/base/partial_file.h"
#include "storage/base/text.h"
#include "storage/survey/lattice.h"

namespace footwall::tasks {
namespace {

using survey::Index;
using survey::LatticeTriangle;

constexpr std::size_t kLargestFile = std::size_t{1} << 30;
constexpr int kMostThreads = 1024;
constexpr int kMostRepeats = 10000;
std::vector<std::string_view> fields_of(std::string_view line) {
  for (const char separator : {',', ';'}) {
    if (line.find(separator) != std::string_view::npos) return text::split(line, separator);
  }
  return text::words(line);
}

LatticeTriangle triangle_of(const std::vector<std::string_view>& fields, const std::string& where) {
  if (fields.size() != 9) {
    throw Error(ErrorCode::kFormat, fmt::format("{}: {} fields instead of 9", where, fields.size()),
                "a line holds i0,j0,k0,i1,j1,k1,i2,j2,k2 in voxels");
  }
  std::array<double, 9> numbers{};
  for (std::size_t column = 0; column < 9; ++column) {
    const auto number = text::number(fields[column]);
    if (!number) {
      throw Error(ErrorCode::kFormat, fmt::format("{}, column {}: '{}' is not a number", where, column + 1,
                                                  fields[column].substr(0, 40)));
    }
    numbers[column] = *number;
  }
  static const survey::Lattice lattice{survey::Geometry{}};
  LatticeTriangle triangle;
  for (std::size_t n = 0; n < 3; ++n) {
    try {
      triangle[n] = lattice.from_index({numbers[3 * n], numbers[3 * n + 1], numbers[3 * n + 2]});
    } catch (const Error& error) {
      throw Error(error.code(),
                  fmt::format("{}, columns {} to {}: {}", where, 3 * n + 1, 3 * n + 3, error.message()),
                  "coordinates are voxel indices");
    }
  }
  return triangle;
}

bool is_header(const std::vector<std::string_view>& fields) {
  return std::none_of(fields.begin(), fields.end(),
                      [](std::string_view f) { return text::number(f).has_value(); });
}

class CountingSink final : public voxelize::RowSink {
 public:
  explicit CountingSink(const JobContext& job) : job_(job) {}
  void row(const voxelize::Row& row) override {
    voxels_ += voxelize::voxels_in(row);
    if ((++rows_ & 1023) == 0) job_.check();
  }
  std::int64_t take() { return std::exchange(voxels_, 0); }

 private:
  const JobContext& job_;
  std::int64_t voxels_ = 0;
  std::uint32_t rows_ = 0;
};

class ListingSink final : public voxelize::RowSink {
 public:
  void row(const voxelize::Row& row) override {
    Index voxel{};
    voxel[row.v_axis] = row.v;
    for (std::size_t n = 0; n < row.lo.size(); ++n) {
      voxel[row.u_axis] = row.u0 + static_cast<std::int64_t>(n);
      for (std::int64_t w = row.lo[n]; w <= row.hi[n]; ++w) {
        voxel[row.w_axis] = w;
        voxels.push_back(voxel);
      }
    }
  }
  std::vector<Index> voxels;
};

// Counts of all triangles; the threads share them out dynamically. One voxelizer for each thread.
std::vector<std::int64_t> count_all(const std::vector<LatticeTriangle>& triangles,
                                    std::vector<std::unique_ptr<voxelize::Voxelizer>>& voxelizers,
                                    const JobContext& job) {
  constexpr std::size_t kShare = 8;
  std::vector<std::int64_t> counts(triangles.size());
  std::atomic<std::size_t> next = 0;
  std::exception_ptr failure;
  std::mutex failing;
  const int threads = static_cast<int>(voxelizers.size());
#pragma omp parallel for num_threads(threads) schedule(static, 1)
  for (int thread = 0; thread < threads; ++thread) {
    try {
      CountingSink sink(job);
      for (;;) {
        const std::size_t first = next.fetch_add(kShare);
        if (first >= triangles.size()) break;
        job.check();
        for (std::size_t n = first; n < std::min(first + kShare, triangles.size()); ++n) {
          voxelizers[thread]->rows(triangles[n], kAllVoxels, sink);
          counts[n] = sink.take();
        }
      }
    } catch (...) {
      const std::lock_guard lock(failing);
      failure = std::current_exception();
      next = triangles.size();
    }
  }
  if (failure) std::rethrow_exception(failure);
  return counts;
}

class WritingSink final : public voxelize::RowSink {
 public:
  explicit WritingSink(std::ofstream& out) : out_(out) {}
  void begin(std::size_t triangle) { triangle_ = triangle; }
  void row(const voxelize::Row& row) override {
    listed_.voxels.clear();
    listed_.row(row);
    buffer_.clear();
    for (const Index& p : listed_.voxels) {
      fmt::format_to(std::back_inserter(buffer_), "{},{},{},{}\n", triangle_, p[0], p[1], p[2]);
    }
    out_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    if (!out_) throw Error(ErrorCode::kIo, "cannot write the list of voxels", "is the disk full?");
  }

 private:
  std::ofstream& out_;
  std::size_t triangle_ = 0;
  ListingSink listed_;
  fmt::memory_buffer buffer_;
};

void write_list(const std::filesystem::path& path, const std::vector<LatticeTriangle>& triangles,
                voxelize::Voxelizer& voxelizer, const JobContext& job) {
  refuse_to_replace_storage(path);
  PartialFile file(path);
  std::ofstream out(file.path(), std::ios::binary);
  if (!out) throw io_error("write", file.path().string(), errno);
  out << "triangle,i,j,k\n";
  WritingSink sink(out);
  for (std::size_t n = 0; n < triangles.size(); ++n) {
    job.check();
    sink.begin(n);
    voxelizer.rows(triangles[n], kAllVoxels, sink);
  }
  out.close();
  if (!out)
    throw Error(ErrorCode::kIo, "cannot write the list of voxels to " + path.string(), "is the disk full?");
  file.commit();
}

void check_options(const BenchVoxelizeOptions& options) {
  if (options.threads < 1 || options.threads > kMostThreads) {
    throw Error(ErrorCode::kUsage,
                fmt::format("{} threads; 1 to {} are possible", options.threads, kMostThreads));
  }
  if (options.repeats < 1 || options.repeats > kMostRepeats) {
    throw Error(ErrorCode::kUsage,
                fmt::format("{} repeats; 1 to {} are possible", options.repeats, kMostRepeats));
  }
}

void summarize(BenchVoxelizeResult& result) {
  std::vector<double> sorted = result.seconds_each;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t half = sorted.size() / 2;
  result.seconds = sorted.size() % 2 == 1 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
  result.seconds_min = sorted.front();
  result.seconds_max = sorted.back();
  if (result.seconds > 0) result.voxels_per_second = static_cast<double>(result.voxels) / result.seconds;
}

}  // namespace

std::vector<LatticeTriangle> parse_triangles_csv(std::string_view content, std::string_view name) {
  std::vector<LatticeTriangle> triangles;
  if (content.starts_with("\xEF\xBB\xBF")) content.remove_prefix(3);
  bool first = true;
  for (std::int64_t number = 1; !content.empty(); ++number) {
    const std::size_t end = std::min(content.find('\n'), content.size());
    const std::string_view line = text::trimmed(content.substr(0, end));
    content.remove_prefix(std::min(end + 1, content.size()));
    if (line.empty() || line.front() == '#') continue;
    const auto fields = fields_of(line);
    const bool header = first && is_header(fields);
    first = false;
    if (!header) triangles.push_back(triangle_of(fields, fmt::format("{}, line {}", name, number)));
  }
  return triangles;
}

std::vector<LatticeTriangle> read_triangles_csv(const std::filesystem::path& path) {
  return parse_triangles_csv(read_whole_file(path, kLargestFile), path.string());
}

BenchVoxelizeResult bench_voxelize(const BenchVoxelizeOptions& options, const JobContext& job) {
  check_options(options);
  std::vector<std::unique_ptr<voxelize::Voxelizer>> voxelizers;
  voxelizers.reserve(static_cast<std::size_t>(options.threads));
  for (int n = 0; n < options.threads; ++n) voxelizers.push_back(voxelize::make_voxelizer(options.voxelizer));
  const auto triangles = read_triangles_csv(options.triangles);

  BenchVoxelizeResult result;
  result.voxelizer = options.voxelizer;
  result.simd = voxelize::simd_in_use();
  result.threads = options.threads;
  result.triangles = static_cast<std::int64_t>(triangles.size());
  job.report(0, "check");
  result.check = check_voxelizer(options.voxelizer, triangles, job);
  result.exact = voxelize::method_of(options.voxelizer).exact;
  if (!result.exact) result.differences = differences_from_exact(options.voxelizer, triangles, 0, job);
  result.counts = count_all(triangles, voxelizers, job);  // also warms caches and buffers
  for (const std::int64_t count : result.counts) result.voxels += count;

  for (int n = 0; n < options.repeats; ++n) {
    job.report(static_cast<double>(n + 1) / (options.repeats + 2), "voxelize",
               fmt::format("run {} of {}", n + 1, options.repeats));
    const auto start = std::chrono::steady_clock::now();
    const auto counts = count_all(triangles, voxelizers, job);
    result.seconds_each.push_back(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    if (counts != result.counts) throw Error(ErrorCode::kInternal, "two runs counted different voxels");
  }
  summarize(result);
  if (!options.list.empty()) {
    job.report(static_cast<double>(options.repeats + 1) / (options.repeats + 2), "list");
    write_list(options.list, triangles, *voxelizers.front(), job);
  }
  job.report(1, "done");
  return result;
}

}  // namespace footwall::tasks
