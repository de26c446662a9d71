// Which interleaving to take: what each would cost is estimated from the min/max pyramid before anything is
// read. Plain arithmetic without MPI, the same on every rank.
#pragma once
#include "engine/isosurface/extract.h"
#include "engine/isosurface/parallel/pillars.h"

namespace footwall::isosurface {

// In units of one cell that is looked at and holds nothing.
struct WorkForecast {
  double slowest = 0;    // of the ranks
  double mean = 0;       // of the ranks
  double redundant = 0;  // of it, what is done more than once or for samples stored twice, all ranks together
};

// bricks: of the whole volume.
WorkForecast forecast(const Pillars& pillars, const Bricks& bricks, float isovalue, bool normals);

// The interleaving of 1 .. 8 x 1 .. 8 x (1, 2 or 4 layers) whose slowest rank is forecast to have the least
// work; of about equal ones (within 2 %) the one with the fewest pillars. One rank needs none: 1x1x1.
Interleaving choose_interleaving(const survey::Index& volume, int ranks, const Bricks& bricks, float isovalue,
                                 bool normals);

}  // namespace footwall::isosurface
