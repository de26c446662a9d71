#include "app/footwall/console/console.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <mutex>

#include "app/footwall/console/progress_line.h"

namespace footwall::console {
namespace {

// The one job that Ctrl+C stops: a signal handler can reach nothing else.
std::atomic<const JobContext*> g_interruptible{nullptr};  // NOLINT(readability-identifier-naming)

extern "C" void cancel_current_job(int) {
  if (const JobContext* job = g_interruptible.load()) job->cancel();
}

int terminal_columns() {
  winsize size{};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

}  // namespace

struct Console::Shown {
  std::mutex mutex;
  ProgressLine line{::isatty(STDERR_FILENO) == 1, terminal_columns(), ProgressLine::Clock::now()};

  void write(const std::string& text) {
    if (text.empty()) return;
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
  }
};

Console::Console(bool quiet) : shown_(std::make_shared<Shown>()) {
  if (!quiet) {
    job_ = JobContext([shown = shown_](const Progress& progress) {
      const std::scoped_lock lock(shown->mutex);
      shown->write(shown->line.update(progress, ProgressLine::Clock::now()));
    });
  }
  g_interruptible = &job_;
  struct sigaction action {};
  action.sa_handler = cancel_current_job;
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  // A file that reaches its size limit is an error to report, not a reason to die.
  std::signal(SIGXFSZ, SIG_IGN);
}

Console::~Console() {
  g_interruptible = nullptr;
  end_progress();
}

void Console::end_progress() {
  const std::scoped_lock lock(shown_->mutex);
  shown_->write(shown_->line.end());
}

int exit_status(ErrorCode code) {
  if (code == ErrorCode::kUsage) return 2;
  return code == ErrorCode::kCancelled ? 130 : 1;
}

Json error_json(const Error& error) {
  return {{"error", {{"code", name_of(error.code())}, {"message", error.message()}, {"hint", error.hint()}}}};
}

}  // namespace footwall::console
