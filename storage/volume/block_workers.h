// Threads that work on blocks while the next ones are read: a fixed set of slots goes round between one
// producer and the workers, so that memory is bounded and nobody spins while waiting.
#pragma once
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace footwall::volume {

class BlockWorkers {
 public:
  // work(slot, worker) runs on one of the threads, 0 <= worker < threads; never twice at once for one slot.
  using Work = std::function<void(std::size_t slot, std::size_t worker)>;

  BlockWorkers(std::size_t threads, std::size_t slots, Work work);
  // Gives up what has not been started and waits for what has.
  ~BlockWorkers();
  BlockWorkers(const BlockWorkers&) = delete;
  BlockWorkers& operator=(const BlockWorkers&) = delete;

  // For the producer's thread. Each throws the first error that a worker has thrown.
  std::size_t take_free();        // waits for a slot that nobody works on
  void submit(std::size_t slot);  // hands it to the workers
  void finish();                  // waits until all submitted slots are done

 private:
  void run(std::size_t worker);
  void rethrow() const;

  Work work_;
  std::mutex mutex_;
  std::condition_variable changed_for_workers_;
  std::condition_variable changed_for_producer_;
  std::vector<std::size_t> free_;
  std::deque<std::size_t> waiting_;
  std::size_t slots_;
  bool stopping_ = false;
  std::exception_ptr failure_;
  std::vector<std::thread> threads_;
};

}  // namespace footwall::volume
