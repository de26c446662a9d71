// A node dragged in a section of the whole window, with an engine: how long until its triangles are painted
// in their new colours, what memory 10^4 moves cost, and how long the window takes to open. First the colours
// after a drag are compared with those of a run. Needs a screen:
//   python3 tests/ui/on_a_screen.py build/release/bin/bench_drag PROJECT [MOVES]
#include <fmt/format.h>
#include <sys/resource.h>

#include <QApplication>
#include <QElapsedTimer>
#include <QEventLoop>
#include <QMouseEvent>
#include <QTest>
#include <QTimer>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <vector>

#include "engine/service/client/engine_client.h"
#include "engine/tasks/extract_run.h"
#include "storage/base/error.h"
#include "ui/scene3d/scene_view.h"
#include "ui/section/section_view.h"
#include "ui/window/main_window.h"
#include "ui/window/view_area.h"
#include "ui/window/view_tile.h"

namespace {

using namespace footwall::ui;
using footwall::require;

constexpr int kPatience = 120000;
constexpr int kSingleMoves = 200;

double ms_of(const QElapsedTimer& timer) {
  return static_cast<double>(timer.nsecsElapsed()) * 1e-6;
}

void print(const char* what, std::vector<double> ms) {
  std::ranges::sort(ms);
  fmt::print("{:<38} median {:6.1f}   95 % {:6.1f}   worst {:6.1f} ms  ({})\n", what, ms[ms.size() / 2],
             ms[ms.size() * 95 / 100], ms.back(), ms.size());
}

// Resident bytes of a process, in MiB.
double resident(const std::string& process) {
  std::ifstream file("/proc/" + process + "/statm");
  double total = 0, pages = 0;
  file >> total >> pages;
  return pages * 4096 / (1 << 20);
}

// A hand on the middle node of a fault's middle pillar.
class Hand {
 public:
  explicit Hand(MainWindow& window) : window_(window), bench_(*window.workbench()) {
    const Fault& fault = bench_.document.faults().front();
    fault_ = fault.record.id;
    const auto& pillar = fault.pillars[fault.pillars.size() / 2];
    const auto& node = pillar.nodes[pillar.nodes.size() / 2];
    place_ = bench_.document.survey()->index_of(node.position);
    const auto& shown = bench_.display.sections();
    const auto inlines = std::ranges::find_if(
        shown, [](const auto& one) { return one.section.kind == Section::Kind::kInline; });
    require(inlines != shown.end(), "a view of an inline");
    section_ = inlines->section;
    section_.index = std::llround(place_.i);
    bench_.display.move_section(inlines->id, section_);
    for (SectionCanvas* one : window.findChildren<SectionCanvas*>()) {
      if (one->section() == section_) canvas_ = one;
    }
    require(canvas_ != nullptr, "a view of that inline");
    scene_ = qobject_cast<SceneView*>(window.views()->scene()->view());
    require(scene_ != nullptr, "a scene");
    bench_.picking.set_tool(Tool::kPick);
  }

  Id fault() const { return fault_; }
  SceneView& scene() const { return *scene_; }
  bool is_fresh() const {
    return bench_.surfaces.is_settled() && bench_.surfaces.freshness(fault_, "variance") == Freshness::kFresh;
  }
  void press() { send(QEvent::MouseButtonPress, {0, 0}, Qt::LeftButton); }
  // To `aside` voxels from where the node stood.
  void move(const QPointF& aside) { send(QEvent::MouseMove, aside, Qt::NoButton); }
  void release(const QPointF& aside) { send(QEvent::MouseButtonRelease, aside, Qt::LeftButton); }

 private:
  void send(QEvent::Type type, const QPointF& aside, Qt::MouseButton button) {
    const PlanePoint at = plane_of(section_, place_);
    const QPointF pixel = canvas_->view().to_pixels({at.u + aside.x(), at.v + aside.y()});
    const auto held = type == QEvent::MouseButtonRelease ? Qt::NoButton : Qt::LeftButton;
    QMouseEvent event(type, pixel, canvas_->mapToGlobal(pixel), button, held, Qt::NoModifier);
    QApplication::sendEvent(canvas_, &event);
  }

