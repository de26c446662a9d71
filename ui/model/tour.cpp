#include "ui/model/tour.h"

#include <algorithm>
#include <cmath>

namespace footwall::ui {
namespace {

// Faces that a ranking may hold, in their order.
std::vector<TourStop> rankable(const FaultSurface& surface, const FaceNumbers& numbers) {
  std::vector<TourStop> stops;
  const std::size_t count = std::min(surface.faces.size(), numbers.values.size());
  const auto is_set = [](const std::vector<std::uint8_t>& flags, std::size_t n) {
    return n < flags.size() && flags[n] != 0;
  };
  for (std::size_t n = 0; n < count; ++n) {
    if (!std::isfinite(numbers.values[n]) || is_set(numbers.stale, n) || is_set(numbers.hatched, n)) continue;
    const project::MeshFace& face = surface.faces[n];
    survey::IndexPoint middle;
    for (const std::int32_t vertex : face.vertices) {
      const survey::IndexPoint& corner = surface.places[static_cast<std::size_t>(vertex)];
      middle.i += corner.i / 3;
      middle.j += corner.j / 3;
      middle.k += corner.k / 3;
    }
    double reach = 0;
    for (const std::int32_t vertex : face.vertices) {
      const survey::IndexPoint& corner = surface.places[static_cast<std::size_t>(vertex)];
      reach = std::max(reach, std::hypot(corner.i - middle.i, corner.j - middle.j, corner.k - middle.k));
    }
    stops.push_back({{.kind = Item::Kind::kFace, .id = surface.fault, .panel = face.panel, .number = face.n},
                     middle,
                     reach,
                     numbers.values[n]});
  }
  return stops;
}

}  // namespace

std::vector<TourStop> worst_faces(const FaultSurface& surface, const FaceNumbers& contrast) {
  std::vector<TourStop> stops = rankable(surface, contrast);
  std::ranges::stable_sort(stops, {}, &TourStop::value);
  return stops;
}

std::vector<TourStop> farthest_faces(const FaultSurface& surface, const FaceNumbers& offset) {
  std::vector<TourStop> stops = rankable(surface, offset);
  std::erase_if(stops, [](const TourStop& stop) { return stop.value == 0; });
  std::ranges::stable_sort(stops, std::ranges::greater(),
                           [](const TourStop& stop) { return std::abs(stop.value); });
  return stops;
}

const TourStop* next_stop(const std::vector<TourStop>& stops, const Item& now, int by) {
  if (stops.empty()) return nullptr;
  const auto count = static_cast<std::ptrdiff_t>(stops.size());
  const auto found = std::ranges::find(stops, now, &TourStop::face);
  const std::ptrdiff_t place = found == stops.end() ? (by > 0 ? 0 : count - 1) : found - stops.begin() + by;
  return &stops[static_cast<std::size_t>((place + count) % count)];
}

}  // namespace footwall::ui
