#include "engine/comm/calibrate.h"

#include <algorithm>
#include <array>

namespace footwall::comm {
namespace {

constexpr int kTag = 7;
constexpr int kSmall = 8;           // bytes of a message that costs latency only
constexpr int kMiddle = 1 << 14;    // two sizes whose difference is bandwidth only
constexpr int kLarge = 1 << 21;     // more than a cache of a core keeps, as the messages of large surveys
constexpr int kMostPartners = 8;    // in a burst
constexpr std::size_t kFewest = 5;  // rounds whose median counts
constexpr std::size_t kOtherWork = 1 << 26;  // bytes that a rank looks at between messages
constexpr std::size_t kLine = 64;
constexpr double kLeast = 1e-12;  // what cannot be told from nothing: a picosecond a byte, or less

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

class Links {
 public:
  explicit Links(const Communicator& world)
      : world_(world), out_(kLarge), in_(kLarge), other_work_(kOtherWork) {
    // The ranks of one host usually follow each other, so that a partner half a world away is on another host
    // where there are several. The last of an odd number of ranks has none.
    const int half = world.size() / 2;
    if (world.rank() < half) partner_ = world.rank() + half;
    if (world.rank() >= half && world.rank() < 2 * half) partner_ = world.rank() - half;
  }

  // A message of `bytes` each way between the ranks of a pair, of the slowest pair.
  double both_ways(int bytes, double seconds) {
    return repeated(seconds, [&] {
      if (partner_ < 0) return;
      check(MPI_Sendrecv(out_.data(), bytes, MPI_BYTE, partner_, kTag, in_.data(), bytes, MPI_BYTE, partner_,
                         kTag, world_.get(), MPI_STATUS_IGNORE),
            "MPI_Sendrecv");
    });
  }

  // Small messages to `partners` ranks and from as many, all at once.
  double burst(int partners, double seconds) {
    return repeated(seconds, [&] {
      std::array<MPI_Request, std::size_t{2} * kMostPartners> requests{};
      int open = 0;
      for (int k = 1; k <= partners; ++k) {
        const int from = (world_.rank() - k + world_.size()) % world_.size();
        check(MPI_Irecv(in_.data() + std::ptrdiff_t{k} * kSmall, kSmall, MPI_BYTE, from, kTag, world_.get(),
                        &requests[static_cast<std::size_t>(open++)]),
              "MPI_Irecv");
      }
      for (int k = 1; k <= partners; ++k) {
        check(MPI_Isend(out_.data(), kSmall, MPI_BYTE, (world_.rank() + k) % world_.size(), kTag,
                        world_.get(), &requests[static_cast<std::size_t>(open++)]),
              "MPI_Isend");
      }
      check(MPI_Waitall(open, requests.data(), MPI_STATUSES_IGNORE), "MPI_Waitall");
    });
  }

 private:
  // Rounds for as long as all ranks have time; the median over the rounds of the slowest rank's time.
  template <typename Messages>
  double repeated(double seconds, Messages&& messages) {
    const double start = MPI_Wtime();
    std::vector<double> times;
    messages();  // sets up what MPI sets up at the first message
    double spent = 0;
    while (times.size() < kFewest || spent < seconds) {
      do_other_work();
      check(MPI_Barrier(world_.get()), "MPI_Barrier");
      const double begun = MPI_Wtime();
      messages();
      times.push_back(world_.maximum(MPI_Wtime() - begun));
      spent = world_.maximum(MPI_Wtime() - start);
    }
    return median(std::move(times));
  }
  // So that caches hold neither the messages nor MPI itself, as after computing.
  void do_other_work() {
    for (std::size_t at = 0; at < other_work_.size(); at += kLine) other_work_[at] ^= std::byte{1};
  }

  const Communicator& world_;
  int partner_ = -1;
  Bytes out_, in_, other_work_;
};

}  // namespace

LinkRates measure_links(const Communicator& world, double seconds) {
  LinkRates rates;
  if (world.size() == 1) return rates;
  Links links = world.collectively([&] { return Links(world); });
  const double share = seconds / 5;
  rates.alpha = std::max(kLeast, links.both_ways(kSmall, share));
  const double middle = links.both_ways(kMiddle, share);
  const double large = links.both_ways(kLarge, share);
  rates.byte = std::max(kLeast, (large - middle) / (kLarge - kMiddle));
  const int partners = std::min(kMostPartners, world.size() - 1);
  // With one partner there is nothing to compare with: its message costs the latency.
  const double most = links.burst(partners, share);
  rates.overhead =
      partners == 1 ? std::min(most, rates.alpha) : (most - links.burst(1, share)) / (partners - 1);
  rates.overhead = std::max(kLeast, rates.overhead);
  return rates;
}

}  // namespace footwall::comm