  MainWindow& window_;
  Workbench& bench_;
  Id fault_ = 0;
  footwall::survey::IndexPoint place_;
  Section section_;
  SectionCanvas* canvas_ = nullptr;
  SceneView* scene_ = nullptr;
};

// The program's own loop of events: qWaitFor looks at its condition every 10 ms only, and sleeps between.
bool wait_in_loop(QEventLoop& loop) {
  QTimer late;
  late.setSingleShot(true);
  QObject::connect(&late, &QTimer::timeout, &loop, &QEventLoop::quit);
  late.start(kPatience);
  loop.exec();
  return late.isActive();
}

// To and fro, no place twice in a row.
QPointF swing(int n) {
  return {2.5 + 2 * std::sin(n * 0.37), 1.5 * std::cos(n * 0.23)};
}

void open(MainWindow& window, const QString& project) {
  QElapsedTimer timer;
  timer.start();
  require(window.open_project(project), "a project that opens");
  const auto has_samples = [&] {
    const auto canvases = window.findChildren<SectionCanvas*>();
    return std::ranges::all_of(canvases, [](const SectionCanvas* canvas) {
      return canvas->samples() && canvas->samples()->section == canvas->section();
    });
  };
  require(QTest::qWaitFor(has_samples, kPatience), "samples in every section");
  for (SectionCanvas* canvas : window.findChildren<SectionCanvas*>()) canvas->repaint();
  fmt::print("{:<38} {:6.0f} ms\n", "opened, its sections painted", ms_of(timer));
}

// So that the next run finds the same project.
void take_back(Workbench& bench) {
  require(bench.document.undo(), "a drag that can be taken back");
}

// After a drag, colours are those of a run.
void check(MainWindow& window, Hand& hand) {
  Workbench& bench = *window.workbench();
  hand.press();
  for (int n = 0; n < 30; ++n) {
    hand.move(swing(n));
    QCoreApplication::processEvents();
  }
  hand.release(swing(29));
  require(QTest::qWaitFor([&] { return hand.is_fresh(); }, kPatience), "fresh colours after a drag");
  const auto numbers = bench.surfaces.numbers(hand.fault(), "variance");
  const auto run = footwall::tasks::extract_run(bench.document.store(), {}, {});
  const auto expected = bench.document.project().fault_statistics(run.run, hand.fault());
  const std::vector<double>& values = expected.statistics.at("variance");
  require(values.size() == numbers->values.size(), "as many faces as a run has");
  for (std::size_t f = 0; f < values.size(); ++f) {
    require(values[f] == numbers->values[f] || (std::isnan(values[f]) && std::isnan(numbers->values[f])),
            "the numbers of a run");
  }
  bench.document.store().delete_run(run.run);
  take_back(bench);
  require(QTest::qWaitFor([&] { return hand.is_fresh(); }, kPatience), "fresh colours after an undo");
  fmt::print("{} faces, as a run has them\n", values.size());
}

// Of this process, on all its threads: the window's, the triangulation's and those that draw.
double processor_ms() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto ms = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_usec) * 1e-3;
  };
  return ms(usage.ru_utime) + ms(usage.ru_stime);
}

// Each move waits for its own colours on the screen.
void measure_latency(MainWindow& window, Hand& hand) {
  Workbench& bench = *window.workbench();
  bool answered = false;
  QEventLoop loop;
  const auto a = QObject::connect(&bench.surfaces, &Surfaces::numbers_changed,
                                  [&] { answered = answered || bench.surfaces.is_settled(); });
  const auto b = QObject::connect(&hand.scene(), &GlWidget::frame_shown, [&] {
    if (answered) loop.quit();
  });
  std::vector<double> whole, handled, surfaced, numbered;
  QElapsedTimer since;
  const auto c = QObject::connect(&bench.surfaces, &Surfaces::surfaces_changed,
                                  [&] { surfaced.push_back(ms_of(since)); });
  const auto d = QObject::connect(&bench.surfaces, &Surfaces::numbers_changed,
                                  [&] { numbered.push_back(ms_of(since)); });
  hand.press();
  const std::uint64_t frames = hand.scene().counters().frames;
  const double processor = processor_ms();
  for (int n = 0; n < kSingleMoves; ++n) {
    QElapsedTimer timer;
    timer.start();
    answered = false;
    since.start();
    hand.move(swing(n));
    handled.push_back(ms_of(timer));
    require(wait_in_loop(loop), "a frame with the answered colours");
    whole.push_back(ms_of(timer));
  }
  fmt::print("{:<38} {:.1f} frames of the scene, {:.1f} ms of processors\n", "a move costs",
             static_cast<double>(hand.scene().counters().frames - frames) / kSingleMoves,
             (processor_ms() - processor) / kSingleMoves);
  QObject::disconnect(a);
  QObject::disconnect(b);
  hand.release(swing(kSingleMoves - 1));
  take_back(bench);
  QObject::disconnect(c);
  QObject::disconnect(d);
  print("a move handled", handled);
  print("  its surface", surfaced);
  print("  its numbers", numbered);
  print("a move to recoloured triangles", whole);
}

void measure_memory(MainWindow& window, Hand& hand, int moves) {
  const auto status = footwall::service::EngineClient(*window.workbench()->engine.connection()).status();
  const auto tell = [&](int n) {
    require(QTest::qWaitFor([&] { return window.workbench()->surfaces.is_settled(); }, kPatience), "settled");
    fmt::print("after {:>6} moves: the editor {:.1f} MiB", n, resident("self"));
    for (const auto& rank : status.each_rank())
      fmt::print(", a rank {:.1f} MiB", resident(std::to_string(rank.process())));
    fmt::print("\n");
  };
  std::vector<double> ms;
  QElapsedTimer all;
  all.start();
  hand.press();
  for (int n = 1; n <= moves; ++n) {
    QElapsedTimer timer;
    timer.start();
    hand.move(swing(n));
    QCoreApplication::processEvents();
    ms.push_back(ms_of(timer));
    if (n == moves / 11 || n == moves / 11 * 6 || n == moves) tell(n);
  }
  hand.release(swing(moves));
  take_back(*window.workbench());
  print("a move in a stream, events handled", ms);
  fmt::print("{:.0f} moves/s\n", moves / ms_of(all) * 1e3);
}

}  // namespace

int main(int argc, char** argv) {
  const QApplication application(argc, argv);
  if (argc < 2) return std::fputs("bench_drag PROJECT [MOVES]\n", stderr), 2;
  try {
    MainWindow window({.starts_at_once = true});
    window.resize(1600, 1000);
    window.show();
    require(QTest::qWaitForWindowExposed(&window), "a window");
    open(window, QString::fromLocal8Bit(argv[1]));
    Hand hand(window);
    require(QTest::qWaitFor([&] { return window.is_settled() && hand.is_fresh(); }, kPatience),
            "fresh colours");
    check(window, hand);
    measure_latency(window, hand);
    measure_memory(window, hand, argc > 2 ? std::atoi(argv[2]) : 11000);
  } catch (const footwall::Error& error) {
    return fmt::print(stderr, "{}\n", error.message()), 1;
  }
  return 0;
}
