#include <QSignalSpy>
#include <QTest>

#include "ui/made_runs.h"
#include "ui/scene/made_scene.h"
#include "ui/scene3d/panels.h"
#include "ui/test_class.h"

namespace footwall::ui {
namespace {

std::size_t differing(const QImage& a, const QImage& b, int tolerance = 24) {
  std::size_t count = 0;
  for (int y = 0; y < std::min(a.height(), b.height()); ++y) {
    for (int x = 0; x < std::min(a.width(), b.width()); ++x) {
      const QRgb p = a.pixel(x, y);
      const QRgb q = b.pixel(x, y);
      const int most = std::max(
          {std::abs(qRed(p) - qRed(q)), std::abs(qGreen(p) - qGreen(q)), std::abs(qBlue(p) - qBlue(q))});
      if (most > tolerance) ++count;
    }
  }
  return count;
}

}  // namespace

class SceneTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void shows_faults_planes_and_box();
  void says_how_old_colours_are();
  void shows_a_stored_run_and_now_again();
  void the_colour_bar_names_the_run();
  void merges_pictures_by_depth();
  void drops_pictures_of_another_camera();
  void exports_in_tiles();
  void exaggerates_without_uploads();
  void rests_when_nothing_happens();
  void survives_another_window();
  void forgets_deleted_faults();
  void shows_the_light_theme_and_no_survey();
  void the_screen_has_what_is_drawn();
};

void SceneTest::shows_faults_planes_and_box() {
  MadeScene scene;
  QVERIFY(scene.settle());
  QCOMPARE(scene.view->problem(), QString());
  const QImage all = scene.grabbed("scene");
  scene.bench.display.set_visible({.kind = Item::Kind::kFault, .id = scene.first_fault()}, false);
  QVERIFY(scene.settle());
  QVERIFY(differing(all, scene.grabbed("one_hidden")) > 3000);
}

void SceneTest::says_how_old_colours_are() {
  MadeScene scene;
  QVERIFY(scene.settle());
  const QImage fresh = scene.grabbed("fresh");
  const auto show = [&](Freshness state, const QString& name) {
    scene.freshness = state;
    Q_EMIT scene.bench.surfaces.numbers_changed({scene.first_fault()});
    const bool good = scene.settle();
    return good ? scene.grabbed(name) : QImage();
  };
  const QImage stale = show(Freshness::kStale, "stale");
  const QImage plain = show(Freshness::kPlain, "plain");
  QVERIFY(differing(fresh, stale) > 5000);
  QVERIFY(differing(stale, plain) > 5000);
  const auto following = std::make_shared<FaceNumbers>(*scene.numbers[scene.first_fault()]);
  following->stale.assign(following->values.size(), 1);
  scene.numbers[scene.first_fault()] = following;
  QVERIFY(differing(fresh, show(Freshness::kFollowing, "following"), 8) > 3000);
  QCOMPARE(differing(fresh, show(Freshness::kFresh, "still_marked"), 8) > 3000, true);  // each face says so
}

void SceneTest::shows_a_stored_run_and_now_again() {
  const SampleProject sample;
  Workbench bench(sample.open(), {});
  while (!bench.display.sections().empty()) bench.display.remove_section(bench.display.sections().front().id);
  QVERIFY(has_surfaces(bench));
  const Id low = add_made_run(bench, "low", [](std::size_t) { return 0.1; });
  const Id none = add_made_run(bench, "none", [](std::size_t) { return std::nan(""); });
  add_made_run(bench, "now", [](std::size_t) { return 0.9; });
  Q_EMIT bench.document.runs_changed();
  FaceLook look = bench.display.faces();
  look.low = 0;
  look.high = 1;
  bench.display.set_faces(look);
  SceneView view(bench);
  view.setPalette(MadeScene::dark());
  view.resize(900, 700);
  view.show();
  const Id fault = bench.document.faults().front().record.id;
  QTRY_VERIFY(bench.surfaces.numbers(fault, QStringLiteral("variance")) != nullptr);
  const auto shown = [&](Id run) {
    bench.display.show_run(run);
    const bool there = QTest::qWaitFor(
        [&] { return !bench.shown_numbers.is_reading() && bench.surfaces.is_settled() && view.is_settled(); },
        30000);
    return there ? view.grab_frame().convertToFormat(QImage::Format_RGB32) : QImage();
  };
  const QImage now = shown(0);
  const QImage of_low = shown(low);
  const QImage of_none = shown(none);
  QVERIFY(differing(now, of_low) > 5000);
  QVERIFY(differing(of_low, of_none) > 5000);
  QVERIFY(differing(now, of_none) > 5000);
  QVERIFY(differing(now, shown(0)) < 200);
}

