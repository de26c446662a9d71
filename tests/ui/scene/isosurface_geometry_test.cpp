// Isosurfaces as triangles in the scene.
#include <QSignalSpy>
#include <QTest>
#include <atomic>
#include <mutex>

#include "engine/isosurface/extract.h"
#include "storage/base/error.h"
#include "storage/volume/volume_reader.h"
#include "ui/scene/made_scene.h"
#include "ui/scene3d/isosurface_maker.h"
#include "ui/test_class.h"

namespace footwall::ui {
namespace {

struct Answers {
  std::mutex mutex;
  std::vector<std::shared_ptr<const IsosurfaceShape>> shapes;
  std::vector<std::string> failures;
  IsosurfaceMaker::Events events() {
    return {.made =
                [this](std::shared_ptr<const IsosurfaceShape> shape) {
                  const std::scoped_lock lock(mutex);
                  shapes.push_back(std::move(shape));
                },
            .progress = [](double) {},
            .failed =
                [this](const IsosurfaceRequest&, const std::string& message, const std::string&) {
                  const std::scoped_lock lock(mutex);
                  failures.push_back(message);
                }};
  }
  std::size_t count() {
    const std::scoped_lock lock(mutex);
    return shapes.size() + failures.size();
  }
};

IsosurfaceRequest request_of(const project::Project& project, double value) {
  const project::VolumeRecord record = project.volumes().front();
  return {.isosurface = 1,
          .volume = record.id,
          .name = record.name,
          .path = project.volume_path(record),
          .checksum = record.checksum,
          .place = {{0, 0, 0}, {render::Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
          .value = value};
}

// The engine's triangles of the whole volume, as places of their middles; the order tells nothing.
std::vector<std::array<float, 3>> middles(const IsosurfaceShape& shape) {
  std::vector<std::array<float, 3>> result;
  for (std::size_t n = 0; n < shape.corners.size(); n += 3) {
    render::Vec3 sum;
    for (std::size_t c = 0; c < 3; ++c) sum = sum + render::Vec3(shape.positions[shape.corners[n + c]]);
    result.push_back({static_cast<float>(sum.x), static_cast<float>(sum.y), static_cast<float>(sum.z)});
  }
  std::ranges::sort(result);
  return result;
}

void show_as_triangles(MadeScene& scene, Id isosurface) {
  for (IsosurfaceLook look : scene.bench.display.isosurfaces()) {
    if (look.id != isosurface) continue;
    look.as_picture = false;
    look.colour = QStringLiteral("#ff00ff");
    scene.bench.display.change_isosurface(look);
    return;
  }
}

int purple(const QImage& image) {
  int count = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const QColor c = image.pixelColor(x, y);
      count += c.green() < 20 && c.red() > 90 && std::abs(c.red() - c.blue()) < 12 ? 1 : 0;
    }
  }
  return count;
}

}  // namespace

class IsosurfaceGeometryTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void slabs_give_the_surface_of_the_whole();
  void the_newest_value_wins();
  void too_many_triangles_are_refused();
  void the_scene_shows_and_picks_it();
  void the_camera_moves_with_few_triangles();
};

