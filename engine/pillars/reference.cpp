#include "engine/pillars/reference.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace footwall::pillars {
namespace {

struct Vector2 {
  double x = 0, y = 0;
};
Vector2 operator+(Vector2 a, Vector2 b) {
  return {a.x + b.x, a.y + b.y};
}
Vector2 operator-(Vector2 a, Vector2 b) {
  return {a.x - b.x, a.y - b.y};
}
double cross(Vector2 a, Vector2 b) {
  return a.x * b.y - a.y * b.x;
}
double dot(Vector2 a, Vector2 b) {
  return a.x * b.x + a.y * b.y;
}
Vector2 flat(const ChartPoint& p) {
  return {p.strike, p.dip};
}

// The bilinear piece between two rulings a0-b0 and a1-b1; counter-clockwise a0, b0, b1, a1.
struct Piece {
  ChartPoint a0, b0, b1, a1;

  std::array<double, 4> corners() const {
    const std::array<Vector2, 4> p{flat(a0), flat(b0), flat(b1), flat(a1)};
    std::array<double, 4> turn;
    for (std::size_t k = 0; k < 4; ++k)
      turn[k] = cross(p[(k + 1) % 4] - p[k], p[(k + 2) % 4] - p[(k + 1) % 4]);
    return turn;
  }
  // How far inside, negative outside: the smallest of the four edges' signed areas.
  double inside(Vector2 q) const {
    const std::array<Vector2, 4> p{flat(a0), flat(b0), flat(b1), flat(a1)};
    double least = cross(p[1] - p[0], q - p[0]);
    for (std::size_t k = 1; k < 4; ++k) least = std::min(least, cross(p[(k + 1) % 4] - p[k], q - p[k]));
    return least;
  }
  double height(Vector2 q) const {
    // The ruling through q: cross(q - a(u), b(u) - a(u)) = 0, a quadratic in u.
    const Vector2 da = flat(a1) - flat(a0), d0 = flat(b0) - flat(a0);
    const Vector2 dd = (flat(b1) - flat(a1)) - d0, e = q - flat(a0);
    const double c = cross(e, d0), b = cross(e, dd) - cross(da, d0), a = -cross(da, dd);
    const double u = root(a, b, c);
    const Vector2 from{flat(a0).x + u * da.x, flat(a0).y + u * da.y};
    const Vector2 ruling{d0.x + u * dd.x, d0.y + u * dd.y};
    const double length2 = dot(ruling, ruling);
    const double t = length2 > 0 ? std::clamp(dot(q - from, ruling) / length2, 0.0, 1.0) : 0;
    const double ha = a0.height + u * (a1.height - a0.height), hb = b0.height + u * (b1.height - b0.height);
    return ha + t * (hb - ha);
  }

  // The root of a u^2 + b u + c nearest to [0, 1], clamped into it.
  static double root(double a, double b, double c) {
    const double square = std::max(0.0, b * b - 4 * a * c);
    const double q = -0.5 * (b + (b >= 0 ? std::sqrt(square) : -std::sqrt(square)));
    const double first = a != 0 ? q / a : 0.5, second = q != 0 ? c / q : 0.5;
    auto outside = [](double u) { return std::max({0.0, -u, u - 1}); };
    const bool has_first = a != 0, has_second = q != 0;
    if (has_first && (!has_second || outside(first) < outside(second))) return std::clamp(first, 0.0, 1.0);
    return std::clamp(second, 0.0, 1.0);
  }
};

// Finds the pieces near a place: they are listed in bins along the strip.
class PieceBins {
 public:
  explicit PieceBins(const std::vector<Piece>& pieces) {
    const Piece &first = pieces.front(), &last = pieces.back();
    along_ = (flat(last.a1) - flat(first.a0)) + (flat(last.b1) - flat(first.b0));
    std::vector<std::pair<double, double>> spans;
    for (const Piece& p : pieces) {
      const auto [low, high] = std::minmax({at(flat(p.a0)), at(flat(p.b0)), at(flat(p.b1)), at(flat(p.a1))});
      spans.emplace_back(low, high);
      low_ = std::min(low_, low), high_ = std::max(high_, high);
    }
    // Slanting pieces lie in many narrow bins: so wide that a piece lies in few.
    for (count_ = pieces.size(); count_ > 1; count_ /= 2) {
      std::size_t listed = 0;
      for (const auto& [low, high] : spans) listed += bin(high) - bin(low) + 1;
      if (listed <= kListedPerPiece * pieces.size()) break;
    }
    bins_.resize(count_);
    for (std::size_t n = 0; n < spans.size(); ++n)
      for (std::size_t k = bin(spans[n].first); k <= bin(spans[n].second); ++k)
        bins_[k].push_back(static_cast<std::int32_t>(n));
  }

