#include "ui/model/tour.h"

#include <algorithm>
#include <cmath>

namespace footwall::ui {

std::vector<TourStop> worst_faces(const FaultSurface& surface, const FaceNumbers& contrast) {
  std::vector<TourStop> stops;
  const std::size_t count = std::min(surface.faces.size(), contrast.values.size());
  const auto is_set = [](const std::vector<std::uint8_t>& flags, std::size_t n) {
    return n < flags.size() && flags[n] != 0;
  };
  for (std::size_t n = 0; n < count; ++n) {
    if (!std::isfinite(contrast.values[n]) || is_set(contrast.stale, n) || is_set(contrast.hatched, n))
      continue;
    const project::MeshFace& face = surface.faces[n];
    survey::IndexPoint middle;
    for (const std::int32_t vertex : face.vertices) {
      const survey::IndexPoint& corner = surface.places[static_cast<std::size_t>(vertex)];
      middle.i += corner.i / 3;
      middle.j += corner.j / 3;
      middle.k += corner.k / 3;
    }
    stops.push_back({{.kind = Item::Kind::kFace, .id = surface.fault, .panel = face.panel, .number = face.n},
                     middle,
                     contrast.values[n]});
  }
  std::ranges::stable_sort(stops, {}, &TourStop::contrast);
  return stops;
}

const TourStop* next_stop(const std::vector<TourStop>& stops, const Item& now) {
  if (stops.empty()) return nullptr;
  const auto found = std::ranges::find(stops, now, &TourStop::face);
  return found == stops.end() || found + 1 == stops.end() ? &stops.front() : &*(found + 1);
}

}  // namespace footwall::ui
