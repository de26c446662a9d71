#include "engine/render/composite/groups.h"

#include <algorithm>

#include "engine/render/composite/send.h"
#include "engine/render/visibility.h"

namespace footwall::render {
namespace {

// What a rank tells its partner.
struct Offer {
  std::int64_t bytes = 0;      // of geometry
  std::int64_t triangles = 0;  // the same
  std::int64_t pixels = 0;     // that they cover in the whole picture, about
  std::int64_t room = 0;       // the most bytes that it will hold
  std::int64_t refused = 0;    // 1: before, and so again
};

Offer swap_offers(comm::Communicator& world, int partner, const Offer& mine) {
  Offer other;
  const comm::KnownOutgoing to{partner, std::as_bytes(std::span(&mine, 1)), sizeof mine};
  comm::KnownIncoming from{partner, std::as_writable_bytes(std::span(&other, 1))};
  world.exchange_known(std::span(&to, 1), std::span(&from, 1));
  return other;
}

// The pair's numbers are put together so that swapping the two changes no bit: both partners decide alike.
class Decision {
 public:
  Decision(const Offer& mine, const Offer& theirs) : mine_(mine), theirs_(theirs) {}

  bool possible() const {
    const std::int64_t bytes = mine_.bytes + theirs_.bytes;
    return mine_.refused + theirs_.refused == 0 && bytes <= mine_.room && bytes <= theirs_.room;
  }
  bool by_ratio(double held_pixels, double threshold) const {
    const double picture = held_pixels * static_cast<double>(sizeof(Visible));
    return static_cast<double>(mine_.bytes + theirs_.bytes) <= threshold * picture;
  }
  // giver: the one that gives everything and is done, in step 0; else each gives half of the rows it holds.
  bool by_time(double held_pixels, double all_pixels, const Offer* giver, const GroupRates& rates) const {
    const auto both = [&](std::int64_t Offer::*amount) {
      return static_cast<double>(mine_.*amount + theirs_.*amount);
    };
    const auto busier = [&](std::int64_t Offer::*amount) {
      return static_cast<double>(std::max(mine_.*amount, theirs_.*amount));
    };
    const auto given = [&](std::int64_t Offer::*amount) {
      return giver != nullptr ? static_cast<double>(giver->*amount) : busier(amount);
    };
    const auto draw = [&](double triangles, double pixels, double of_picture) {
      return triangles * (rates.triangle + of_picture * rates.drawn) + of_picture * pixels * rates.shaded;
    };
    // Of the whole picture, as triangles and what they cover are taken to be everywhere alike.
    const double held = held_pixels / all_pixels;
    const double kept = giver != nullptr ? held : held / 2;
    const double apart = draw(busier(&Offer::triangles), busier(&Offer::pixels), held) +
                         kept * given(&Offer::pixels) * rates.merged +
                         (held - kept) * all_pixels * rates.background;
    const double together = given(&Offer::bytes) * rates.geometry_byte +
                            draw(both(&Offer::triangles), both(&Offer::pixels), kept);
    return together <= apart;
  }

 private:
  const Offer& mine_;
  const Offer& theirs_;
};

}  // namespace

Group form_groups(comm::Communicator& world, const Halving& halving, std::span<const LitSurface> surfaces,
                  const Camera& camera, int width, int height, const GroupOptions& options) {
  Group group;
  group.surfaces.assign(surfaces.begin(), surfaces.end());
  Offer mine{size_of(surfaces), 0, 0, options.memory, 0};
  for (const LitSurface& surface : surfaces) mine.triangles += std::ssize(surface.triangles);
  if (options.rates) mine.pixels = covered_pixels(surfaces, camera, width, height);
  const double all_pixels = static_cast<double>(width) * height;
  const bool gives = halving.gives(world.rank());
  for (int step = 0; step < halving.steps(); ++step) {
    const int partner = halving.partner(world.rank(), step);
    if (partner < 0) {
      // Nobody to merge with, and so nothing that is missing.
      if (mine.refused == 0 && !gives) group.steps = step + 1;
      continue;
    }
    // 1. How much is there?
    const Offer theirs = swap_offers(world, partner, mine);
    // 2. Is it worth while, and is there room on both sides? Where neither refused, both hold as many rows.
    const Rows rows = halving.rows(world.rank(), group.steps, {0, height});
    const double held = static_cast<double>(width) * rows.count();
    const Offer& giver = gives ? mine : theirs;
    const Decision decision(mine, theirs);
    const bool share =
        decision.possible() &&
        (options.rates ? decision.by_time(held, all_pixels, step == 0 ? &giver : nullptr, *options.rates)
                       : decision.by_ratio(held, options.threshold));
    // 3. Then each gets the other's; the ranks beyond the core are done with that.
    if (!share) {
      mine.refused = 1;
      continue;
    }
    group.steps = step + 1;
    comm::Bytes received;
    if (gives) {
      give_to(world, partner, bytes_of(group.surfaces));
      group.surfaces.clear();
      return group;
    }
    if (step == 0) {
      received = take_from(world, partner);
    } else {
      received = swap_with(world, partner, bytes_of(group.surfaces));
    }
    for (OwnedSurface& surface : surfaces_from(received)) {
      // Arrays stay where they are when the list grows.
      group.received.push_back(std::move(surface));
      group.surfaces.push_back(group.received.back().view());
    }
    mine.bytes += theirs.bytes;
    mine.triangles += theirs.triangles;
    mine.pixels = std::min(mine.pixels + theirs.pixels, std::int64_t{width} * height);
  }
  return group;
}

}  // namespace footwall::render
