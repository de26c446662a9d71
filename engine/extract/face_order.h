// The order in which a rank had best walk its faces: neighbours in space one after the other, so that the
// values they share are still in the cache.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/extract/face.h"

namespace footwall::extract {

// A permutation of the numbers of faces; its memory is used again.
class FaceOrder {
 public:
  // Cubic cells that hold about a face each, along a Morton curve; faces of one cell by number. Fewer than
  // kFewFaces stay as they are. Which order is taken changes no result, only the time. O(faces); throws
  // std::bad_alloc.
  void of(std::span<const Face> faces);
  static constexpr std::size_t kFewFaces = 256;

  std::size_t size() const { return order_.size(); }
  std::size_t operator[](std::size_t place) const { return order_[place]; }

 private:
  std::vector<std::uint32_t> cell_of_face_;
  std::vector<std::uint32_t> next_of_cell_;
  std::vector<std::uint32_t> order_;
};

}  // namespace footwall::extract
