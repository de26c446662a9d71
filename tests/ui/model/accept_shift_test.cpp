#include "ui/model/accept_shift.h"

#include <QSignalSpy>
#include <QTest>
#include <cmath>

#include "ui/model/fault_commands.h"
#include "ui/sample_project.h"
#include "ui/test_class.h"

namespace footwall::ui {
namespace {

using survey::IndexPoint;

constexpr int kPatience = 60000;

IndexPoint plus(const IndexPoint& a, const IndexPoint& b, double times = 1) {
  return {a.i + times * b.i, a.j + times * b.j, a.k + times * b.k};
}
double dot(const IndexPoint& a, const IndexPoint& b) {
  return a.i * b.i + a.j * b.j + a.k * b.k;
}
IndexPoint cross(const IndexPoint& a, const IndexPoint& b) {
  return {a.j * b.k - a.k * b.j, a.k * b.i - a.i * b.k, a.i * b.j - a.j * b.i};
}

std::array<IndexPoint, 3> corners_of(const FaultSurface& surface, std::size_t face) {
  std::array<IndexPoint, 3> corners;
  for (std::size_t n = 0; n < 3; ++n)
    corners[n] = surface.places[static_cast<std::size_t>(surface.faces[face].vertices[n])];
  return corners;
}
IndexPoint middle_of(const FaultSurface& surface, std::size_t face) {
  const auto c = corners_of(surface, face);
  return {(c[0].i + c[1].i + c[2].i) / 3, (c[0].j + c[1].j + c[2].j) / 3, (c[0].k + c[1].k + c[2].k) / 3};
}
// By the winding, of length 1.
IndexPoint normal_of(const FaultSurface& surface, std::size_t face) {
  const auto c = corners_of(surface, face);
  const IndexPoint n = cross(plus(c[1], c[0], -1), plus(c[2], c[0], -1));
  return plus({}, n, 1 / std::sqrt(dot(n, n)));
}

// How far a place is from the plane of the face that a line along `normal` through it meets; infinite where
// it meets none.
double distance_from(const FaultSurface& surface, const IndexPoint& place, const IndexPoint& normal) {
  double nearest = INFINITY;
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    const auto c = corners_of(surface, f);
    const IndexPoint n = normal_of(surface, f);
    const double along = dot(n, plus(c[0], place, -1)) / dot(n, normal);
    const IndexPoint hit = plus(place, normal, along);
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const IndexPoint edge = plus(c[(k + 1) % 3], c[k], -1);
      inside = inside && dot(cross(edge, plus(hit, c[k], -1)), n) >= -1e-9;
    }
    if (inside) nearest = std::min(nearest, std::abs(along));
  }
  return nearest;
}

FaceNumbers offsets_of(const FaultSurface& surface, double value) {
  FaceNumbers numbers;
  numbers.values.assign(surface.faces.size(), value);
  numbers.stale.assign(surface.faces.size(), 0);
  numbers.hatched.assign(surface.faces.size(), 0);
  return numbers;
}

// The first fault of a small project with its surface; no engine.
struct Bench {
  Bench() : document(sample.open()), surfaces(document, nullptr) {}
  bool settle() {
    return QTest::qWaitFor([this] { return surfaces.is_settled() && surface() != nullptr; }, kPatience);
  }
  const Fault& fault() const { return document.faults()[0]; }
  std::shared_ptr<const FaultSurface> surface() const { return surfaces.surface(fault().record.id); }
  const survey::Geometry& survey() const { return *document.survey(); }
  bool move(const Shift& shift) {
    return document.edit("shift", [&](project::Interpretation& now) {
      for (const auto& [node, to] : shift.moved) now.move_node(node, to);
    });
  }
  SampleProject sample;
  Document document;
  Surfaces surfaces;
};

}  // namespace

class AcceptShiftTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void a_face_moves_by_its_offset();
  void the_sign_counts_along_the_faults_normal();
  void a_pillar_moves_by_the_mean_around_each_node();
  void what_is_not_known_moves_nothing();
  void says_why_nothing_can_be_accepted();
};

void AcceptShiftTest::a_face_moves_by_its_offset() {
  Bench bench;
  QVERIFY(bench.settle());
  const auto before = bench.surface();
  for (const std::size_t face : {std::size_t{0}, before->faces.size() / 2, before->faces.size() - 1}) {
    const FaceNumbers offsets = offsets_of(*before, 1.5);
    const auto shift = shift_of_face(bench.survey(), bench.fault().pillars, *before, offsets, face);
    QVERIFY(shift.has_value());
    QCOMPARE(shift->voxels, 1.5);
    const IndexPoint middle = middle_of(*before, face);
    const IndexPoint normal = normal_of(*before, face);
    // Nodes go along the face's normal, by no more than half as far again.
    for (const auto& [node, to] : shift->moved) {
      survey::WorldPoint from;
      for (const survey::Pillar& pillar : bench.fault().pillars)
        for (const auto& one : pillar.nodes)
          if (one.id == node) from = one.position;
      const IndexPoint by = plus(bench.survey().index_of(to), bench.survey().index_of(from), -1);
      QVERIFY(std::abs(std::sqrt(dot(by, by)) - before->side * dot(by, normal)) < 1e-3);
      QVERIFY(before->side * dot(by, normal) > 0);
      QVERIFY(dot(by, by) < 1.5 * 1.5 * 1.5 * 1.5);
    }
    QVERIFY(bench.move(*shift));
    QTRY_VERIFY_WITH_TIMEOUT(bench.surfaces.is_settled() && bench.surface() != before, kPatience);
    const double off = distance_from(*bench.surface(), plus(middle, normal, 1.5 * before->side), normal);
    QVERIFY2(off < 0.35, qPrintable(QString::number(off)));
    QVERIFY(distance_from(*bench.surface(), middle, normal) > 1.1);
    QVERIFY(bench.document.undo());
    QTRY_VERIFY_WITH_TIMEOUT(bench.surfaces.is_settled() && bench.surface()->lattice == before->lattice,
                             kPatience);
  }
}

void AcceptShiftTest::the_sign_counts_along_the_faults_normal() {
  Bench bench;
  QVERIFY(bench.settle());
  const FaceNumbers offsets = offsets_of(*bench.surface(), 2);
  const auto shift = shift_of_face(bench.survey(), bench.fault().pillars, *bench.surface(), offsets, 0);
  // The mean normal of the synthetic fault is not along the inlines: its first component that is not zero is
  // i's.
  IndexPoint mean;
  for (std::size_t f = 0; f < bench.surface()->faces.size(); ++f) {
    const auto c = corners_of(*bench.surface(), f);
    mean = plus(mean, cross(plus(c[1], c[0], -1), plus(c[2], c[0], -1)));
  }
  QVERIFY(std::abs(mean.i) > 1);
  const auto& [node, to] = *shift->moved.begin();
  for (const survey::Pillar& pillar : bench.fault().pillars) {
    for (const auto& one : pillar.nodes) {
      if (one.id == node) QVERIFY(bench.survey().index_of(to).i > bench.survey().index_of(one.position).i);
    }
  }
  // Wound the other way, it is the same shift.
  FaultSurface turned = *bench.surface();
  for (auto& face : turned.faces) std::swap(face.vertices[1], face.vertices[2]);
  for (auto& triangle : turned.lattice) std::swap(triangle[1], triangle[2]);
  turned.side = -turned.side;
  const auto other = shift_of_face(bench.survey(), bench.fault().pillars, turned, offsets, 0);
  QCOMPARE(other->moved.size(), shift->moved.size());
  for (const auto& [id, place] : other->moved) {
    QVERIFY(std::hypot(place.x - shift->moved.at(id).x, place.y - shift->moved.at(id).y) < 1e-6);
  }
}

