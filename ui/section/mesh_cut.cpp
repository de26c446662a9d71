#include "ui/section/mesh_cut.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace footwall::ui {
namespace {

class Cutting {
 public:
  Cutting(const Section& section, std::span<const survey::IndexPoint> places)
      : section_(section), places_(places) {
    distances_.reserve(places.size());
    for (const survey::IndexPoint& p : places) distances_.push_back(distance_from(section, p));
  }

  void add(const std::array<std::int32_t, 3>& corners, std::size_t face) {
    const auto count = static_cast<std::int32_t>(places_.size());
    if (std::ranges::any_of(corners, [count](std::int32_t c) { return c < 0 || c >= count; })) return;
    std::array<double, 3> d{};
    for (int n = 0; n < 3; ++n) d[n] = distances_[static_cast<std::size_t>(corners[n])];
    if (std::ranges::all_of(d, [](double x) { return x > 0; }) ||
        std::ranges::all_of(d, [](double x) { return x < 0; })) {
      return;
    }
    std::array<PlanePoint, 3> ends;
    int found = 0;
    for (int n = 0; n < 3; ++n) {
      const int next = (n + 1) % 3;
      if (d[n] == 0 && d[next] == 0) add_edge(corners[n], corners[next], face);
      if (d[n] == 0) ends[found++] = plane_of(section_, places_[static_cast<std::size_t>(corners[n])]);
      if ((d[n] < 0) != (d[next] < 0) && d[n] != 0 && d[next] != 0)
        ends[found++] = crossing(corners[n], corners[next]);
    }
    const auto zeros = std::ranges::count(d, 0.0);
    if (found == 2 && zeros < 2) segments_.push_back({{ends[0], ends[1]}, face});
  }

  std::vector<CutSegment> take() { return std::move(segments_); }

 private:
  // Both faces of an edge find the same point.
  PlanePoint crossing(std::int32_t a, std::int32_t b) const {
    if (a > b) std::swap(a, b);
    const double from = distances_[static_cast<std::size_t>(a)];
    const double part = from / (from - distances_[static_cast<std::size_t>(b)]);
    const PlanePoint p = plane_of(section_, places_[static_cast<std::size_t>(a)]);
    const PlanePoint q = plane_of(section_, places_[static_cast<std::size_t>(b)]);
    return {p.u + part * (q.u - p.u), p.v + part * (q.v - p.v)};
  }

  void add_edge(std::int32_t a, std::int32_t b, std::size_t face) {
    if (!edges_.insert(std::minmax(a, b)).second) return;
    segments_.push_back({{plane_of(section_, places_[static_cast<std::size_t>(a)]),
                          plane_of(section_, places_[static_cast<std::size_t>(b)])},
                         face});
  }

  const Section& section_;
  std::span<const survey::IndexPoint> places_;
  std::vector<double> distances_;
  std::set<std::pair<std::int32_t, std::int32_t>> edges_;
  std::vector<CutSegment> segments_;
};

}  // namespace

std::vector<CutSegment> mesh_cut(const Section& section, std::span<const survey::IndexPoint> places,
                                 std::span<const project::MeshFace> faces) {
  Cutting cutting(section, places);
  for (std::size_t n = 0; n < faces.size(); ++n) cutting.add(faces[n].vertices, n);
  return cutting.take();
}

std::vector<CutLine> joined(std::span<const CutSegment> segments) {
  // Neighbours have the same end to the last bit.
  std::map<std::pair<double, double>, std::vector<std::size_t>> at;
  for (std::size_t n = 0; n < segments.size(); ++n) {
    for (const PlanePoint& end : segments[n]) at[{end.u, end.v}].push_back(n);
  }
  std::vector<bool> used(segments.size());
  std::vector<CutLine> lines;
  const auto follow = [&](std::size_t first, std::size_t from) {
    CutLine line{segments[first][from]};
    for (std::size_t now = first, start = from;;) {
      used[now] = true;
      const PlanePoint end = segments[now][1 - start];
      line.push_back(end);
      const auto& meeting = at[{end.u, end.v}];
      const auto next = std::ranges::find_if(meeting, [&](std::size_t n) { return !used[n]; });
      if (meeting.size() != 2 || next == meeting.end()) break;
      now = *next;
      start = segments[now][0] == end ? 0 : 1;
    }
    lines.push_back(std::move(line));
  };
  for (const bool rings : {false, true}) {  // rings have no end to begin at
    for (std::size_t n = 0; n < segments.size(); ++n) {
      for (std::size_t end = 0; end < 2 && !used[n]; ++end) {
        if (rings || at[{segments[n][end].u, segments[n][end].v}].size() != 2) follow(n, end);
      }
    }
  }
  return lines;
}

}  // namespace footwall::ui