  // Calls each(piece) for those whose bins hold the place, or lie beside its bin.
  template <class Each>
  void near(Vector2 q, const Each& each) const {
    const std::size_t here = bin(at(q));
    for (std::size_t k = here - (here > 0); k <= std::min(here + 1, count_ - 1); ++k)
      for (const std::int32_t piece : bins_[k]) each(static_cast<std::size_t>(piece));
  }

 private:
  static constexpr std::size_t kListedPerPiece = 8;

  double at(Vector2 q) const { return dot(q, along_); }
  std::size_t bin(double at) const {
    const double part = high_ > low_ ? (at - low_) / (high_ - low_) : 0;
    return std::min(count_ - 1, static_cast<std::size_t>(std::clamp(part, 0.0, 1.0) * double(count_)));
  }

  Vector2 along_;
  double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
  std::size_t count_ = 1;
  std::vector<std::vector<std::int32_t>> bins_;
};

class RuledSurface : public Reference {
 public:
  explicit RuledSurface(std::vector<Piece> pieces) : pieces_(std::move(pieces)), bins_(pieces_) {}

  double height(double strike, double dip) override {
    // Neighbouring questions mostly fall into the same piece.
    const Vector2 q{strike, dip};
    double best = pieces_[last_].inside(q);
    if (best < 0) {
      best = -std::numeric_limits<double>::infinity();
      bins_.near(q, [&](std::size_t piece) {
        const double in = pieces_[piece].inside(q);
        if (in > best) best = in, last_ = piece;
      });
    }
    return pieces_[last_].height(q);
  }

 private:
  std::vector<Piece> pieces_;
  PieceBins bins_;
  std::size_t last_ = 0;
};

// Whether p lies on the straight line between a and b in space, but for rounding.
bool on_the_way(const ChartPoint& p, const ChartPoint& a, const ChartPoint& b) {
  const double there = space_distance(a, p), whole = there + space_distance(p, b);
  return whole > 0 && space_distance(p, between(a, b, there / whole)) <= 1e-9 * whole;
}

class MeanValueSurface : public Reference {
 public:
  explicit MeanValueSurface(std::vector<std::array<ChartPoint, 2>> rim) : rim_(std::move(rim)) {}

  double height(double strike, double dip) override {
    double sum = 0, weight = 0;
    for (const auto& [p, q] : rim_) {
      const Vector2 a{p.strike - strike, p.dip - dip}, b{q.strike - strike, q.dip - dip};
      const double ra = std::sqrt(dot(a, a)), rb = std::sqrt(dot(b, b));
      if (ra < 1e-9) return p.height;
      if (rb < 1e-9) return q.height;
      const double facing = ra * rb + dot(a, b);
      if (facing <= 1e-12 * ra * rb) return (rb * p.height + ra * q.height) / (ra + rb);  // on the edge
      const double half = cross(a, b) / facing;
      sum += half * (p.height / ra + q.height / rb);
      weight += half * (1 / ra + 1 / rb);
    }
    return sum / weight;
  }

 private:
  std::vector<std::array<ChartPoint, 2>> rim_;
};

}  // namespace

std::unique_ptr<Reference> ruled_surface(const Course& a, const Course& b) {
  std::vector<double> s(a.s);
  s.insert(s.end(), b.s.begin(), b.s.end());
  s.push_back(1);  // a single node has 0 alone
  std::sort(s.begin(), s.end());
  std::vector<double> rulings;
  for (double each : s)
    if (rulings.empty() || each - rulings.back() > 1e-12) rulings.push_back(each);
  if (rulings.size() < 2) return nullptr;
  std::vector<Piece> pieces;
  for (std::size_t n = 0; n + 1 < rulings.size(); ++n) {
    const Piece piece{a.at(rulings[n]), b.at(rulings[n]), b.at(rulings[n + 1]), a.at(rulings[n + 1])};
    for (double turn : piece.corners())
      if (!(turn >= -1e-12)) return nullptr;
    pieces.push_back(piece);
  }
  return std::make_unique<RuledSurface>(std::move(pieces));
}

std::unique_ptr<Reference> mean_value_surface(std::span<const ChartPoint> loop) {
  std::vector<ChartPoint> corners;
  for (std::size_t n = 0; n < loop.size(); ++n) {
    const ChartPoint& before = corners.empty() ? loop.back() : corners.back();
    if (!on_the_way(loop[n], before, loop[(n + 1) % loop.size()])) corners.push_back(loop[n]);
  }
  if (corners.size() < 3) corners.assign(loop.begin(), loop.end());
  std::vector<std::array<ChartPoint, 2>> rim;
  for (std::size_t n = 0; n < corners.size(); ++n)
    rim.push_back({corners[n], corners[(n + 1) % corners.size()]});
  return std::make_unique<MeanValueSurface>(std::move(rim));
}

}  // namespace footwall::pillars
