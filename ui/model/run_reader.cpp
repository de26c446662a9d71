#include "ui/model/run_reader.h"

#include <exception>
#include <string>
#include <utility>

#include "engine/extract/fault_side.h"

namespace footwall::ui {

RunReader::RunReader(project::Project project, Events events)
    : project_(std::move(project)), events_(std::move(events)), thread_([this] { work(); }) {}

RunReader::~RunReader() {
  {
    const std::scoped_lock lock(mutex_);
    ends_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

std::uint64_t RunReader::read(std::int64_t run) {
  std::uint64_t number = 0;
  {
    const std::scoped_lock lock(mutex_);
    run_ = run;
    waits_ = true;
    number = ++request_;
  }
  wake_.notify_one();
  return number;
}

void RunReader::stop() {
  const std::scoped_lock lock(mutex_);
  run_.reset();
  waits_ = false;
}

bool RunReader::is_wanted(std::uint64_t request) {
  const std::scoped_lock lock(mutex_);
  return !ends_ && run_ && request == request_;
}

void RunReader::work() {
  for (;;) {
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [this] { return ends_ || waits_; });
    if (ends_) return;
    waits_ = false;
    const std::int64_t run = *run_;
    const std::uint64_t request = request_;
    lock.unlock();
    read_all(request, run);
  }
}

void RunReader::read_all(std::uint64_t request, std::int64_t run) {
  try {
    for (const std::int64_t fault : project_.run_faults(run)) {
      if (!is_wanted(request)) return;
      auto read = std::make_shared<FaultOfRun>();
      read->numbers = project_.fault_statistics(run, fault);
      read->side = extract::fault_side(read->numbers.lattice);
      events_.came(request, std::move(read));
    }
    events_.ended(request, std::nullopt);
  } catch (const Error& error) {
    events_.ended(request, error);
  } catch (const std::exception& error) {
    events_.ended(request,
                  Error(ErrorCode::kMemory, std::string("the run could not be read: ") + error.what()));
  }
}

}  // namespace footwall::ui
