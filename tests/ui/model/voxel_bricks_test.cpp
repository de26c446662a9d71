#include "ui/model/voxel_bricks.h"

#include <QSignalSpy>
#include <QTest>
#include <cmath>

#include "ui/model/face_voxels.h"
#include "ui/model/surface_worker.h"
#include "ui/sample_project.h"
#include "ui/test_class.h"

namespace footwall::ui {
namespace {

// Two triangles through the survey, slantwise.
std::shared_ptr<const FaultSurface> sheet(const survey::Geometry& survey, double shift = 0) {
  auto surface = std::make_shared<FaultSurface>();
  surface->fault = 1;
  for (const survey::IndexPoint& p :
       {survey::IndexPoint{3.2, 2.1, 1.0}, survey::IndexPoint{44.7, 5.5, 3.0},
        survey::IndexPoint{6.1, 33.3, 60.4}, survey::IndexPoint{42.0, 37.2, 61.9}}) {
    surface->vertices.push_back(survey.world_of({p.i, p.j, p.k - shift}));
  }
  surface->faces = {{1, 0, {0, 1, 2}}, {1, 1, {1, 3, 2}}};
  return surface;
}

struct Made {
  SampleProject sample;
  project::Project project = sample.open();
  survey::Geometry survey = *project.survey();
  project::VolumeRecord record = project.volumes().front();
  volume::VolumeReader reader{project.volume_path(record)};

  float at(const survey::Index& place) const {
    survey::Box one{place, {place[0] + 1, place[1] + 1, place[2] + 1}};
    std::vector<float> value(1);
    reader.read(one, value);
    return value[0];
  }
  VoxelBricks read(const FaultSurface& surface, std::size_t most, const VoxelBricks* known = nullptr) const {
    return *read_bricks(reader, record.id, record.origin, survey, surface, most, known, [] { return false; });
  }
};

// A place of the sheet's first face.
survey::IndexPoint on_face(const survey::Geometry& survey, const FaultSurface& surface, double u, double v) {
  const auto corner = [&](std::size_t n) { return survey.index_of(surface.vertices[n]); };
  const survey::IndexPoint a = corner(0), b = corner(1), c = corner(2);
  const auto mixed = [&](double x, double y, double z) { return x + u * (y - x) + v * (z - x); };
  return {mixed(a.i, b.i, c.i), mixed(a.j, b.j, c.j), mixed(a.k, b.k, c.k)};
}

}  // namespace

class VoxelBricksTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void hold_the_samples_along_the_surface();
  void are_coarser_where_they_would_be_many();
  void what_is_known_is_taken_over();
  void say_where_there_is_nothing();
  void follow_surface_and_volume();
};

