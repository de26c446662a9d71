// How fast a SEG-Y file becomes a volume, beside a plain copy of the same file and beside segyio reading it.
//   bench_ingest [--size 512x512x1000] [--order inline|crossline|shuffled] [--folder DIR] [--repeat 5]
// Each run is a process of its own, so that its processor time and peak memory are its own; runs are paired:
// every repeat runs all of them once, cold and warm. Cold: the file is on the disk and not in this machine's
// page cache. A copy and an import end when their output is on the disk. What was read is checked in full
// first.
#include <fcntl.h>
#include <omp.h>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <bit>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <thread>

#include "bench/ingest/made_file.h"
#include "storage/base/error.h"
#include "storage/formats/segy/segy_file.h"
#include "storage/volume/volume_reader.h"
#include "storage/volume/volume_writer.h"
#ifdef FOOTWALL_HAS_SEGYIO
#include "bench/ingest/segyio_reader.h"
#endif

namespace {

namespace fs = std::filesystem;
using footwall::Error;
using footwall::ErrorCode;
using footwall::survey::Box;
using footwall::survey::Index;

struct Cost {
  double wall = 0;
  double processor = 0;
  double peak_mib = 0;
};

struct Contender {
  std::string name;
  std::function<void()> run;
  std::vector<Cost> cold, warm;
};

double seconds(const timeval& t) {
  return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) * 1e-6;
}

// f in a child process; ends the program if it fails.
Cost cost_of(const std::function<void()>& f) {
  std::fflush(stdout);
  const auto start = std::chrono::steady_clock::now();
  const pid_t child = ::fork();
  if (child < 0) throw Error(ErrorCode::kInternal, "cannot fork");
  if (child == 0) {
    try {
      f();
      std::fflush(stdout);
      ::_exit(0);
    } catch (const std::exception& error) {
      fmt::print(stderr, "bench_ingest: {}\n", error.what());
      ::_exit(1);
    }
  }
  int status = 0;
  rusage usage{};
  if (::wait4(child, &status, 0, &usage) != child) throw Error(ErrorCode::kInternal, "the run was lost");
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw Error(ErrorCode::kInternal, "a run failed");
  return {spent.count(), seconds(usage.ru_utime) + seconds(usage.ru_stime),
          static_cast<double>(usage.ru_maxrss) / 1024};
}

