#include "engine/render/composite/send.h"

namespace footwall::render {
namespace {

struct Message {
  int rank;
  const comm::Bytes* bytes;
};

// Sizes of all first, then all that is not empty.
std::vector<comm::Bytes> exchange(comm::Communicator& world, std::span<const Message> to,
                                  std::span<const int> from) {
  std::vector<std::uint64_t> sizes;
  std::vector<std::uint64_t> sizes_of_others(from.size());
  std::vector<comm::KnownOutgoing> outgoing;
  std::vector<comm::KnownIncoming> incoming;
  for (const Message& message : to) sizes.push_back(message.bytes->size());
  for (std::size_t n = 0; n < to.size(); ++n)
    outgoing.push_back({to[n].rank, std::as_bytes(std::span(&sizes[n], 1)), sizeof(std::uint64_t)});
  for (std::size_t n = 0; n < from.size(); ++n)
    incoming.push_back({from[n], std::as_writable_bytes(std::span(&sizes_of_others[n], 1))});
  world.exchange_known(outgoing, incoming);

  std::vector<comm::Bytes> received(from.size());
  outgoing.clear();
  incoming.clear();
  for (const Message& message : to) {
    if (!message.bytes->empty()) outgoing.push_back({message.rank, *message.bytes, message.bytes->size()});
  }
  for (std::size_t n = 0; n < from.size(); ++n) {
    received[n].resize(sizes_of_others[n]);
    if (!received[n].empty()) incoming.push_back({from[n], received[n]});
  }
  world.exchange_known(outgoing, incoming);
  return received;
}

}  // namespace

comm::Bytes swap_with(comm::Communicator& world, int partner, const comm::Bytes& mine) {
  const Message message{partner, &mine};
  return std::move(exchange(world, std::span(&message, 1), std::span(&partner, 1)).front());
}

void give_to(comm::Communicator& world, int partner, const comm::Bytes& mine) {
  const Message message{partner, &mine};
  exchange(world, std::span(&message, 1), {});
}

comm::Bytes take_from(comm::Communicator& world, int partner) {
  return std::move(exchange(world, {}, std::span(&partner, 1)).front());
}

std::vector<comm::Bytes> gather_to_first(comm::Communicator& world, int senders, const comm::Bytes& mine) {
  if (world.rank() != 0) {
    give_to(world, 0, mine);
    return {};
  }
  std::vector<int> others;
  for (int rank = 1; rank < senders; ++rank) others.push_back(rank);
  return exchange(world, {}, others);
}

}  // namespace footwall::render