void SceneTest::the_colour_bar_names_the_run() {
  ColourBar bar;
  bar.title = QStringLiteral("variance");
  bar.unit = QStringLiteral("amplitude²");
  bar.colours = &render::ColourMap::named("viridis");
  QCOMPARE(lines_above(bar), QStringList("fresh, amplitude²"));
  const SceneColours colours;
  const QImage fresh = colour_bar_image(bar, colours, QFont(), 1);
  bar.run = {QStringLiteral("run base"), QStringLiteral("2026-11-23 14:02"), QStringLiteral("of edges")};
  for (const Freshness state : {Freshness::kKept, Freshness::kStale, Freshness::kPlain}) {
    bar.state = state;
    const QString all = lines_above(bar).join(u'|');
    QVERIFY(all.startsWith(QStringLiteral("run base, amplitude²|2026-11-23 14:02|of edges")));
    QCOMPARE(all.contains(QStringLiteral("moved since")), state == Freshness::kStale);
    QVERIFY(!all.contains(QStringLiteral("fresh")) && !all.contains(QStringLiteral("following")));
  }
  bar.state = Freshness::kKept;
  QVERIFY(colour_bar_image(bar, colours, QFont(), 1).height() > fresh.height());  // has room for the lines
  bar.run.front() = QString(200, u'n');
  QVERIFY(colour_bar_image(bar, colours, QFont(), 1).width() < 300);
  bar.not_computed = 2;
  QCOMPARE(line_below(bar), QStringLiteral("2 faults not in this run"));
  bar.missing = QStringLiteral("is being read");  // they may be in it
  QCOMPARE(line_below(bar), QStringLiteral("is being read"));
  bar.state = Freshness::kPlain;
  bar.missing = QStringLiteral("not in this run");
  QCOMPARE(line_below(bar), QStringLiteral("not in this run"));
}

void SceneTest::merges_pictures_by_depth() {
  MadeScene scene;
  QVERIFY(scene.settle());
  const QImage bare = scene.grabbed("without_isosurface");
  scene.bench.display.add_isosurface(scene.bench.display.volume(), 1);
  QVERIFY(scene.pictures > 0);
  QCOMPARE(scene.asked.width, 900);
  QCOMPARE(scene.asked.isosurfaces.size(), std::size_t{1});
  // A line at the top tells that a picture is on its way.
  const QColor accent(0x4a, 0xa3, 0xdf);
  QVERIFY(scene.settle());
  QCOMPARE(scene.grabbed("waiting").pixelColor(2, 0), accent);
  // A picture of one colour, with depths as the engine would send them.
  const auto picture = std::make_shared<Picture>();
  picture->request = scene.pictures;
  picture->colours = QImage(900, 700, QImage::Format_RGBA8888);
  picture->colours.fill(QColor(255, 0, 255));
  picture->depths.assign(900 * 700, 1.0F);
  const auto& m = scene.asked.view_projection;
  const auto window_depth = [&](const survey::IndexPoint& p) {
    const auto& iso = scene.asked.isosurfaces[0];
    const std::array<double, 3> index{p.i, p.j, p.k};
    std::array<double, 4> at{0, 0, 0, 1};
    for (std::size_t n = 0; n < 3; ++n) {
      at[n] = iso.shift[n] + iso.linear[3 * n] * index[0] + iso.linear[3 * n + 1] * index[1] +
              iso.linear[3 * n + 2] * index[2];
    }
    double z = 0, w = 0;
    for (std::size_t n = 0; n < 4; ++n) {
      z += m[8 + n] * at[n];
      w += m[12 + n] * at[n];
    }
    return 0.5 + 0.5 * z / w;
  };
  // Left half: at the survey's middle; right half: before everything; a row behind everything.
  const auto middle = static_cast<float>(window_depth({23.5, 19.5, 31.5}));
  for (int y = 200; y < 500; ++y) {
    for (int x = 200; x < 700; ++x) {
      picture->depths[static_cast<std::size_t>(y * 900 + x)] = x < 450 ? middle : y < 350 ? 0.0F : 0.99999F;
    }
  }
  picture->last = true;
  Q_EMIT scene.bench.engine.picture(picture);
  QVERIFY(scene.settle());
  const QImage merged = scene.grabbed("isosurface");
  QVERIFY(merged.pixelColor(2, 0) != accent);
  const auto is_iso = [&](int x, int y) { return merged.pixelColor(x, y) == QColor(255, 0, 255); };
  int wrong = 0, before = 0, behind = 0;
  for (int y = 203; y < 497; y += 2) {
    for (int x = 203; x < 697; x += 2) {
      if (std::abs(x - 450) < 3 || std::abs(y - 350) < 3) continue;
      const SceneView::Under under = scene.view->under(QPointF(x + 0.5, y + 0.5));
      if (x >= 450) {
        // Nothing hides what is nearest; what is farthest shows where nothing else is.
        if (y < 350 && !is_iso(x, y)) ++wrong;
        if (y > 350 && under.hit && is_iso(x, y)) ++wrong;
        continue;
      }
      if (!under.hit || under.item.kind == Item::Kind::kNode || under.item.kind == Item::Kind::kPillar)
        continue;
      const double depth = window_depth(under.place);
      if (std::abs(depth - middle) < 1e-3) continue;
      depth < middle ? ++before : ++behind;
      if (is_iso(x, y) == (depth < middle)) ++wrong;
    }
  }
  QVERIFY(before > 100);
  QVERIFY(behind > 100);
  // Lines of the box and of frames lie over some.
  QVERIFY2(wrong < 0.03 * 147 * 247, qPrintable(QString::number(wrong)));
  QVERIFY(bare != merged);
  const auto purple = [](const QImage& image) {
    int count = 0;
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) count += image.pixelColor(x, y) == QColor(255, 0, 255) ? 1 : 0;
    }
    return count;
  };
  // While the camera moves the picture moves along, and goes where no engine can make another.
  const int seen = purple(merged);
  QTest::keyClick(scene.view.get(), Qt::Key_Left);
  const int moving = purple(scene.grabbed("isosurface_moving"));
  QVERIFY2(moving > seen / 3, qPrintable(QString::number(moving)));
  scene.has_engine = false;
  QVERIFY(scene.settle());
  QCOMPARE(purple(scene.grabbed("isosurface_gone")), 0);
}

