// 200 faults with a million triangles: what a mouse move draws, and that it does not grow with the scene.
#include <QElapsedTimer>
#include <QTest>
#include <ctime>

#include "ui/scene/made_scene.h"
#include "ui/test_class.h"

namespace footwall::ui {

class SpeedTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void a_mouse_move_draws_what_moves();
};

void SpeedTest::a_mouse_move_draws_what_moves() {
  MadeScene scene({48, 40, 64}, 50, 25);
  add_many_faults(scene.bench.document, 200);
  const auto [all, triangles] = scene.remake_all();
  QVERIFY(triangles > 1'000'000);
  Q_EMIT scene.bench.surfaces.surfaces_changed(all);
  const Fault edited = scene.bench.document.faults().back();
  scene.bench.selection.set_active_fault(edited.record.id);
  const Id id = edited.record.id;
  QVERIFY(scene.settle());
  scene.grabbed("million");
  scene.view->reset_counters();  // without the driver's compiling of each shader
  const SceneCounters& counters = scene.view->counters();
  // Drawn at once, and read back, which a window does not.
  const auto frame_ms = [&] {
    QElapsedTimer clock;
    clock.start();
    scene.view->grab_frame();
    return static_cast<double>(clock.nsecsElapsed()) / 1e6;
  };

  auto cpu_ms = [last = std::clock()]() mutable {
    const std::clock_t now = std::clock();
    return 1e3 * static_cast<double>(now - std::exchange(last, now)) / CLOCKS_PER_SEC;
  };
  const std::uint64_t layers = counters.layers;
  const std::uint64_t uploads = counters.uploads;
  std::vector<double> drags;
  for (int n = 0; n < 20; ++n) {
    std::vector<survey::Pillar> pillars = edited.pillars;
    pillars[1].nodes[1].position.x += 2.0 * n;
    scene.bench.document.show_provisionally(id, pillars);
    scene.remake(id);
    Q_EMIT scene.bench.surfaces.surfaces_changed({id});
    drags.push_back(frame_ms());
    QVERIFY(counters.frame_triangles <= scene.surfaces[id]->faces.size());
    QCoreApplication::processEvents();
  }
  QCOMPARE(counters.layers, layers);
  QCOMPARE(counters.uploads, uploads + 20);
  scene.grabbed("million_dragged");
  scene.bench.document.end_provisional();

  const auto drag_cpu = cpu_ms() / static_cast<double>(drags.size());
  std::vector<double> turns;
  const std::uint64_t coarse = counters.coarse_frames;
  cpu_ms();
  for (int n = 0; n < 12; ++n) {
    QTest::keyClick(scene.view.get(), Qt::Key_Right);
    const std::uint64_t frames = counters.frames;
    turns.push_back(frame_ms());
    QVERIFY(counters.frames > frames);
    QVERIFY(counters.frame_triangles <= 20'000);
    QVERIFY(counters.frame_triangles > 5'000);
  }
  const auto turn_cpu = cpu_ms() / static_cast<double>(turns.size());
  QVERIFY2(counters.coarse_frames >= coarse + 12,
           qPrintable(QString::number(counters.coarse_frames - coarse)));
  scene.grabbed("million_turned");
  QElapsedTimer clock;
  clock.start();
  QVERIFY(scene.settle());
  const auto settled = clock.elapsed();
  QVERIFY(counters.layers > layers);
  scene.grabbed("million_settled");
  clock.restart();
  int hits = 0;
  for (int n = 0; n < 1000; ++n) {
    if (scene.view->under(QPointF(150 + n % 40 * 15, 150 + n / 40 * 15)).hit) ++hits;
  }
  QVERIFY(hits > 50);
  const double pick_ms = static_cast<double>(clock.nsecsElapsed()) / 1e9;
  // A box over a half of all.
  QTest::mousePress(scene.view.get(), Qt::LeftButton, {}, QPoint(3, 3));
  QTest::mouseMove(scene.view.get(), QPoint(300, 300));
  QTest::mouseMove(scene.view.get(), QPoint(450, 690));
  clock.restart();
  cpu_ms();
  QTest::mouseRelease(scene.view.get(), Qt::LeftButton, {}, QPoint(450, 690));
  const double box_ms = static_cast<double>(clock.nsecsElapsed()) / 1e6;
  const double box_cpu = cpu_ms();
  const Selection& selection = scene.bench.selection;
  QVERIFY(!selection.faults().empty() || !selection.pillars().empty() || !selection.nodes().empty());
  std::ranges::sort(drags);
  std::ranges::sort(turns);
  qInfo("%zu triangles: drag frame median %.1f ms, longest %.1f; coarse frame median %.1f ms, longest %.1f",
        triangles, drags[drags.size() / 2], drags.back(), turns[turns.size() / 2], turns.back());
  qInfo("processor time of all threads: a drag with its surface made %.1f ms, a coarse frame %.1f ms",
        drag_cpu, turn_cpu);
  qInfo("a box: %zu faults, %zu pillars, %zu nodes in %.1f ms, %.1f ms of processor time",
        selection.faults().size(), selection.pillars().size(), selection.nodes().size(), box_ms, box_cpu);
  qInfo("whole again after %lld ms, longest slice %.1f ms; what is under a pixel %.2f ms", settled,
        counters.longest_slice_ms, pick_ms);
}

static const RegisterTest<SpeedTest> kRegistered;

}  // namespace footwall::ui

#include "speed_test.moc"