void AcceptShiftTest::a_pillar_moves_by_the_mean_around_each_node() {
  Bench bench;
  QVERIFY(bench.settle());
  const auto surface = bench.surface();
  FaceNumbers offsets = offsets_of(*surface, 1);
  const survey::Pillar pillar = bench.fault().pillars[bench.fault().pillars.size() / 2];
  const auto all = shift_of_pillar(bench.survey(), pillar, *surface, offsets);
  QVERIFY(all.has_value());
  QCOMPARE(all->moved.size(), pillar.nodes.size());
  for (const auto& node : pillar.nodes) {
    const IndexPoint by =
        plus(bench.survey().index_of(all->moved.at(node.id)), bench.survey().index_of(node.position), -1);
    QVERIFY(std::abs(std::sqrt(dot(by, by)) - 1) < 1e-3);
  }
  // Half of them twice as far, the others not at all: between.
  for (std::size_t f = 0; f < offsets.values.size(); ++f) offsets.values[f] = f % 2 == 0 ? 2 : 0;
  const auto some = shift_of_pillar(bench.survey(), pillar, *surface, offsets);
  QVERIFY(some.has_value());
  QVERIFY(some->voxels > 0 && some->voxels <= 2);
  // Faces of the other end of the fault do not count.
  const survey::Pillar& far = bench.fault().pillars.front();
  for (std::size_t f = 0; f < offsets.values.size(); ++f) {
    bool touches = false;
    for (const std::int32_t vertex : surface->faces[f].vertices)
      touches = touches || surface->pillars[static_cast<std::size_t>(vertex)] == far.id;
    offsets.values[f] = touches ? 3 : 0;
  }
  QCOMPARE(shift_of_pillar(bench.survey(), far, *surface, offsets)->voxels, 3.0);
  QVERIFY(!shift_of_pillar(bench.survey(), bench.fault().pillars.back(), *surface, offsets));
}

void AcceptShiftTest::what_is_not_known_moves_nothing() {
  Bench bench;
  QVERIFY(bench.settle());
  const auto shift = [&](const FaceNumbers& offsets) {
    return shift_of_face(bench.survey(), bench.fault().pillars, *bench.surface(), offsets, 0);
  };
  const FaceNumbers good = offsets_of(*bench.surface(), 2);
  QVERIFY(shift(good).has_value());
  FaceNumbers bad = good;
  bad.stale[0] = 1;
  QVERIFY(!shift(bad));
  bad = good;
  bad.hatched[0] = 1;
  QVERIFY(!shift(bad));
  bad = good;
  bad.values[0] = NAN;
  QVERIFY(!shift(bad));
  QVERIFY(!shift(offsets_of(*bench.surface(), 0)));
}

void AcceptShiftTest::says_why_nothing_can_be_accepted() {
  Bench bench;
  QVERIFY(bench.settle());
  Selection selection(bench.document);
  QSignalSpy failed(&bench.document, &Document::failed);
  const std::size_t steps = bench.document.history().size();
  QVERIFY(!accept_shift(bench.document, bench.surfaces, selection));
  QVERIFY(failed.takeLast()[0].toString().contains("select a face or a pillar"));
  const project::MeshFace& face = bench.surface()->faces[0];
  selection.select(
      {.kind = Item::Kind::kFace, .id = bench.fault().record.id, .panel = face.panel, .number = face.n});
  QVERIFY(!accept_shift(bench.document, bench.surfaces, selection));
  QVERIFY(failed.takeLast()[0].toString().contains("no shift is known"));
  QVERIFY(shift_hint(bench.document, bench.surfaces, selection).isEmpty());
  QCOMPARE(bench.document.history().size(), steps);
}

static const RegisterTest<AcceptShiftTest> kRegistered;

}  // namespace footwall::ui

#include "accept_shift_test.moc"
