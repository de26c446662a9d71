#include "engine/render/axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace footwall::render {
namespace {

constexpr Rgba kFrontEdge = hex(0x7b8492);
constexpr Rgba kBackEdge = hex(0x464d59);
constexpr Rgba kGrid = hex(0x323842);
constexpr Rgba kNumbers = hex(0xb9c0ca);
constexpr int kMostNumbers = 1000;  // steps too small to change a number must not go on for ever
constexpr Rgba kTitles = hex(0xd6dae0);

// No 0.30000000000000004.
std::string words(double number) {
  return fmt::format("{:.10g}", number);
}

struct Pixels {
  double x = 0;
  double y = 0;
  double away = 0;  // greater = farther from the eye
};

class Axes {
 public:
  Axes(Scene& scene, const SceneFrame& frame, const Camera& camera, int width, int height)
      : scene_(scene),
        frame_(frame),
        camera_(camera),
        width_(width),
        height_(height),
        corners_(frame.corners()) {
    for (std::size_t n = 0; n < 8; ++n) seen_[n] = pixels_of(corners_[n]);
    middle_ = (corners_[0] + corners_[7]) * 0.5;
    size_ = length(corners_[7] - corners_[0]);
  }

  void add_box() {
    const auto farthest = static_cast<unsigned>(
        std::max_element(seen_.begin(), seen_.end(),
                         [](const Pixels& a, const Pixels& b) { return a.away < b.away; }) -
        seen_.begin());
    for (unsigned axis = 0; axis < 3; ++axis) {
      for (const unsigned corner : edges_along(axis)) {
        const unsigned other = corner | 1U << axis;
        const bool behind = corner == farthest || other == farthest;
        line(corners_[corner], corners_[other], behind ? 1.1 : 1.3, behind ? kBackEdge : kFrontEdge);
      }
    }
  }

  void add_axis(unsigned axis, const std::string& title, double first, double last, double least_step) {
    const unsigned corner = axis == 2 ? leftmost_edge() : nearest_edge(axis);
    const unsigned other = corner | 1U << axis;
    const Pixels& a = seen_[corner];
    const Pixels& b = seen_[other];
    const double long_on_screen = std::hypot(b.x - a.x, b.y - a.y);
    const double s = scene_.text_scale;
    if (long_on_screen < 50 * s) return;  // seen end-on: its numbers would be a heap
    // Across the edge in the picture, away from the box.
    double out_x = -(b.y - a.y) / long_on_screen;
    double out_y = (b.x - a.x) / long_on_screen;
    const Pixels centre = pixels_of(middle_);
    if (out_x * ((a.x + b.x) / 2 - centre.x) + out_y * ((a.y + b.y) / 2 - centre.y) < 0) {
      out_x = -out_x;
      out_y = -out_y;
    }
    const Align align = std::abs(out_x) < 0.35 ? Align::kCentre : out_x > 0 ? Align::kLeft : Align::kRight;
    const auto text = [&](const std::string& what, const Vec3& at, double out, double size, Rgba colour,
                          bool bold) {
      scene_.labels.push_back({what, {at}, out_x * out * s, out_y * out * s, align, size * s, colour, bold});
    };
    const double spacing = std::abs(b.x - a.x) > std::abs(b.y - a.y) ? 85 : 60;
    const auto count = static_cast<int>(std::clamp(long_on_screen / (spacing * s), 2.0, 12.0));
    const std::vector<double> numbers = round_numbers(first, last, count, least_step);
    double widest = 1;
    for (const double number : numbers) widest = std::max(widest, static_cast<double>(words(number).size()));
    // The box reaches half a step beyond the first and last line.
    const double half = least_step / 2;
    if (axis == 2) {
      // Over the edge's upper end: beside its middle a title would push the box far to the right.
      const Vec3& top =
          camera_.forward.z <= 0 || seen_[corner].y < seen_[other].y ? corners_[corner] : corners_[other];
      scene_.labels.push_back({title, {top}, 14 * s * out_x, -24 * s, align, 17 * s, kTitles, true});
    } else {
      text(title, (corners_[corner] + corners_[other]) * 0.5,
           34 + std::abs(out_x) * widest * 10.5 + std::abs(out_y) * 14, 17, kTitles, true);
    }
    Vec3 outwards = (corners_[corner] + corners_[other]) * 0.5 - middle_;
    outwards.z = 0;
    outwards = outwards * (0.014 * size_ / std::max(length(outwards), 1e-9));
    for (const double number : numbers) {
      const double share = (number - first + half) / (last - first + 2 * half);
      const Vec3 at = corners_[corner] + (corners_[other] - corners_[corner]) * share;
      line(at, at + outwards, 1.3, kFrontEdge);
      text(words(number), at, 22, 15, kNumbers, false);
      if (axis < 2) {
        // Across the floor to the opposite edge.
        const Vec3 across = corners_[corner ^ (1U << (1 - axis))] - corners_[corner];
        line(at, at + across, 1, kGrid);
      }
    }
  }

