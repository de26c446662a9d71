// Messages of known sizes that are under way while the rank does something else.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/comm/communicator.h"

namespace footwall::comm {

// Tells every rank how many bytes this one will send to it; returns what each will send here. Collective;
// counted: 8 bytes and a message for every other rank.
std::vector<std::uint64_t> exchange_sizes(Communicator& world, const std::vector<std::uint64_t>& outgoing);

// Receives and sends that were posted and have not ended. What is posted on one rank must be posted on the
// other: agree first (Communicator::collectively) that every rank has its buffers and will post. Only
// the thread that called MPI_Init may call it. Messages between two ranks with the same tag keep their order;
// long ones go in pieces of at most 1 GiB. Throws kEngine, also where a message has another size than was
// posted.
class Transfer {
 public:
  // tag: 2 and up, for transfers that are under way at the same time.
  Transfer(Communicator& world, int tag);
  // Waits for all that was posted: the other ranks have posted it, too.
  ~Transfer();
  Transfer(const Transfer&) = delete;
  Transfer& operator=(const Transfer&) = delete;

  // Nothing is posted for nothing, on either side. The memory must stay until the transfer has ended.
  void receive(int from, std::span<std::byte> into);
  void send(int to, std::span<const std::byte> bytes);

  // Lets MPI work; whether all has ended.
  bool progress();
  // Waits until all of one receive is there and returns the rank that it is from, each once; -1 when there
  // are no more.
  int next_received();
  // Waits for everything.
  void wait();

 private:
  struct Piece {
    int from = -1;  // -1: sent
    int bytes = 0;
  };
  // Waits for some that are open, or looks which have ended.
  void take(bool wait);
  void ended(std::size_t n, const MPI_Status& status);

  Communicator& world_;
  int tag_;
  std::vector<MPI_Request> requests_;
  std::vector<Piece> pieces_;     // of each request
  std::vector<int> pieces_left_;  // by rank: pieces of its receive that are not here
  std::vector<int> received_;     // ranks whose receive ended and was not told yet
  std::size_t open_ = 0;          // requests that have not ended
  std::vector<int> ended_;        // room for MPI's answers
  std::vector<MPI_Status> statuses_;
};

}  // namespace footwall::comm
