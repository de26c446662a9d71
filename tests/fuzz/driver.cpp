// main() of every fuzz target: reads the originals, then feeds damaged copies of them to the target.
//   fuzz_NAME [--rounds N] [--seed S] [--only ROUND]
// Ends with 1 where a round crashes, hangs (20 s of the processor), throws anything but footwall::Error,
// breaks a promise, or where memory grows by more than 256 MiB after the first tenth of the rounds. The input
// that did it is written to fuzz-failure.bin in the working folder.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/time.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>

#include "fuzz/mutate.h"
#include "fuzz/target.h"
#include "storage/base/error.h"
#include "storage/base/text.h"

extern "C" void __sanitizer_set_death_callback(void (*callback)()) __attribute__((weak));

namespace footwall::fuzz {
namespace {

constexpr int kBusySeconds = 20;  // of the processor: a machine may be busy, and a run be stopped for a while
constexpr unsigned kHangSeconds = 600;  // of the clock, for rounds that wait
constexpr std::uintmax_t kLargestOriginal = 32 << 10;
constexpr std::int64_t kGrowthMiB = 256;
constexpr std::uint64_t kToldEvery = 50'000;

struct Arguments {
  std::uint64_t rounds = 2000;
  std::uint64_t seed = 1;
  std::optional<std::uint64_t> only;
};

// The input under test, for whoever reports its failure.
const std::string* current_input = nullptr;

void keep_input() {
  if (current_input == nullptr) return;
  const int file = ::open("fuzz-failure.bin", O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (file < 0) return;
  std::size_t done = 0;
  while (done < current_input->size()) {
    const ssize_t n = ::write(file, current_input->data() + done, current_input->size() - done);
    if (n <= 0) break;
    done += static_cast<std::size_t>(n);
  }
  ::close(file);
}

void on_signal(int number) {
  keep_input();
  constexpr std::string_view kText =
      "fuzz: a round hangs or died of a signal; its input is in fuzz-failure.bin\n";
  [[maybe_unused]] const ssize_t n = ::write(STDERR_FILENO, kText.data(), kText.size());
  ::_exit(number == SIGALRM || number == SIGPROF ? 1 : 128 + number);
}

std::int64_t resident_mib() {
  std::ifstream statm("/proc/self/statm");
  std::int64_t total = 0;
  std::int64_t resident = 0;
  statm >> total >> resident;
  return resident * ::sysconf(_SC_PAGESIZE) / (std::int64_t{1} << 20);
}

std::filesystem::path data_folder() {
  const char* told = std::getenv("FOOTWALL_TEST_DATA");
  return told != nullptr ? std::filesystem::path(told)
                         : std::filesystem::path(FOOTWALL_SOURCE_DIR) / ".." / "shared" / "data";
}

void add_file(const std::filesystem::path& path, std::vector<std::string>& originals) {
  std::error_code trouble;
  if (!std::filesystem::is_regular_file(path, trouble)) return;
  if (std::filesystem::file_size(path, trouble) > kLargestOriginal || trouble) return;
  std::ifstream in(path, std::ios::binary);
  originals.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
}

std::vector<std::string> originals_of(const Target& target) {
  std::vector<std::string> originals = target.made;
  const std::filesystem::path folder = data_folder();
  for (const std::string& name : target.files) {
    const std::filesystem::path path = folder / name;
    if (path.stem() != "*") {
      add_file(path, originals);
      continue;
    }
    std::error_code trouble;
    std::vector<std::filesystem::path> found;  // sorted: a folder's own order differs between machines
    for (const auto& entry : std::filesystem::directory_iterator(path.parent_path(), trouble)) {
      if (entry.path().extension() == path.extension()) found.push_back(entry.path());
    }
    std::sort(found.begin(), found.end());
    for (const std::filesystem::path& file : found) add_file(file, originals);
  }
  return originals;
}

// Ends the program where a round takes longer; 0 to stop watching.
void watch(int busy_seconds, unsigned hang_seconds) {
  const itimerval limit{{0, 0}, {busy_seconds, 0}};
  require(::setitimer(ITIMER_PROF, &limit, nullptr) == 0, "setitimer");
  ::alarm(hang_seconds);
}

// Empty where the round went well, else what is wrong.
std::string failure_of(const Target& target, const std::string& input) {
  current_input = &input;
  watch(kBusySeconds, kHangSeconds);
  std::string failure;
  try {
    if (!target.run(input)) failure = "breaks a promise of the reader";
  } catch (const Error& error) {
    if (error.code() == ErrorCode::kInternal) failure = fmt::format("internal error: {}", error.what());
  } catch (const std::exception& error) {
    failure = fmt::format("throws {}", error.what());
  }
  watch(0, 0);
  return failure;
}

int run(const Arguments& arguments) {
  const Target target = fuzz_target();
  const std::vector<std::string> originals = originals_of(target);
  for (const int number : {SIGALRM, SIGPROF}) std::signal(number, on_signal);
  // Under the sanitizer its own handlers say more; it calls back before it ends.
  if (__sanitizer_set_death_callback == nullptr) {
    for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGABRT, SIGILL}) std::signal(number, on_signal);
  }
  if (__sanitizer_set_death_callback != nullptr) __sanitizer_set_death_callback(keep_input);
  const auto begin = std::chrono::steady_clock::now();
  const std::uint64_t first = arguments.only.value_or(0);
  const std::uint64_t last = arguments.only ? first + 1 : arguments.rounds;
  std::int64_t settled_mib = 0;
  for (std::uint64_t round = first; round < last; ++round) {
    const std::string input = mutated(originals, arguments.seed, round);
    const std::string failure = failure_of(target, input);
    if (!failure.empty()) {
      keep_input();
      fmt::print(stderr, "fuzz: --seed {} --only {} {}; its input is in fuzz-failure.bin\n", arguments.seed,
                 round, failure);
      return 1;
    }
    if (round == first + (last - first) / 10) settled_mib = resident_mib();
    if ((round + 1) % kToldEvery == 0) fmt::print(stderr, "{} rounds\n", round + 1);
  }
  current_input = nullptr;
  const std::int64_t growth = resident_mib() - settled_mib;
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  fmt::print("{} rounds from {} originals in {:.1f} s, memory grew by {} MiB\n", last - first,
             originals.size(), seconds, growth);
  if (growth > kGrowthMiB) {
    fmt::print(stderr, "fuzz: memory grows\n");
    return 1;
  }
  return 0;
}

std::optional<Arguments> arguments_of(int count, char** words) {
  Arguments arguments;
  for (int n = 1; n < count; n += 2) {
    const std::string_view name = words[n];
    const auto value = n + 1 < count ? text::integer(words[n + 1]) : std::nullopt;
    if (!value || *value < 0) return std::nullopt;
    const auto number = static_cast<std::uint64_t>(*value);
    if (name == "--rounds") {
      arguments.rounds = number;
    } else if (name == "--seed") {
      arguments.seed = number;
    } else if (name == "--only") {
      arguments.only = number;
    } else {
      return std::nullopt;
    }
  }
  return arguments;
}

}  // namespace
}  // namespace footwall::fuzz

int main(int count, char** words) {
  const auto arguments = footwall::fuzz::arguments_of(count, words);
  if (!arguments) {
    fmt::print(stderr, "usage: {} [--rounds N] [--seed S] [--only ROUND]\n", words[0]);
    return 2;
  }
  return footwall::fuzz::run(*arguments);
}