void SceneTest::drops_pictures_of_another_camera() {
  MadeScene scene;
  QVERIFY(scene.settle());
  scene.bench.display.add_isosurface(scene.bench.display.volume(), 1);
  const std::uint64_t old = scene.pictures;
  scene.view->look(StandardView::kTop);
  QVERIFY(scene.settle());
  QVERIFY(scene.pictures > old);  // asked again, once the camera stands still
  const QImage before = scene.grabbed("top");
  const auto picture = std::make_shared<Picture>();
  picture->request = old;
  picture->colours = QImage(900, 700, QImage::Format_RGBA8888);
  picture->colours.fill(Qt::red);
  picture->depths.assign(900 * 700, 0.0F);
  Q_EMIT scene.bench.engine.picture(picture);
  QVERIFY(scene.settle());
  QCOMPARE(differing(before, scene.grabbed("top_again")), std::size_t{0});
}

void SceneTest::exports_in_tiles() {
  MadeScene scene;
  QVERIFY(scene.settle());
  const QImage shown = scene.grabbed("shown");
  QString problem;
  const QImage twice = scene.view->picture(QSize(1800, 1400), 2, &problem);
  QCOMPARE(problem, QString());
  QCOMPARE(twice.size(), QSize(1800, 1400));
  const QString folder = qEnvironmentVariable("FOOTWALL_PICTURES");
  if (!folder.isEmpty()) twice.save(QDir(folder).filePath("export.png"));
  // The same picture, and no seams at the tiles' ends.
  const auto smaller = [](const QImage& image) {
    return image.scaled(900, 700, Qt::IgnoreAspectRatio, Qt::SmoothTransformation)
        .convertToFormat(QImage::Format_RGB32);
  };
  const std::size_t others = differing(smaller(shown), smaller(twice), 60);
  QVERIFY2(others < 900 * 700 / 40, qPrintable(QString::number(others)));
  QVERIFY(scene.view->picture(QSize(0, 10), 1, &problem).isNull());
  QVERIFY(!problem.isEmpty());
  QVERIFY(!scene.view->export_png("/nowhere/at/all.png", QSize(40, 30), 1, &problem));
  QVERIFY(!problem.isEmpty());
}

void SceneTest::exaggerates_without_uploads() {
  MadeScene scene;
  QVERIFY(scene.settle());
  const std::uint64_t uploads = scene.view->counters().uploads;
  const QImage flat = scene.grabbed("flat");
  scene.bench.display.set_exaggeration(2);
  QVERIFY(scene.settle());
  QVERIFY(differing(flat, scene.grabbed("exaggerated")) > 10000);
  QCOMPARE(scene.view->counters().uploads, uploads);
}

void SceneTest::rests_when_nothing_happens() {
  MadeScene scene;
  QVERIFY(scene.settle());
  QTest::qWait(100);  // the window system's own last requests
  const std::uint64_t frames = scene.view->counters().frames;
  const std::uint64_t triangles = scene.view->counters().triangles;
  QTest::qWait(700);
  QCOMPARE(scene.view->counters().frames, frames);
  QCOMPARE(scene.view->counters().triangles, triangles);
}

