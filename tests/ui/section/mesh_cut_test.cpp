#include "ui/section/mesh_cut.h"

#include <QTest>
#include <algorithm>
#include <cmath>
#include <random>

#include "ui/section/fault_shapes.h"
#include "ui/test_class.h"

namespace footwall::ui {
namespace {

double length_of(const std::vector<CutSegment>& cut) {
  double sum = 0;
  for (const CutSegment& s : cut) sum += std::hypot(s[0].u - s[1].u, s[0].v - s[1].v);
  return sum;
}

survey::IndexPoint between(const survey::IndexPoint& a, const survey::IndexPoint& b, double part) {
  return {a.i + part * (b.i - a.i), a.j + part * (b.j - a.j), a.k + part * (b.k - a.k)};
}

// Slow and obvious: rays from one corner to points of the opposite edge, each halved down to where it meets
// the plane.
std::vector<PlanePoint> points_in_plane(const Section& section,
                                        const std::array<survey::IndexPoint, 3>& corners) {
  std::vector<PlanePoint> found;
  for (int corner = 0; corner < 3; ++corner) {
    for (int n = 0; n <= 50; ++n) {
      survey::IndexPoint a = corners[corner];
      survey::IndexPoint b = between(corners[(corner + 1) % 3], corners[(corner + 2) % 3], n / 50.0);
      if (distance_from(section, a) * distance_from(section, b) > 0) continue;
      for (int halving = 0; halving < 60; ++halving) {
        const survey::IndexPoint middle = between(a, b, 0.5);
        (distance_from(section, a) * distance_from(section, middle) <= 0 ? b : a) = middle;
      }
      found.push_back(plane_of(section, between(a, b, 0.5)));
    }
  }
  return found;
}

double distance_to(const CutSegment& s, const PlanePoint& p) {
  const double du = s[1].u - s[0].u, dv = s[1].v - s[0].v;
  const double square = du * du + dv * dv;
  const double part =
      square > 0 ? std::clamp(((p.u - s[0].u) * du + (p.v - s[0].v) * dv) / square, 0.0, 1.0) : 0;
  return std::hypot(p.u - s[0].u - part * du, p.v - s[0].v - part * dv);
}

project::MeshFace face(int a, int b, int c) {
  return {.panel = 1, .n = 0, .vertices = {a, b, c}};
}

const std::vector<Section> kSections{
    {.kind = Section::Kind::kInline, .index = 5},
    {.kind = Section::Kind::kCrossline, .index = 4},
    {.kind = Section::Kind::kSlice, .index = 6},
    {.kind = Section::Kind::kLine, .index = 0, .from = {1, 2, 0}, .to = {9, 7, 0}}};

}  // namespace

class MeshCutTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void agrees_with_a_slow_search();
  void joins_across_faces();
  void draws_what_only_touches_the_plane();
  void joins_rings_and_forks();
  void bears_broken_meshes();
  void is_drawn_two_pixels_wide();
};

void MeshCutTest::agrees_with_a_slow_search() {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(0, 10);
  std::uniform_int_distribution<int> whole(3, 7);
  int cuts = 0;
  for (int n = 0; n < 400; ++n) {
    // Every other triangle on whole numbers, where corners and edges lie in the plane.
    std::array<survey::IndexPoint, 3> corners;
    for (survey::IndexPoint& p : corners) {
      p = n % 2 == 0 ? survey::IndexPoint{anywhere(random), anywhere(random), anywhere(random)}
                     : survey::IndexPoint{1.0 * whole(random), 1.0 * whole(random), 1.0 * whole(random)};
    }
    for (const Section& section : kSections) {
      const std::vector<CutSegment> cut = mesh_cut(section, corners, std::vector{face(0, 1, 2)});
      const std::vector<PlanePoint> truth = points_in_plane(section, corners);
      int inner = 0;
      for (const PlanePoint& p : truth) {
        double nearest = 1e9;
        for (const CutSegment& s : cut) nearest = std::min(nearest, distance_to(s, p));
        // A single point is no segment.
        const bool alone = std::ranges::all_of(
            truth, [&](const PlanePoint& q) { return std::hypot(p.u - q.u, p.v - q.v) < 1e-6; });
        const bool flat =
            std::ranges::all_of(corners, [&](const auto& c) { return distance_from(section, c) == 0; });
        if (!alone && !flat) QVERIFY2(nearest < 1e-6, qPrintable(QString::number(nearest)));
        inner += alone ? 0 : 1;
      }
      cuts += inner > 0 ? 1 : 0;
      // And no more than that.
      for (const CutSegment& s : cut) {
        for (const PlanePoint& end : s) {
          double nearest = 1e9;
          for (const PlanePoint& p : truth) nearest = std::min(nearest, std::hypot(p.u - end.u, p.v - end.v));
          QVERIFY(nearest < 0.5);
          QVERIFY(std::abs(distance_from(section, index_of(section, end))) < 1e-9);
        }
      }
    }
  }
  QVERIFY(cuts > 300);
}