void IsosurfaceGeometryTest::slabs_give_the_surface_of_the_whole() {
  const SampleProject sample;
  const project::Project project = sample.open();
  const IsosurfaceRequest request = request_of(project, 0.3);
  const volume::VolumeReader reader(request.path);
  const survey::Index n = reader.info().dims;
  std::vector<float> samples(static_cast<std::size_t>(n[0] * n[1] * n[2]));
  reader.read({{0, 0, 0}, n}, samples);
  isosurface::Surface whole;
  isosurface::extract({.values = samples, .size = n, .origin = {}, .volume_size = n}, 0.3F, {}, whole);
  QVERIFY(whole.triangles.size() > 1000);
  // Once all samples at once, once nine inlines at a time.
  std::vector<std::vector<std::array<float, 3>>> both;
  for (const std::int64_t bytes : {std::int64_t{1} << 30, 4 * 12 * n[1] * n[2]}) {
    Answers answers;
    IsosurfaceMaker maker(answers.events(), IsosurfaceMaker::kMostTriangles, bytes);
    QCOMPARE(maker.want({request}).size(), std::size_t{1});
    QTRY_COMPARE(answers.count(), std::size_t{1});
    QVERIFY(answers.failures.empty());
    const IsosurfaceShape& shape = *answers.shapes[0];
    QCOMPARE(shape.triangles(), whole.triangles.size());
    QCOMPARE(shape.normals.size(), shape.positions.size());
    both.push_back(middles(shape));
    for (std::size_t level = 0; level < shape.coarse.size(); ++level)
      QVERIFY(shape.coarse[level].faces.size() <= IsosurfaceShape::kCoarse[level]);
    QVERIFY(maker.want({request}).empty());  // it is there already
  }
  QVERIFY(both[0] == both[1]);
  // Normals point to lower values.
  int right = 0, all = 0;
  Answers answers;
  IsosurfaceMaker maker(answers.events());
  maker.want({request});
  QTRY_COMPARE(answers.count(), std::size_t{1});
  const IsosurfaceShape& shape = *answers.shapes[0];
  for (std::size_t v = 0; v < shape.positions.size(); v += 17) {
    const auto at = [&](double along) {
      const auto place = [&](float p, int axis) {
        const double moved =
            static_cast<double>(p) + along * shape.normals[v][static_cast<std::size_t>(axis)] / 127.0;
        return std::clamp<std::int64_t>(std::llround(moved), 0, n[axis] - 1);
      };
      const std::array<std::int64_t, 3> p{place(shape.positions[v].x, 0), place(shape.positions[v].y, 1),
                                          place(shape.positions[v].z, 2)};
      return samples[static_cast<std::size_t>((p[0] * n[1] + p[1]) * n[2] + p[2])];
    };
    ++all;
    right += at(1.2) <= at(-1.2) ? 1 : 0;
  }
  QVERIFY2(right > 0.85 * all, qPrintable(QStringLiteral("%1 of %2").arg(right).arg(all)));
}