 private:
  Pixels pixels_of(const Vec3& p) const {
    const Vec4 clip = camera_.clip_of(p);
    const double w = clip.w > 0 ? clip.w : 1e-9;
    return {(clip.x / w * 0.5 + 0.5) * width_, (0.5 - clip.y / w * 0.5) * height_,
            dot(p - camera_.eye, camera_.forward)};
  }
  // Of the two edges on the floor (from below: the roof), the one in front.
  unsigned nearest_edge(unsigned axis) const {
    const bool from_above = camera_.forward.z <= 0;
    unsigned best = 8;
    for (const unsigned corner : edges_along(axis)) {
      if (((corner & 4U) != 0) != from_above) continue;
      const auto away = [&](unsigned c) { return seen_[c].away + seen_[c | 1U << axis].away; };
      if (best == 8 || away(corner) < away(best)) best = corner;
    }
    return best;
  }
  unsigned leftmost_edge() const {
    const std::array<unsigned, 4> edges = edges_along(2);
    return *std::min_element(edges.begin(), edges.end(), [&](unsigned a, unsigned b) {
      return seen_[a].x + seen_[a | 4U].x < seen_[b].x + seen_[b | 4U].x;
    });
  }
  void line(const Vec3& a, const Vec3& b, double width, Rgba colour) {
    scene_.lines.push_back({{a, b}, width * scene_.text_scale, colour, colour == kGrid ? 0.0 : 0.001, false});
  }

  Scene& scene_;
  const SceneFrame& frame_;
  const Camera& camera_;
  int width_;
  int height_;
  std::array<Vec3, 8> corners_;
  std::array<Pixels, 8> seen_;
  Vec3 middle_;
  double size_ = 0;
};

}  // namespace

std::array<unsigned, 4> edges_along(unsigned axis) {
  std::array<unsigned, 4> corners{};
  std::size_t n = 0;
  for (unsigned corner = 0; corner < 8; ++corner) {
    if ((corner >> axis & 1U) == 0) corners[n++] = corner;
  }
  return corners;
}

std::vector<double> round_numbers(double lo, double hi, int count, double least_step) {
  if (!(hi > lo) || !std::isfinite(lo) || !std::isfinite(hi)) return {lo};
  const double wanted = std::max((hi - lo) / std::max(count, 1), least_step);
  const double power = std::pow(10, std::floor(std::log10(wanted)));
  double step = 10 * power;
  for (const double factor : {5.0, 2.0, 1.0}) {
    if (factor * power >= wanted * (1 - 1e-9)) step = factor * power;
  }
  std::vector<double> numbers;
  const double first = std::ceil(lo / step - 1e-9);
  for (int n = 0; n < kMostNumbers && (first + n) * step <= hi + 1e-9 * step; ++n)
    numbers.push_back((first + n) * step + 0.0);
  return numbers;
}

void add_axes(Scene& scene, const SceneFrame& frame, const Camera& camera, int width, int height) {
  const survey::Geometry& g = frame.geometry();
  Axes axes(scene, frame, camera, width, height);
  axes.add_box();
  axes.add_axis(
      2,
      fmt::format("{} ({})", g.domain == survey::Domain::kTime ? "time" : "depth", name_of(g.vertical_unit)),
      g.z0, g.z0 + g.interval * static_cast<double>(g.samples - 1), g.interval);
  axes.add_axis(0, "inline", g.inlines.first, static_cast<double>(g.inlines.last()), g.inlines.step);
  axes.add_axis(1, "crossline", g.crosslines.first, static_cast<double>(g.crosslines.last()),
                g.crosslines.step);
}

}  // namespace footwall::render
