// A rank's pieces of an isosurface as the renderer takes them.
#pragma once
#include <deque>
#include <span>
#include <vector>

#include "engine/isosurface/parallel/piece.h"
#include "engine/render/lit_surface.h"

namespace footwall::session {

class DrawnPieces {
 public:
  // Triangles get the numbers that they have in the whole isosurface, plus first_id. Pieces without
  // triangles are left out. The pieces must stay. Throws Error kUnsupported for a piece of 2^31 vertices or
  // more, or a number that does not fit.
  void add(std::span<const isosurface::Piece> pieces, std::uint64_t first_id, render::Rgba colour,
           const render::Placement& placement);
  std::span<const render::LitSurface> surfaces() const { return surfaces_; }
  void clear();

 private:
  std::vector<render::LitSurface> surfaces_;
  std::deque<std::vector<render::IdRun>> runs_;  // stay where they are when more are added
};

}  // namespace footwall::session