void VoxelBricksTest::hold_the_samples_along_the_surface() {
  const Made made;
  const auto surface = sheet(made.survey);
  const VoxelBricks bricks = made.read(*surface, 10'000);
  QCOMPARE(bricks.step, 1);
  // Of 6 x 5 x 8 bricks a sheet meets a part.
  QVERIFY2(bricks.count() > 20 && bricks.count() < 140, qPrintable(QString::number(bricks.count())));
  int compared = 0;
  for (double u = 0; u <= 1; u += 1.0 / 32) {
    for (double v = 0; u + v <= 1; v += 1.0 / 32) {
      const survey::IndexPoint p = on_face(made.survey, *surface, u, v);
      const auto found = bricks.nearest(p);
      QVERIFY(found.has_value());
      const auto whole = [](double x) { return static_cast<std::int64_t>(std::floor(x + 0.5)); };
      QCOMPARE(*found, made.at({whole(p.i), whole(p.j), whole(p.k)}));
      ++compared;
    }
  }
  QVERIFY(compared > 400);
}

void VoxelBricksTest::are_coarser_where_they_would_be_many() {
  const Made made;
  const auto surface = sheet(made.survey);
  const VoxelBricks bricks = made.read(*surface, 30);
  QVERIFY(bricks.count() <= 30);
  QVERIFY(bricks.step >= 2);
  const survey::IndexPoint p = on_face(made.survey, *surface, 0.3, 0.3);
  const auto whole = [&](double x) {
    return bricks.step * static_cast<std::int64_t>(std::floor(x / static_cast<double>(bricks.step) + 0.5));
  };
  QCOMPARE(bricks.nearest(p).value(), made.at({whole(p.i), whole(p.j), whole(p.k)}));
  QCOMPARE(made.read(*surface, 1).count(), std::size_t{1});
}

void VoxelBricksTest::what_is_known_is_taken_over() {
  const Made made;
  const auto surface = sheet(made.survey);
  VoxelBricks known = made.read(*surface, 10'000);
  // A mark in what is known tells that it was not read again; the file says the rest.
  for (float& value : known.samples) value = 77;
  const auto moved = sheet(made.survey, 3);
  const VoxelBricks bricks = made.read(*moved, 10'000, &known);
  std::size_t taken = 0;
  for (std::size_t n = 0; n < bricks.count(); ++n) {
    taken += bricks.samples[n * VoxelBricks::kSamples + 400] == 77 ? 1 : 0;
  }
  QVERIFY(taken > bricks.count() / 3);
  QVERIFY(taken < bricks.count());
  known.volume += 1;
  const VoxelBricks other = made.read(*moved, 10'000, &known);
  QVERIFY(std::ranges::find(other.samples, 77.0F) == other.samples.end());
}

void VoxelBricksTest::say_where_there_is_nothing() {
  const Made made;
  const auto surface = sheet(made.survey);
  const VoxelBricks bricks = made.read(*surface, 10'000);
  QVERIFY(std::isnan(bricks.nearest({-0.6, 4, 4}).value()));
  QVERIFY(std::isnan(bricks.nearest({4, 4, 63.6}).value()));
  QVERIFY(!bricks.nearest({40, 4, 60}).has_value());  // far from the sheet
  QVERIFY(
      !read_bricks(made.reader, made.record.id, made.record.origin, made.survey, *surface, 100, nullptr, [] {
         return true;
       }).has_value());
  FaultSurface outside = *surface;
  for (survey::WorldPoint& p : outside.vertices) p.z += 1e6;
  QCOMPARE(made.read(outside, 100).count(), std::size_t{0});
  for (survey::WorldPoint& p : outside.vertices) p.x = std::nan("");
  QCOMPARE(made.read(outside, 100).count(), std::size_t{0});
}

void VoxelBricksTest::follow_surface_and_volume() {
  const SampleProject sample;
  Document document(sample.open());
  const survey::Geometry survey = *document.survey();
  const Id volume = document.volumes().front().id;
  FaceVoxels voxels(document);
  QSignalSpy changes(&voxels, &FaceVoxels::changed);
  QSignalSpy failures(&voxels, &FaceVoxels::failed);
  voxels.want(volume, {sheet(survey)});
  QTRY_VERIFY(voxels.is_settled());
  QCOMPARE(changes.size(), 1);
  QVERIFY(voxels.bricks(1) != nullptr);
  QVERIFY(voxels.facts() != nullptr && voxels.facts()->signed_values);
  const auto first = voxels.bricks(1);
  // Asked for many in a row, the last one stands.
  std::shared_ptr<const FaultSurface> last;
  for (int n = 1; n <= 20; ++n) {
    last = sheet(survey, 0.5 * n);
    voxels.want(volume, {last});
  }
  QTRY_VERIFY(voxels.is_settled());
  QVERIFY(voxels.bricks(1)->nearest(survey.index_of(last->vertices[2])).has_value());
  QVERIFY(voxels.bricks(1) != first);
  QVERIFY(changes.size() < 22);
  voxels.want(volume, {});
  QVERIFY(voxels.bricks(1) == nullptr);
  // A file that is gone is told once.
  std::filesystem::remove(document.project().volume_path(document.volumes().front()));
  voxels.want(0, {});
  voxels.want(volume, {sheet(survey)});
  QTRY_COMPARE(failures.size(), 1);
  QVERIFY(!failures[0][0].toString().isEmpty());
  QTRY_VERIFY(voxels.is_settled());
  QVERIFY(voxels.bricks(1) == nullptr);
}

static const RegisterTest<VoxelBricksTest> registered;

}  // namespace footwall::ui

#include "voxel_bricks_test.moc"