void MeshCutTest::joins_across_faces() {
  // A bumpy sheet across the inlines: its cut with an inline has no gaps.
  constexpr int kSide = 20;
  std::vector<survey::IndexPoint> places;
  std::vector<project::MeshFace> faces;
  for (int a = 0; a <= kSide; ++a) {
    for (int b = 0; b <= kSide; ++b) places.push_back({a * 0.7, 5 + std::sin(a * 0.5 + b * 0.3), b * 1.0});
  }
  for (int a = 0; a < kSide; ++a) {
    for (int b = 0; b < kSide; ++b) {
      const int at = a * (kSide + 1) + b;
      faces.push_back(face(at, at + 1, at + kSide + 1));
      faces.push_back(face(at + 1, at + kSide + 2, at + kSide + 1));
    }
  }
  for (const std::int64_t index : {3, 7}) {  // 7 goes through nodes: 10 x 0.7
    const auto cut = mesh_cut({.kind = Section::Kind::kInline, .index = index}, places, faces);
    double low = 1e9, high = -1e9;
    for (const CutSegment& s : cut) {
      for (const PlanePoint& end : s) {
        low = std::min(low, end.v);
        high = std::max(high, end.v);
        const auto same = [&](const CutSegment& other) {
          return std::ranges::any_of(
              other, [&](const PlanePoint& p) { return std::hypot(p.u - end.u, p.v - end.v) < 1e-9; });
        };
        QVERIFY(std::ranges::count_if(cut, same) == 2 || end.v == 0 || end.v == kSide);
      }
    }
    QVERIFY(low == 0 && high == kSide);
    QVERIFY(length_of(cut) >= kSide && length_of(cut) < 1.5 * kSide);
    const auto lines = joined(cut);
    QCOMPARE(lines.size(), std::size_t{1});
    QCOMPARE(lines[0].size(), cut.size() + 1);
    double length = 0;
    for (std::size_t n = 1; n < lines[0].size(); ++n) {
      length += std::hypot(lines[0][n].u - lines[0][n - 1].u, lines[0][n].v - lines[0][n - 1].v);
    }
    QVERIFY(std::abs(length - length_of(cut)) < 1e-9);
  }
}

void MeshCutTest::draws_what_only_touches_the_plane() {
  const Section section{.kind = Section::Kind::kInline, .index = 2};
  // A fault that ends at the section, on either side of it: its edge shows, once.
  for (const double beyond : {1.0, 3.0}) {
    const std::vector<survey::IndexPoint> places{{2, 0, 0}, {2, 0, 5}, {beyond, 1, 0}, {beyond, 1, 5}};
    const auto cut = mesh_cut(section, places, std::vector{face(0, 1, 2), face(1, 3, 2)});
    QCOMPARE(cut.size(), std::size_t{1});
    QCOMPARE(length_of(cut), 5.0);
  }
  // Both sides of an edge in the plane.
  const std::vector<survey::IndexPoint> places{{2, 0, 0}, {2, 0, 5}, {1, 1, 0}, {3, 1, 5}};
  QCOMPARE(mesh_cut(section, places, std::vector{face(0, 1, 2), face(1, 0, 3)}).size(), std::size_t{1});
}

