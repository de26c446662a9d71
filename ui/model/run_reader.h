// Reads the numbers of a stored run, fault by fault, on a thread and a connection to the project of its own.
#pragma once
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "storage/base/error.h"
#include "storage/project/project.h"

namespace footwall::ui {

// What a run says of one fault.
struct FaultOfRun {
  project::FaultRun numbers;
  int side = 1;  // of its faces as they were: FaultSurface::side
};

class RunReader {
 public:
  // Called on the reader's thread, with the number that read() gave.
  struct Events {
    std::function<void(std::uint64_t request, std::shared_ptr<const FaultOfRun>)> came;
    // failure: why not all came.
    std::function<void(std::uint64_t request, const std::optional<Error>& failure)> ended;
  };

  RunReader(project::Project project, Events events);
  // Waits for the fault that is being read.
  ~RunReader();
  RunReader(const RunReader&) = delete;
  RunReader& operator=(const RunReader&) = delete;

  // In the place of what was asked for before, of which at most one more fault comes.
  std::uint64_t read(std::int64_t run);
  void stop();

 private:
  void work();
  void read_all(std::uint64_t request, std::int64_t run);
  bool is_wanted(std::uint64_t request);

  project::Project project_;  // of the thread
  const Events events_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<std::int64_t> run_;  // to be read, or being read
  bool waits_ = false;               // it has not been begun
  bool ends_ = false;
  std::uint64_t request_ = 0;  // the newest
  std::thread thread_;
};

}  // namespace footwall::ui