void IsosurfaceGeometryTest::the_newest_value_wins() {
  const SampleProject sample("faulted", {64, 64, 128});
  const project::Project project = sample.open();
  Answers answers;
  IsosurfaceMaker maker(answers.events());
  for (int n = 0; n < 60; ++n) maker.want({request_of(project, 0.2 + 0.005 * n)});
  const double last = 0.2 + 0.005 * 59;
  QTRY_VERIFY_WITH_TIMEOUT(
      [&] {
        const std::scoped_lock lock(answers.mutex);
        return !answers.shapes.empty() && answers.shapes.back()->value == last;
      }(),
      30'000);
  QVERIFY(answers.count() < 30);  // most were overtaken
  QVERIFY(answers.failures.empty());
}

void IsosurfaceGeometryTest::too_many_triangles_are_refused() {
  const SampleProject sample;
  const project::Project project = sample.open();
  Answers answers;
  IsosurfaceMaker maker(answers.events(), 500);
  maker.want({request_of(project, 0.0)});
  QTRY_COMPARE(answers.count(), std::size_t{1});
  QCOMPARE(answers.failures.size(), std::size_t{1});
  QVERIFY(answers.failures[0].find("500 triangles") != std::string::npos);
  // A volume that is gone is told, too.
  std::filesystem::remove(request_of(project, 0.1).path);
  Answers gone;
  IsosurfaceMaker other(gone.events());
  other.want({request_of(project, 0.1)});
  QTRY_COMPARE(gone.failures.size(), std::size_t{1});
}

void IsosurfaceGeometryTest::the_scene_shows_and_picks_it() {
  MadeScene scene;
  QVERIFY(scene.settle());
  QCOMPARE(purple(scene.grabbed("without_triangles")), 0);
  const Id id = scene.bench.display.add_isosurface(scene.bench.display.volume(), 0.4);
  show_as_triangles(scene, id);
  QVERIFY(scene.settle());
  const QImage shown = scene.grabbed("triangles");
  const int seen = purple(shown);
  QVERIFY2(seen > 3000, qPrintable(QString::number(seen)));
  // What is picked is what is seen there: in front of all else, and nowhere else.
  int picked = 0, wrong = 0;
  for (int y = 20; y < 690; y += 9) {
    for (int x = 20; x < 890; x += 9) {
      const SceneView::Under under = scene.view->under(QPointF(x + 0.5, y + 0.5));
      const bool is_it = under.item == Item{.kind = Item::Kind::kIsosurface, .id = id};
      const QColor c = shown.pixelColor(x, y);
      const bool is_purple = c.green() < 20 && c.red() > 90 && std::abs(c.red() - c.blue()) < 12;
      picked += is_it ? 1 : 0;
      wrong += is_it != is_purple ? 1 : 0;
      if (is_it) {
        const auto again = scene.view->pixel_of(under.place);
        QVERIFY(again && std::hypot(again->x() - x - 0.5, again->y() - y - 0.5) < 1.5);
      }
    }
  }
  QVERIFY(picked > 40);
  QVERIFY2(wrong < 0.3 * picked, qPrintable(QStringLiteral("%1 of %2").arg(wrong).arg(picked)));
  // Hovered, here or in the project panel, it has a box around it.
  const auto light_in = [](const QImage& image) {
    int light = 0;
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) light += image.pixelColor(x, y) == QColor(0xd6, 0xda, 0xe0);
    }
    return light;
  };
  scene.bench.selection.hover({.kind = Item::Kind::kIsosurface, .id = id});
  QVERIFY(light_in(scene.grabbed("triangles_hovered")) > light_in(shown) + 100);
  scene.bench.selection.hover({});
  QCOMPARE(light_in(scene.grabbed("triangles_left")), light_in(shown));
  // Another value, another colour, hidden, and as a picture again.
  IsosurfaceLook look = scene.bench.display.isosurfaces().front();
  look.value = 0.8;
  scene.bench.display.change_isosurface(look);
  QVERIFY(!scene.view->is_settled());
  QVERIFY(scene.settle());
  const int less = purple(scene.grabbed("triangles_higher"));
  QVERIFY(less > 0 && less < seen);
  look.colour = QStringLiteral("#00ff00");
  scene.bench.display.change_isosurface(look);
  QVERIFY(scene.settle());
  QCOMPARE(purple(scene.grabbed("triangles_green")), 0);
  look.colour = QStringLiteral("#ff00ff");
  look.visible = false;
  scene.bench.display.change_isosurface(look);
  QVERIFY(scene.settle());
  QCOMPARE(purple(scene.grabbed("triangles_hidden")), 0);
  look.visible = true;
  look.as_picture = true;
  scene.has_engine = false;
  scene.bench.display.change_isosurface(look);
  QVERIFY(scene.settle());
  QCOMPARE(purple(scene.grabbed("triangles_gone")), 0);
}

void IsosurfaceGeometryTest::the_camera_moves_with_few_triangles() {
  MadeScene scene({64, 64, 128});
  const Id id = scene.bench.display.add_isosurface(scene.bench.display.volume(), 0.1);
  show_as_triangles(scene, id);
  QVERIFY(scene.settle());
  const int seen = purple(scene.grabbed("triangles_still"));
  const SceneCounters before = scene.view->counters();
  QTest::keyClick(scene.view.get(), Qt::Key_Left);
  const int moving = purple(scene.grabbed("triangles_moving"));
  QVERIFY(scene.view->counters().coarse_frames > before.coarse_frames);
  QVERIFY(scene.view->counters().frame_triangles <= 32'000);
  QVERIFY2(moving > seen / 2, qPrintable(QStringLiteral("%1 of %2").arg(moving).arg(seen)));
  QVERIFY(scene.settle());
  QVERIFY(purple(scene.grabbed("triangles_still_again")) > moving / 2);
  QCOMPARE(scene.view->counters().uploads, before.uploads);
}

static const RegisterTest<IsosurfaceGeometryTest> kRegistered;

}  // namespace footwall::ui

#include "isosurface_geometry_test.moc"
