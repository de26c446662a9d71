// The bricks of one rank that may still show something.
#pragma once
#include <span>
#include <vector>

#include "engine/isosurface/visible/detail/expected_triangles.h"
#include "engine/isosurface/visible/screen_boxes.h"
#include "engine/isosurface/visible/visible_drawing.h"

namespace footwall::isosurface::detail {

struct PendingBrick {
  survey::Index at{0, 0, 0};
  std::size_t word = 0;    // its place in tables of all bricks
  std::size_t part = 0;    // of the rank's parts of the volume
  BrickParts active = 0;   // may hold triangles
  BrickParts boxed = 0;    // and are not outside of the picture: those have boxes
  BrickParts pending = 0;  // and are neither drawn nor hidden
  BrickParts chosen = 0;   // for the wave under way
  BrickParts drawn = 0;    // in this or an earlier wave, by whatever rank
  std::int64_t work = 0;   // of what was chosen
  std::size_t first_box = 0;
  LooseBox loose;
  render::ScreenBox box;
};

class PendingBricks {
 public:
  // The bricks of these parts of the volume that the isovalue crosses.
  void collect(std::span<const VolumePart> parts, const VisibleRequest& request);
  // Of the same as before: nothing has to be read again.
  void restart();
  // Where on the screen they lie.
  void place(const ScreenBoxes& boxes, const VisibleRequest& request);
  // Gives each part its box.
  void place_parts(const ScreenBoxes& boxes, const render::DepthScale& scale, const VisibleRequest& request);

  // No longer pending is what lies behind `depths` with its whole box.
  void give_up_hidden(const render::DepthPyramid& depths, int threads);
  // Takes every pending part for a wall behind its cells.
  void cover(render::DepthPyramid& depths) const;
  // Chooses what is not hidden; null: all that is pending.
  void choose(const render::DepthPyramid* depths, int threads);
  // Chooses what is pending of `seen`, by place in the table.
  void choose(std::span<const BrickParts> seen);
  // Sets the work of what was chosen: about how many triangles will be kept of it. parts: as they were
  // collected of; expected: null in the first wave, of which all is kept.
  void weigh_chosen(std::span<const VolumePart> parts, const ExpectedTriangles* expected, int threads);
  // What was chosen is done with.
  void finish_chosen();
  // After the last wave: all that was drawn is pending again, and nothing else.
  void take_up_drawn();
  void mark_open(const render::DepthPyramid& depths, std::span<std::uint64_t> bits) const;

  std::int64_t pending_parts() const;
  std::int64_t chosen_parts() const;
  std::int64_t chosen_bricks() const;
  std::span<PendingBrick> bricks() { return bricks_; }
  std::span<const PendingBrick> bricks() const { return bricks_; }

 private:
  std::vector<PendingBrick> bricks_;
  std::vector<render::ScreenBox> boxes_;
};

}  // namespace footwall::isosurface::detail