void SceneTest::survives_another_window() {
  MadeScene scene;
  QVERIFY(scene.settle());
  const QImage before = scene.grabbed("before_move");
  QWidget other;
  other.resize(1000, 800);
  scene.view->setParent(&other);
  scene.view->setGeometry(20, 20, 900, 700);
  other.show();
  scene.view->show();
  const bool settled = scene.settle();
  const QImage after = scene.grabbed("after_move");
  scene.view->setParent(nullptr);  // the window must not take it along
  QVERIFY(settled);
  QVERIFY(differing(before, after) < 200);
}

void SceneTest::forgets_deleted_faults() {
  MadeScene scene;
  QVERIFY(scene.settle());
  const QImage before = scene.grabbed("before_delete");
  const Id gone = scene.first_fault();
  scene.bench.document.edit("Delete", [&](project::Interpretation& now) { now.delete_fault(gone); });
  QVERIFY(scene.settle());
  QVERIFY(differing(before, scene.grabbed("deleted")) > 3000);
  for (int y = 20; y < 700; y += 13) {
    for (int x = 20; x < 900; x += 13)
      QVERIFY(scene.view->under(QPointF(x, y)).item.id != gone ||
              scene.view->under(QPointF(x, y)).item.kind != Item::Kind::kFace);
  }
  scene.bench.document.undo();
  QVERIFY(scene.settle());
  QVERIFY(differing(before, scene.grabbed("undone")) < 200);
}

void SceneTest::shows_the_light_theme_and_no_survey() {
  MadeScene scene;
  QVERIFY(scene.settle());
  const QImage dark = scene.grabbed("dark");
  QPalette light;
  light.setColor(QPalette::Window, QColor(0xf4, 0xf5, 0xf7));
  light.setColor(QPalette::WindowText, QColor(0x23, 0x27, 0x2e));
  light.setColor(QPalette::Highlight, QColor(0x1f, 0x78, 0xb4));
  scene.view->setPalette(light);
  QVERIFY(scene.settle());
  QVERIFY(scene.grabbed("light").pixelColor(4, 4).lightness() > 220);
  QVERIFY(dark.pixelColor(4, 4).lightness() < 60);

  QTemporaryDir folder;
  const auto path = std::filesystem::path(folder.path().toStdString()) / "empty.footwall";
  Workbench bench(project::Project::create(path, std::nullopt), {});
  SceneView view(bench);
  view.setPalette(MadeScene::dark());
  view.resize(500, 400);
  view.show();
  QVERIFY(QTest::qWaitFor([&] { return view.is_settled(); }, 20000));
  const QImage empty = view.grab_frame().convertToFormat(QImage::Format_RGB32);
  const QString pictures = qEnvironmentVariable("FOOTWALL_PICTURES");
  if (!pictures.isEmpty()) empty.save(QDir(pictures).filePath("empty.png"));
  QImage background(empty.size(), QImage::Format_RGB32);
  background.fill(empty.pixelColor(250, 200));
  QVERIFY(differing(empty, background, 60) > 100);  // it says what to do
}

// The inner window shows the scene, also after another size, and a picture of the widget has it, too; the box
// under the mouse lies over it.
void SceneTest::the_screen_has_what_is_drawn() {
  MadeScene scene;
  SceneView& view = *scene.view;
  const auto on_screen = [&] {
    QTest::qWait(100);  // until the server has put it there
    const QPoint corner = view.mapToGlobal(QPoint(0, 0));
    return view.screen()
        ->grabWindow(0, corner.x(), corner.y(), view.width(), view.height())
        .toImage()
        .convertToFormat(QImage::Format_RGB32);
  };
  for (const QSize& size : {QSize(900, 700), QSize(640, 500)}) {
    view.resize(size);
    QTest::qWait(50);
    QVERIFY(scene.settle());
    const QImage drawn = scene.grabbed("drawn");
    QCOMPARE(drawn.size(), size);
    QVERIFY(differing(on_screen(), drawn) < 50);
    QVERIFY(differing(view.grab().toImage().convertToFormat(QImage::Format_RGB32), drawn) < 50);
  }
  const QImage before = on_screen();
  QTest::mousePress(&view, Qt::LeftButton, {}, {4, 4});
  QTest::mouseMove(&view, {60, 50});
  QTest::mouseMove(&view, {204, 104});
  const QImage with_box = on_screen();
  QVERIFY(before.pixel(120, 60) != with_box.pixel(120, 60));
  QCOMPARE(before.pixel(400, 300), with_box.pixel(400, 300));
  QTest::mouseRelease(&view, Qt::LeftButton, {}, {204, 104});
  QVERIFY(scene.settle());
  QVERIFY(differing(before, on_screen()) < 50);
}

static const RegisterTest<SceneTest> kRegistered;

}  // namespace footwall::ui

#include "scene_test.moc"
