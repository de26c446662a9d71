// What the balancers of seed 004 have in common: areas, loads, the mean, and the faces that may be moved.
#pragma once
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/extract/balance/area.h"
#include "engine/extract/balance/balance.h"

namespace footwall::extract {

inline auto id_of(const Face& face) {
  return std::tie(face.fault, face.owner, face.n);
}

// The places of the faces in the order of their ids (fault, owner, n).
std::vector<std::uint32_t> by_id(std::span<const Face> faces);

// The rank from which each face starts: its centroid's, or the one that it keeps.
std::vector<int> starting_ranks(const BalanceInput& input);
// Of some faces, from place `first` on.
void starting_ranks(const BalanceInput& input, std::size_t first, std::span<int> part);
inline bool movable(const BalanceInput& input, std::size_t face) {
  return input.previous.empty() || input.previous[face] < 0;
}

// The threshold d of "name=d,...", in units of FixedArea; 0 where there is none. Throws kUsage.
FixedArea threshold(const Choice& choice);

struct Start {
  std::vector<FixedArea> areas;      // of each face
  std::vector<int> responsible;      // of each face: starting_ranks()
  std::vector<std::uint32_t> by_id;  // see above
  std::vector<FixedArea> loads;      // of each rank
  FixedArea mean = 0;                // total / ranks, rounded down to the unit
  FixedArea threshold = 0;           // d
  bool overloaded(int rank) const { return loads[static_cast<std::size_t>(rank)] > mean + threshold; }
};
// Throws kInternal where `previous` is not of the faces.
Start start_of(const BalanceInput& input);

// The bounding box of the face's voxels, also outside the survey.
survey::Box voxel_box(const Face& face);
// Ranks with a voxel in the box, ascending; none where the box lies outside the survey.
std::vector<int> ranks_meeting(const comm::RankGrid& grid, const survey::Box& box);

// The faces that a rank may give away, largest first, ties by id.
class Stock {
 public:
  // Of all faces that start on an overloaded rank, may be moved and have an area: one stock for each rank,
  // empty for the others. O(F log F).
  static std::vector<Stock> of_overloaded(const BalanceInput& input, const Start& start);

  // Takes faces whose areas together are at most `room`: each time the largest that still fits. Calls
  // taken(face); returns the area taken. O((taken + 1) log F).
  template <class Taken>
  FixedArea take(FixedArea room, Taken taken) {
    FixedArea sum = 0;
    std::size_t n = 0;
    while (sum < room && (n = fitting(n, room - sum)) < faces_.size()) {
      sum += faces_[n].first;
      taken(faces_[n].second);
      next_[n] = static_cast<std::uint32_t>(n + 1);
    }
    return sum;
  }

 private:
  // The first face from place `from` on that is still there and not larger than `room`.
  std::size_t fitting(std::size_t from, FixedArea room);
  std::size_t present(std::size_t n);

  std::vector<std::pair<FixedArea, std::uint32_t>> faces_;
  std::vector<std::uint32_t> next_;  // n where the face is there, else a later place to look at
};

}  // namespace footwall::extract