class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags) : id_(::open(path.c_str(), flags | O_CLOEXEC, 0644)) {
    if (id_ < 0) throw footwall::io_error("open", path, errno);
  }
  ~Descriptor() { ::close(id_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int id() const { return id_; }

 private:
  int id_;
};

void forget_pages(const fs::path& path) {
  const Descriptor file(path, O_RDONLY);
  if (::fsync(file.id()) != 0 || ::posix_fadvise(file.id(), 0, 0, POSIX_FADV_DONTNEED) != 0) {
    throw Error(ErrorCode::kIo, "the page cache cannot be emptied of the file");
  }
}

void copy_plainly(const fs::path& from, const fs::path& to, bool only_read) {
  const Descriptor in(from, O_RDONLY);
  const Descriptor out(only_read ? fs::path("/dev/null") : to, O_WRONLY | O_CREAT | O_TRUNC);
  std::vector<std::byte> buffer(std::size_t{1} << 20);
  for (ssize_t got = 0; (got = ::read(in.id(), buffer.data(), buffer.size())) > 0;) {
    if (::write(out.id(), buffer.data(), static_cast<std::size_t>(got)) != got) {
      throw footwall::io_error("write", to, errno);
    }
  }
  if (!only_read && ::fsync(out.id()) != 0) throw footwall::io_error("write", to, errno);
}

void import_file(const fs::path& from, const fs::path& to) {
  const auto file = footwall::formats::segy::SegyFile::scan(from, {});
  footwall::volume::WriteOptions options;
  options.geometry = file.geometry();
  options.source = "bench";
  footwall::volume::write_volume(
      to, options,
      [&](const Box& box, std::span<float> values, std::span<std::uint8_t> live) {
        file.read_block(box, values, live);
      },
      footwall::JobContext());
}

// Every sample of the volume against what the made file's were meant to be.
void check_volume(const fs::path& path, const Index& dims) {
  const footwall::volume::VolumeReader reader(path);
  footwall::require(reader.info().dims == dims, "the volume has the file's size");
  footwall::require(reader.info().statistics.null_count == 0, "every trace came through");
  const Index chunk = reader.info().chunk;
  std::vector<float> values;
  for (std::int64_t i = 0; i < dims[0]; i += chunk[0]) {
    const Box box{{i, 0, 0}, {std::min(dims[0], i + chunk[0]), dims[1], dims[2]}};
    values.resize(static_cast<std::size_t>(box.count()));
    reader.read(box, values);
    std::size_t n = 0;
    for (std::int64_t a = box.lo[0]; a < box.hi[0]; ++a) {
      for (std::int64_t b = 0; b < dims[1]; ++b) {
        for (std::int64_t c = 0; c < dims[2]; ++c) {
          if (values[n++] != footwall::bench::made_sample(a, b, c)) {
            throw Error(ErrorCode::kInternal, fmt::format("sample ({}, {}, {}) is wrong", a, b, c));
          }
        }
      }
    }
  }
}

#ifdef FOOTWALL_HAS_SEGYIO
std::uint32_t bit_sum_of(const Index& dims) {
  std::uint32_t sum = 0;
  for (std::int64_t i = 0; i < dims[0]; ++i) {
    for (std::int64_t j = 0; j < dims[1]; ++j) {
      for (std::int64_t k = 0; k < dims[2]; ++k) {
        sum += std::bit_cast<std::uint32_t>(footwall::bench::made_sample(i, j, k));
      }
    }
  }
  return sum;
}
#endif

void print(const Contender& contender, const char* state, const std::vector<Cost>& costs, double megabytes) {
  const auto sorted = [&](double Cost::*what) {
    std::vector<double> values;
    for (const Cost& cost : costs) values.push_back(cost.*what);
    std::sort(values.begin(), values.end());
    return values;
  };
  const std::vector<double> wall = sorted(&Cost::wall);
  fmt::print("{:16} {:5} {:7.2f} {:>15} {:9.0f} {:10.2f} {:9.0f}\n", contender.name, state,
             wall[wall.size() / 2], fmt::format("{:.2f} to {:.2f}", wall.front(), wall.back()),
             megabytes / wall[wall.size() / 2], sorted(&Cost::processor)[wall.size() / 2],
             sorted(&Cost::peak_mib).back());
}

void print_machine(int repeat) {
  utsname name{};
  ::uname(&name);
  fmt::print("{} {}, {} processors, {} threads a run; {} repeats: median, least to most\n", name.sysname,
             name.release, std::thread::hardware_concurrency(), omp_get_max_threads(), repeat);
}

void run(const Index& dims, const std::string& order, const fs::path& folder, int repeat,
         const std::string& only) {
  const fs::path input = folder / fmt::format("footwall-ingest-{}.sgy", ::getpid());
  const fs::path output = folder / fmt::format("footwall-ingest-{}.out", ::getpid());
  struct Removed {
    const fs::path &a, &b;
    ~Removed() {
      std::error_code ignored;
      fs::remove(a, ignored);
      fs::remove(b, ignored);
    }
  } const removed{input, output};
  footwall::bench::make_segy(input, dims, footwall::bench::trace_order_from(order));
  const double megabytes = static_cast<double>(fs::file_size(input)) * 1e-6;

  cost_of([&] {
    import_file(input, output);
    check_volume(output, dims);
  });
  fs::remove(output);

  std::vector<Contender> contenders;
  contenders.push_back({"read", [&] { copy_plainly(input, output, true); }, {}, {}});
  contenders.push_back({"copy", [&] { copy_plainly(input, output, false); }, {}, {}});
#ifdef FOOTWALL_HAS_SEGYIO
  const std::uint32_t expected = bit_sum_of(dims);
  for (const bool mapped : {false, true}) {
    contenders.push_back({mapped ? "segyio, mapped" : "segyio",
                          [&input, dims, expected, mapped] {
                            const auto read = footwall::bench::read_with_segyio(input, mapped);
                            footwall::require(read.traces == dims[0] * dims[1], "segyio read all traces");
                            footwall::require(read.bit_sum == expected, "segyio read the right samples");
                          },
                          {},
                          {}});
  }
#else
  fmt::print("built without libsegyio: no figures for it\n");
#endif
  contenders.push_back({"footwall import", [&] { import_file(input, output); }, {}, {}});

  std::erase_if(contenders, [&](const Contender& c) { return c.name.find(only) == std::string::npos; });

  for (int turn = 0; turn < repeat; ++turn) {
    for (Contender& contender : contenders) {
      forget_pages(input);
      contender.cold.push_back(cost_of(contender.run));
      fs::remove(output);
      copy_plainly(input, output, true);  // all of it into the page cache
      contender.warm.push_back(cost_of(contender.run));
      fs::remove(output);
    }
  }
  print_machine(repeat);
  fmt::print("{} x {} x {} IBM float32, {:.0f} MB, {} order\n{:16} {:5} {:>7} {:>15} {:>9} {:>10} {:>9}\n",
             dims[0], dims[1], dims[2], megabytes, order, "", "", "wall s", "least to most", "MB/s",
             "user+sys s", "peak MiB");
  for (const Contender& contender : contenders) {
    print(contender, "cold", contender.cold, megabytes);
    print(contender, "warm", contender.warm, megabytes);
  }
}

Index dims_from(const std::string& text) {
  Index dims;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%ldx%ldx%ld%c", &dims[0], &dims[1], &dims[2], &rest) != 3) {
    throw Error(ErrorCode::kUsage, "--size is IxJxK: inlines x crosslines x samples");
  }
  return dims;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("SEG-Y import, timed");
  std::string size = "512x512x1000";
  std::string order = "inline";
  std::string folder = fs::temp_directory_path();
  std::string made_only;
  std::string only;
  int repeat = 5;
  app.add_option("--size", size, "Inlines x crosslines x samples");
  app.add_option("--order", order, "Order of the traces: inline, crossline or shuffled");
  app.add_option("--folder", folder, "Where the made file and the outputs go");
  app.add_option("--repeat", repeat, "Runs of each kind")->check(CLI::PositiveNumber);
  app.add_option("--only", only, "Only the runs whose name holds this text");
  app.add_option("--make", made_only, "Only make the file, under this name, and keep it");
  CLI11_PARSE(app, argc, argv);
  try {
    if (!made_only.empty()) {
      footwall::bench::make_segy(made_only, dims_from(size), footwall::bench::trace_order_from(order));
      return 0;
    }
    run(dims_from(size), order, folder, repeat, only);
    return 0;
  } catch (const Error& error) {
    fmt::print(stderr, "bench_ingest: {}. {}\n", error.message(), error.hint());
    return 1;
  }
}
