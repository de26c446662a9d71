// What one waits for in the scene with 200 faults of a million triangles: a frame while a node is dragged,
// one while the camera moves, and until all is drawn again. Each frame is checked to draw what it should.
// Needs a screen:
//   python3 tests/ui/on_a_screen.py build/release/bin/bench_scene [WIDTH HEIGHT]
#include <fmt/format.h>

#include <QApplication>
#include <QElapsedTimer>
#include <QTest>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "storage/base/error.h"
#include "ui/scene/made_scene.h"

namespace {

using namespace footwall::ui;

constexpr int kFaults = 200;
constexpr int kDrags = 200;
constexpr int kTurns = 60;

void print(const char* what, std::vector<double> ms) {
  std::ranges::sort(ms);
  fmt::print("{:<34} median {:7.1f}   95 % {:7.1f}   worst {:7.1f} ms\n", what, ms[ms.size() / 2],
             ms[ms.size() * 95 / 100], ms.back());
}

// Of all threads of this process: what a machine that does nothing else would need, shared by its cores.
double processor_ms() {
  return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

double milliseconds(const QElapsedTimer& clock) {
  return static_cast<double>(clock.nsecsElapsed()) * 1e-6;
}

// Until it is painted, as events come.
double frame_ms(SceneView& view) {
  const std::uint64_t frames = view.counters().frames;
  QElapsedTimer clock;
  clock.start();
  view.update();
  footwall::require(QTest::qWaitFor([&] { return view.counters().frames > frames; }, 10'000), "a frame");
  return milliseconds(clock);
}

void measure_drags(MadeScene& scene) {
  const Fault edited = scene.bench.document.faults().back();
  const Id id = edited.record.id;
  scene.bench.selection.set_active_fault(id);
  footwall::require(scene.settle(), "a scene that is drawn");
  const SceneCounters before = scene.view->counters();
  const double processor = processor_ms();
  std::vector<double> frames;
  for (int n = 0; n < kDrags; ++n) {
    std::vector<footwall::survey::Pillar> pillars = edited.pillars;
    pillars[1].nodes[1].position.x += 0.5 * n;
    scene.bench.document.show_provisionally(id, pillars);
    scene.remake(id);
    Q_EMIT scene.bench.surfaces.surfaces_changed({id});
    frames.push_back(frame_ms(*scene.view));
    footwall::require(scene.view->counters().frame_triangles == scene.surfaces[id]->faces.size(),
                      "the dragged fault alone");
  }
  footwall::require(scene.view->counters().layers == before.layers, "no layer for a drag");
  footwall::require(scene.view->counters().uploads == before.uploads + kDrags, "an upload each");
  scene.bench.document.end_provisional();
  print("drag frame", frames);
  fmt::print("{:<34} {:14.1f} ms of processor time, its surface made anew\n", "",
             (processor_ms() - processor) / kDrags);
}

void measure_turns(MadeScene& scene, const std::string& name) {
  footwall::require(scene.settle(), "a scene that is drawn");
  scene.view->reset_counters();
  const double processor = processor_ms();
  std::vector<double> frames;
  for (int n = 0; n < kTurns; ++n) {
    QTest::keyClick(scene.view.get(), Qt::Key_Right);
    frames.push_back(frame_ms(*scene.view));
    footwall::require(scene.view->counters().frame_triangles <= 32'000, "few triangles");
  }
  footwall::require(scene.view->counters().coarse_frames >= kTurns, "coarse frames");
  const double used = (processor_ms() - processor) / kTurns;
  scene.view->reset_counters();
  QElapsedTimer clock;
  clock.start();
  footwall::require(scene.settle(), "a scene that is drawn");
  footwall::require(scene.view->counters().layers > 0, "a layer of all");
  print((name + ": frame while turning").c_str(), frames);
  fmt::print("{:<34} {:14.1f} ms of processor time\n", "", used);
  fmt::print("{:<34} {:14.0f} ms, longest slice {:.1f} ms\n", name + ": until fine", milliseconds(clock),
             scene.view->counters().longest_slice_ms);
}

// A surface as it comes from other programs: all of it at once.
void measure_one_large(const QSize& size) {
  MadeScene scene({48, 40, 64}, 2, 2);
  add_many_faults(scene.bench.document, 1);
  const Id id = scene.bench.document.faults().back().record.id;
  scene.view->resize(size);
  footwall::require(scene.settle(), "a scene that is drawn");
  scene.remake(id, 500, 500);
  fmt::print("one fault, {} triangles\n", scene.surfaces[id]->faces.size());
  scene.view->reset_counters();
  QElapsedTimer clock;
  clock.start();
  Q_EMIT scene.bench.surfaces.surfaces_changed({id});
  footwall::require(scene.settle(), "a scene that is drawn");
  footwall::require(scene.view->counters().uploads > 0, "an upload");
  fmt::print("{:<34} {:14.0f} ms, longest slice {:.1f} ms\n", "until it is drawn", milliseconds(clock),
             scene.view->counters().longest_slice_ms);
  std::vector<double> hovers;
  for (int n = 0; n < kTurns; ++n) {
    clock.start();
    QTest::mouseMove(scene.view.get(), {size.width() / 2 + n, size.height() / 2});
    hovers.push_back(milliseconds(clock));
  }
  print("the mouse over it", hovers);
  clock.start();
  scene.bench.selection.select({.kind = Item::Kind::kFault, .id = id});
  std::vector<double> frames{milliseconds(clock)};
  while (!scene.view->is_settled()) frames.push_back(frame_ms(*scene.view));
  print("frame while it is selected", frames);
  measure_turns(scene, "one large");
}

void measure(const QSize& size) {
  MadeScene scene({48, 40, 64}, 50, 25);
  add_many_faults(scene.bench.document, kFaults);
  const auto [all, triangles] = scene.remake_all();
  scene.view->resize(size);
  fmt::print("{} faults, {} triangles, {} x {} pixels\n", scene.bench.document.faults().size(), triangles,
             size.width(), size.height());
  QElapsedTimer clock;
  clock.start();
  Q_EMIT scene.bench.surfaces.surfaces_changed(all);
  fmt::print("{:<34} {:14.0f} ms\n", "first frame after opening", frame_ms(*scene.view));
  footwall::require(scene.settle(), "a scene that is drawn");
  fmt::print("{:<34} {:14.0f} ms, longest slice {:.1f} ms\n", "all of it after opening", milliseconds(clock),
             scene.view->counters().longest_slice_ms);
  measure_drags(scene);
  measure_turns(scene, "statistic");
  FaceLook look = scene.bench.display.faces();
  look.colours = FaceColours::kVoxels;
  scene.bench.display.set_faces(look);
  measure_turns(scene, "voxel values");
  look.colours = FaceColours::kPlain;
  scene.bench.display.set_faces(look);
  IsosurfaceLook isosurface{
      .id = scene.bench.display.add_isosurface(scene.bench.document.volumes().front().id, 0.2),
      .volume = scene.bench.document.volumes().front().id,
      .value = 0.2};
  isosurface.as_picture = false;
  scene.bench.display.change_isosurface(isosurface);
  measure_turns(scene, "with an isosurface");
}

}  // namespace

int main(int argc, char** argv) {
  const QApplication application(argc, argv);
  try {
    const QSize size = argc > 2 ? QSize(std::atoi(argv[1]), std::atoi(argv[2])) : QSize(900, 700);
    measure(size);
    measure_one_large(size);
  } catch (const footwall::Error& error) {
    return fmt::print(stderr, "{}\n", error.message()), 1;
  }
  return 0;
}
