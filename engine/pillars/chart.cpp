#include "engine/pillars/chart.h"

#include <fmt/format.h>
#include <algorithm>
#include <bit>
#include <cmath>

#include "engine/pillars/course.h"
#include "storage/base/error.h"
#include "storage/base/hash.h"
#include "storage/base/text.h"

namespace footwall::pillars {
namespace {

using survey::IndexPoint;

double dot(const Vector3& a, const Vector3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector3 unit(const Vector3& a) {
  const double length = std::sqrt(dot(a, a));
  return {a[0] / length, a[1] / length, a[2] / length};
}

// Components that are nothing but rounding become zero, so that signs do not hang on them.
Vector3 cleaned(Vector3 a) {
  for (double& c : a)
    if (std::abs(c) < 1e-9) c = 0;
  return unit(a);
}

// Eigenvalues and vectors (columns of v) of a symmetric matrix by cyclic Jacobi rotations: a fixed number of
// sweeps, only + - * / sqrt.
void jacobi(std::array<Vector3, 3>& a, std::array<Vector3, 3>& v) {
  v = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (int sweep = 0; sweep < 12; ++sweep) {
    for (int p = 0; p < 2; ++p) {
      for (int q = p + 1; q < 3; ++q) {
        if (a[p][q] == 0) continue;
        const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const double t = (theta >= 0 ? 1 : -1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
        const double c = 1 / std::sqrt(t * t + 1), s = t * c;
        for (int k = 0; k < 3; ++k) {
          const double x = a[k][p], y = a[k][q];
          a[k][p] = c * x - s * y;
          a[k][q] = s * x + c * y;
        }
        for (int k = 0; k < 3; ++k) {
          const double x = a[p][k], y = a[q][k];
          a[p][k] = c * x - s * y;
          a[q][k] = s * x + c * y;
        }
        for (int k = 0; k < 3; ++k) {
          const double x = v[k][p], y = v[k][q];
          v[k][p] = c * x - s * y;
          v[k][q] = s * x + c * y;
        }
      }
    }
  }
}

// Where most pillars run: the chord that the others follow best, then the mean of those that follow it.
// Fourth powers tell two families at right angles apart even when they are equally strong.
std::array<double, 2> main_direction(const Chart& chart, std::span<const PillarInput> pillars) {
  struct Chord {
    double x, y, length;
    std::int64_t id;
  };
  std::vector<Chord> chords;
  for (const PillarInput& p : pillars) {
    if (p.nodes.empty()) continue;
    const ChartPoint a = chart.from_index(p.nodes.front()), b = chart.from_index(p.nodes.back());
    const double x = b.strike - a.strike, y = b.dip - a.dip, length = std::sqrt(x * x + y * y);
    if (length > kTouch) chords.push_back({x / length, y / length, length, p.id});
  }
  std::sort(chords.begin(), chords.end(), [](const Chord& a, const Chord& b) { return a.id < b.id; });
  std::array<double, 2> best{0, 1};
  double best_score = 0;
  const std::size_t stride = chords.size() / 500 + 1;
  for (std::size_t n = 0; n < chords.size(); n += stride) {
    double score = 0;
    for (const Chord& c : chords) {
      const double along = c.x * chords[n].x + c.y * chords[n].y;
      score += c.length * along * along * along * along;
    }
    if (score > best_score * (1 + 1e-12)) {
      best_score = score;
      best = {chords[n].x, chords[n].y};
    }
  }
  double x = 0, y = 0;
  for (const Chord& c : chords) {
    const double along = c.x * best[0] + c.y * best[1];
    if (along * along < 0.5) continue;
    x += along > 0 ? c.x * c.length : -c.x * c.length;
    y += along > 0 ? c.y * c.length : -c.y * c.length;
  }
  const double length = std::sqrt(x * x + y * y);
  if (length > 0) best = {x / length, y / length};
  const bool down = std::abs(best[1]) >= std::abs(best[0]);
  if ((down ? best[1] : best[0]) < 0) best = {-best[0], -best[1]};
  return best;
}

}  // namespace

ChartPoint Chart::from_index(const IndexPoint& p) const {
  const Vector3 d{p.i - origin[0], p.j - origin[1], p.k - origin[2]};
  return {dot(d, strike), dot(d, dip), dot(d, normal)};
}

IndexPoint Chart::to_index(const ChartPoint& p) const {
  auto component = [&](int c) {
    return origin[c] + (p.strike * strike[c] + p.dip * dip[c] + p.height * normal[c]);
  };
  return {component(0), component(1), component(2)};
}

std::string Chart::to_text() const {
  std::string text = "chart1";
  auto add = [&](double value) { text += ' ' + to_hex(std::bit_cast<std::uint64_t>(value)); };
  for (const Vector3& v : {origin, normal, strike, dip})
    for (double c : v) add(c);
  for (double c : along) add(c);
  return text;
}

Chart Chart::from_text(std::string_view text) {
  const auto words = text::words(text);
  if (words.size() != 15 || words[0] != "chart1")
    throw Error(ErrorCode::kFormat, "the fault's stored chart is not one", "triangulate with --rechart");
  std::array<double, 14> values;
  for (std::size_t n = 0; n < values.size(); ++n) {
    values[n] = std::bit_cast<double>(hash_from_hex(std::string(words[n + 1])));
    if (!std::isfinite(values[n]))
      throw Error(ErrorCode::kFormat, "the fault's stored chart is not finite", "triangulate with --rechart");
  }
  Chart chart;
  std::size_t n = 0;
  for (Vector3* v : {&chart.origin, &chart.normal, &chart.strike, &chart.dip})
    for (double& c : *v) c = values[n++];
  for (double& c : chart.along) c = values[n++];
  if (chart.empty()) return chart;
  // A frame that is not orthonormal would place points far off the fault.
  const Vector3 n_check = cross(chart.strike, chart.dip);
  const double along = chart.along[0] * chart.along[0] + chart.along[1] * chart.along[1];
  double off = std::abs(dot(chart.strike, chart.strike) - 1) + std::abs(dot(chart.dip, chart.dip) - 1) +
               std::abs(dot(chart.strike, chart.dip)) + std::abs(along - 1);
  for (int c = 0; c < 3; ++c) off += std::abs(n_check[c] - chart.normal[c]);
  if (!(off < 1e-6))
    throw Error(ErrorCode::kFormat, "the fault's stored chart is not a frame", "triangulate with --rechart");
  return chart;
}

namespace {

// In the order of ids, so that the order in which the pillars come leaves no trace in the rounding.
std::vector<const PillarInput*> by_id(std::span<const PillarInput> pillars) {
  std::vector<const PillarInput*> ordered;
  for (const PillarInput& p : pillars) ordered.push_back(&p);
  std::stable_sort(ordered.begin(), ordered.end(),
                   [](const PillarInput* a, const PillarInput* b) { return a->id < b->id; });
  return ordered;
}

struct Middle {
  Vector3 sum{0, 0, 0};
  double count = 0;
  void add(const IndexPoint& q) {
    sum = {sum[0] + q.i, sum[1] + q.j, sum[2] + q.k};
    ++count;
  }
  Vector3 place() const { return {sum[0] / count, sum[1] / count, sum[2] / count}; }
};

using Moments = std::array<Vector3, 3>;

void add_moment(Moments& moments, const Vector3& d) {
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) moments[r][c] += d[r] * d[c];
}

// The directions of a spread, by rising moment.
struct Axes {
  explicit Axes(Moments spread) : moments(spread) {
    jacobi(moments, vectors);
    std::stable_sort(by_size.begin(), by_size.end(),
                     [&](int a, int b) { return moments[a][a] < moments[b][b]; });
  }
  double middle() const { return moments[by_size[1]][by_size[1]]; }
  Moments moments;
  std::array<Vector3, 3> vectors{};  // in columns
  std::array<int, 3> by_size{0, 1, 2};
};

// The frame whose normal is the direction of least moment.
Chart frame_of(const Vector3& origin, const Axes& axes, std::span<const PillarInput> pillars) {
  const auto& vectors = axes.vectors;
  const auto& by_size = axes.by_size;
  Chart chart;
  chart.origin = origin;
  auto column = [&](int c) { return cleaned({vectors[0][c], vectors[1][c], vectors[2][c]}); };
  chart.normal = column(by_size[0]);
  const double first = chart.normal[0] != 0   ? chart.normal[0]
                       : chart.normal[1] != 0 ? chart.normal[1]
                                              : chart.normal[2];
  if (first < 0) chart.normal = {-chart.normal[0], -chart.normal[1], -chart.normal[2]};
  for (double& c : chart.normal) c += 0.0;  // no negative zeros
  // Strike is level: dip x normal = strike, with dip the downward direction in the plane.
  const bool flat = std::abs(chart.normal[2]) > 1 - 1e-9;
  if (flat) {
    chart.dip = column(by_size[2]);
    chart.dip = unit({chart.dip[0], chart.dip[1], 0});
  } else {
    const double n = chart.normal[2];
    chart.dip = unit({-n * chart.normal[0], -n * chart.normal[1], 1 - n * n});
  }
  chart.strike = cross(chart.dip, chart.normal);
  if (!flat) chart.strike[2] = 0;
  chart.strike = unit(chart.strike);
  chart.along = main_direction(chart, pillars);
  return chart;
}

}  // namespace

Chart fit_chart(std::span<const PillarInput> pillars) {
  const std::vector<const PillarInput*> ordered = by_id(pillars);
  Middle middle;
  for (const PillarInput* p : ordered) {
    for (const IndexPoint& q : p->nodes) {
      if (!in_reach(q))
        throw Error(ErrorCode::kInvalid,
                    fmt::format("a node of pillar '{}' is not finite, or too far away", p->name_for_messages),
                    "nodes lie within 2^23 voxels of the survey");
      middle.add(q);
    }
  }
  if (middle.count < 3)
    throw Error(ErrorCode::kInvalid,
                fmt::format("the fault has {} nodes, a surface needs three", int(middle.count)),
                "pick more nodes");
  const Vector3 origin = middle.place();
  Moments moments{};
  for (const PillarInput* p : ordered) {
    for (const IndexPoint& q : p->nodes)
      add_moment(moments, {q.i - origin[0], q.j - origin[1], q.k - origin[2]});
  }
  const Axes axes(moments);
  if (!(std::sqrt(std::max(0.0, axes.middle()) / middle.count) > kTouch))
    throw Error(ErrorCode::kInvalid, "the pillars' nodes all lie on one line",
                "pick the fault on further sections");
  return frame_of(origin, axes, pillars);
}

std::optional<Chart> fit_chart_across(std::span<const PillarInput> pillars) {
  // 1. The middle of each pillar, and of those.
  const std::vector<const PillarInput*> ordered = by_id(pillars);
  std::vector<Vector3> middles;
  Middle whole;
  for (const PillarInput* p : ordered) {
    Middle one;
    for (const IndexPoint& q : p->nodes) one.add(q);
    if (one.count == 0) return std::nullopt;
    middles.push_back(one.place());
    whole.add({middles.back()[0], middles.back()[1], middles.back()[2]});
  }
  if (middles.size() < 3) return std::nullopt;
  // 2. Spread along the pillars, and spread from pillar to pillar.
  Moments along{}, between{};
  const Vector3 origin = whole.place();
  for (std::size_t n = 0; n < ordered.size(); ++n) {
    const Vector3& m = middles[n];
    for (const IndexPoint& q : ordered[n]->nodes) add_moment(along, {q.i - m[0], q.j - m[1], q.k - m[2]});
    add_moment(between, {m[0] - origin[0], m[1] - origin[1], m[2] - origin[2]});
  }
  // 3. Both count alike.
  const double a = along[0][0] + along[1][1] + along[2][2], b = between[0][0] + between[1][1] + between[2][2];
  if (!(a > kTouch) || !(b > kTouch)) return std::nullopt;
  Moments both{};
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) both[r][c] = along[r][c] / a + between[r][c] / b;
  const Axes axes(both);
  if (!(axes.middle() > 1e-6)) return std::nullopt;
  return frame_of(origin, axes, pillars);
}

}  // namespace footwall::pillars
