#include "app/footwall-engine/running_job.h"

#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>

namespace footwall::app {
namespace {

using Clock = std::chrono::steady_clock;

// A line for every hundredth and for every new phase, at most ten a second.
JobContext::Listener progress_printer() {
  return [last = -1.0, phase = std::string(), time = Clock::time_point()](const Progress& progress) mutable {
    const auto now = Clock::now();
    const bool new_phase = phase != progress.phase;
    if (!new_phase && progress.fraction < 1 &&
        (progress.fraction < last + 0.01 || now < time + std::chrono::milliseconds(100))) {
      return;
    }
    last = progress.fraction;
    phase = progress.phase;
    time = now;
    print_line({{"progress",
                 {{"fraction", progress.fraction},
                  {"phase", std::string(progress.phase)},
                  {"amounts", progress.amounts}}}});
  };
}

// Signal handlers can reach nothing but variables of the file.
const JobContext* current_job = nullptr;
volatile std::sig_atomic_t stopped = 0;
volatile std::sig_atomic_t terminated = 0;
void stop_running_job(int number) {
  stopped = 1;
  if (number == SIGTERM || number == SIGUSR1) terminated = 1;
  if (current_job != nullptr) current_job->cancel();
}

}  // namespace

void print_line(const nlohmann::json& json) {
  const std::string line = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  // One write, so that lines of several writers do not mix.
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, line.data(), line.size());
}

void print_error(const Error& error) {
  print_line({{"error",
               {{"code", std::string(name_of(error.code()))},
                {"message", error.message()},
                {"hint", error.hint()}}}});
}

void heed_signals() {
  struct sigaction action = {};
  action.sa_handler = stop_running_job;
  action.sa_flags = SA_RESTART;
  for (const int number : {SIGINT, SIGTERM, SIGUSR1, SIGUSR2}) sigaction(number, &action, nullptr);
}

bool told_to_make_room() {
  return terminated != 0;
}

const JobContext& running_job(const comm::Communicator& world) {
  static JobContext job;  // lives as long as a signal may come
  if (world.rank() == 0) job = JobContext(progress_printer());
  current_job = &job;
  if (stopped != 0) job.cancel();  // by a signal that came before
  return job;
}

}  // namespace footwall::app
