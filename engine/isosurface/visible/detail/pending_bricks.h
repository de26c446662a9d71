// The bricks of one rank that may still show something. Most of them lie behind others as a whole: those stay
// *far*, and which parts of them are active is never looked for. Whether a brick is far depends on what else
// the rank has; what is chosen, and what is pending once nothing is far, does not.
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
  bool is_read = false;    // `active` is known
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

// What it takes to find a brick's parts and where they lie.
struct PartSearch {
  std::span<const VolumePart> parts;
  const VisibleRequest& request;
  ScreenBoxes boxes;
  render::ScreenBox rectangle;  // holds all bricks of all ranks
  render::DepthScale scale;
};

class PendingBricks {
 public:
  // The bricks of these parts of the volume that the isovalue crosses.
  void collect(std::span<const VolumePart> parts, const VisibleRequest& request);
  // Of the same as before: nothing has to be read again.
  void restart();
  // Where on the screen they lie.
  void place(const ScreenBoxes& boxes, const VisibleRequest& request);
  // All that can be met on the screen are far, about in order from the eye.
  void order(const PartSearch& search);

  // No longer pending is what lies behind `depths` with its whole box: parts, and bricks that are far.
  void give_up_hidden(const render::DepthPyramid& depths, int threads);
  // Brings bricks near, the nearest first, until more than `enough` parts are pending, or nothing is far.
  // What lies behind `depths` is given up.
  void find_some(const render::DepthPyramid& depths, const PartSearch& search, std::int64_t enough);
  // Takes every pending part for a wall behind its cells. Far stays what lies behind the walls of others; of
  // the rest, what lies behind `earlier`, the depths of earlier waves or null, is given up. `depths` is built
  // now and then on the way, but not at the end.
  void cover(render::DepthPyramid& depths, const render::DepthPyramid* earlier, const PartSearch& search);
  // Chooses what is not hidden of what is not far; null: all that is pending.
  void choose(const render::DepthPyramid* depths, int threads);
  // Chooses what is pending of `seen`, by place in the table.
  void choose(std::span<const BrickParts> seen, const PartSearch& search);
  // Sets the work of what was chosen: about how many triangles will be kept of it. parts: as they were
  // collected of; expected: null in the first wave, of which all is kept.
  void weigh_chosen(std::span<const VolumePart> parts, const ExpectedTriangles* expected, int threads);
  // What was chosen is done with.
  void finish_chosen();
  // After the last wave: all that was drawn is pending again, and nothing else.
  void take_up_drawn();
  // Closes what pending parts may cover of `open`, the open pixels of `depths`.
  void close(render::DepthPyramid& open, const render::DepthPyramid& depths, const PartSearch& search);

  std::int64_t far_bricks() const { return static_cast<std::int64_t>(far_.size()); }
  std::int64_t pending_parts() const;  // of those that are not far
  std::int64_t chosen_parts() const;
  std::int64_t chosen_bricks() const;
  std::span<PendingBrick> bricks() { return bricks_; }
  std::span<const PendingBrick> bricks() const { return bricks_; }

 private:
  void find_parts(std::span<PendingBrick* const> some, const PartSearch& search);
  template <class Hides, class Visit>
  void visit_far(std::size_t group, const PartSearch& search, Hides&& hides, Visit&& visit);
  void cover(std::span<PendingBrick* const> some, render::DepthPyramid& depths) const;
  void close(std::span<PendingBrick* const> some, render::DepthPyramid& open,
             const render::DepthPyramid& depths) const;
  void give_up_hidden(std::span<PendingBrick* const> some, const render::DepthPyramid& depths, int threads);

  std::vector<PendingBrick> bricks_;
  std::vector<render::ScreenBox> boxes_;  // those of parts, of bricks that are not far
  std::size_t used_boxes_ = 0;
  std::vector<std::size_t> nearer_;  // by depth: how many bricks are before it
  std::size_t groups_ = 1;           // in which walls are looked at
  std::vector<PendingBrick*> far_;   // from the nearest on, about
  std::vector<PendingBrick*> near_;  // all others that can be met on the screen
  std::vector<PendingBrick*> found_;
};

}  // namespace footwall::isosurface::detail
