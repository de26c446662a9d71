// What is asked of a picture of only what can be seen, and what is told about how it came about: the same for
// every mode.
// Based on: seed 003, section 4 (its tables 4 to 6 and figures 7 to 11 are made of these numbers).
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/isosurface/extract.h"
#include "engine/render/camera.h"
#include "engine/render/colour.h"
#include "engine/render/lit_surface.h"

namespace footwall::isosurface {

enum class VisibleMode : std::uint8_t {
  kDepth,  // occlusion by depth: the picture is that of the whole isosurface
  kPaper   // seed 003 as published: a coverage mask without depth, which can lose what is seen
};

struct VisibleRequest {
  float isovalue = 0;
  survey::Index volume_size{0, 0, 0};
  Bricks bricks;                // of the whole volume, on every rank
  render::Placement placement;  // from the volume's index space to the scene
  render::Camera camera;
  render::Rgba colour = 0;
  int width = 0;
  int height = 0;
  VisibleMode mode = VisibleMode::kDepth;
  int threads = 1;  // of each rank

  // Stops after the pass in which so much time is over, or after so many passes; the picture is whole as far
  // as it goes. None, 0: goes on to the end.
  std::optional<double> budget_seconds;
  int passes = 0;

  // Mode `paper`: the cells (blocks) of the octree's leaves, n x m x k cells of the lattice, and those in
  // which work is estimated. 0, 0, 0: chosen by the mode.
  survey::Index cell{0, 0, 0};
  survey::Index estimate_cell{0, 0, 0};
};

struct VisiblePass {
  std::int64_t cells = 0;      // bricks (mode `paper`: leaves) extracted in this pass, of all ranks
  std::int64_t triangles = 0;  // of all ranks
  // (max - mean) / mean of the triangles over the ranks that got cells; 0 where nobody did.
  double load_difference = 0;
  // After the pass: pixels that show nothing, and that something not yet extracted may cover.
  std::int64_t uncovered_pixels = 0;
  // Triangles so far, per cent of those after the last pass of this picture.
  double percent = 0;
  // The slowest rank's. Some overlap, so that their sum is not the pass's time.
  struct Seconds {
    double visibility = 0;  // which cells may be seen
    double partition = 0;   // how much work they are, and who is to do it
    double assign = 0;      // what has to be sent for that
    double extract = 0;     // triangles made and drawn
    double composite = 0;   // coverage or depth brought together
  } seconds;
};

struct VisibleReport {
  std::vector<VisiblePass> passes;
  bool finished = true;  // false: a budget ended it
  std::int64_t triangles = 0;

  // Sets percent of all passes, and `triangles`.
  void sum_up();
};

// (max - mean) / mean over the ranks with cells.
double load_difference(const std::vector<std::int64_t>& cells_of_ranks,
                       const std::vector<std::int64_t>& triangles_of_ranks);

}  // namespace footwall::isosurface
