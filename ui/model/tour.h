// The ways through a fault's faces: from the one of lowest contrast, or of largest offset, to the best. Never
// by raw variance, which says nothing about fit.
#pragma once
#include <vector>

#include "ui/model/selection.h"
#include "ui/model/surfaces.h"

namespace footwall::ui {

struct TourStop {
  Item face;
  survey::IndexPoint place;  // its centroid
  double reach = 0;          // voxels from there to its farthest corner
  double value = 0;          // of the statistic that the tour goes by
};

// By ascending contrast, the lower face first where two are alike. Faces of few samples, without a value, or
// moved since are left out.
std::vector<TourStop> worst_faces(const FaultSurface& surface, const FaceNumbers& contrast);
// By descending |offset|; left out are the same, and faces that sit on the spot.
std::vector<TourStop> farthest_faces(const FaultSurface& surface, const FaceNumbers& offset);
// The stop `by` places (1 or -1) from the face; from anything else the first, or the last where by is -1;
// behind the last comes the first. Null where there are none.
const TourStop* next_stop(const std::vector<TourStop>& stops, const Item& now, int by = 1);

}  // namespace footwall::ui
