// The way through a fault's faces from the one that sits worst on the fault to the best.
#pragma once
#include <vector>

#include "ui/model/selection.h"
#include "ui/model/surfaces.h"

namespace footwall::ui {

struct TourStop {
  Item face;
  survey::IndexPoint place;  // its centroid
  double contrast = 0;
};

// By ascending contrast, the lower face first where two are alike. Faces of few samples, without a value, or
// moved since are left out.
std::vector<TourStop> worst_faces(const FaultSurface& surface, const FaceNumbers& contrast);
// The stop after the face; the first after anything else, and after the last. Null where there are none.
const TourStop* next_stop(const std::vector<TourStop>& stops, const Item& now);

}  // namespace footwall::ui