void MeshCutTest::joins_rings_and_forks() {
  const auto segment = [](double u0, double v0, double u1, double v1) {
    return CutSegment{{{{u0, v0}, {u1, v1}}}, 0};
  };
  // A square ring, and a fork of three arms of two segments each, in no order.
  const std::vector<CutSegment> cut{segment(0, 0, 0, 1),  segment(9, 9, 8, 9), segment(1, 1, 0, 1),
                                    segment(9, 9, 9, 8),  segment(1, 0, 1, 1), segment(9, 9, 9, 10),
                                    segment(0, 0, 1, 0),  segment(9, 7, 9, 8), segment(8, 9, 7, 9),
                                    segment(9, 11, 9, 10)};
  const auto lines = joined(cut);
  QCOMPARE(lines.size(), std::size_t{4});
  std::size_t segments = 0;
  for (const CutLine& line : lines) segments += line.size() - 1;
  QCOMPARE(segments, cut.size());
  QVERIFY(lines.back().size() == 5 && lines.back().front() == lines.back().back());
  QVERIFY(joined({}).empty());
}

void MeshCutTest::bears_broken_meshes() {
  const Section section{.kind = Section::Kind::kSlice, .index = 0};
  const std::vector<survey::IndexPoint> places{{0, 0, -1}, {0, 1, 1}, {NAN, 0, 0}, {1, 1, 1}};
  QVERIFY(mesh_cut(section, places, std::vector{face(0, 1, 9), face(-1, 0, 1)}).empty());
  mesh_cut(section, places, std::vector{face(0, 1, 2), face(2, 2, 2), face(0, 0, 1)});
  const Section point{.kind = Section::Kind::kLine, .index = 0, .from = {1, 1, 0}, .to = {1, 1, 0}};
  mesh_cut(point, places, std::vector{face(0, 1, 3)});
}

void MeshCutTest::is_drawn_two_pixels_wide() {
  const Section section{.kind = Section::Kind::kInline, .index = 2};
  const std::vector<survey::IndexPoint> places{{0, 10, 5}, {4, 10, 5}, {0, 10, 95}, {4, 10, 95}};
  ShapedFault fault;
  fault.cut = mesh_cut(section, places, std::vector{face(0, 1, 2), face(1, 3, 2)});
  QCOMPARE(fault.cut.size(), std::size_t{2});
  QCOMPARE(fault.cut[0].face + fault.cut[1].face, std::size_t{1});
  fault.lines = joined(fault.cut);
  ViewTransform view;
  view.set_area({0, 0, 100, 400});
  view.set_frame(
      {.size = {20, 100}, .metres_per_u = 5, .metres_per_v = 4, .upward = false, .vertical = false});
  view.fit();
  QImage image(100, 400, QImage::Format_RGB32);
  image.fill(Qt::black);
  {
    QPainter painter(&image);
    painter.setRenderHint(QPainter::Antialiasing);
    FaultDrawing how;
    how.colour = QColor(255, 0, 0);
    draw_fault(painter, fault, view, how, {}, {});
  }
  for (int y = 40; y < 360; y += 10) {
    double ink = 0, middle = 0;
    for (int x = 0; x < 100; ++x) {
      ink += qRed(image.pixel(x, y)) / 255.0;
      middle += qRed(image.pixel(x, y)) / 255.0 * (x + 0.5);
    }
    QVERIFY(std::abs(ink - 2) < 0.15);
    QVERIFY(std::abs(middle / ink - view.to_pixels({10, 0}).x()) < 0.3);
  }
  QCOMPARE(qRed(image.pixel(50, 2)), 0);
}

static const RegisterTest<MeshCutTest> kRegistered;

}  // namespace footwall::ui

#include "mesh_cut_test.moc"
