// How long a section view takes to step, and for a frame in which only the cursor or a dragged pillar moves.
// Each step is checked to show the samples of its own section. Needs a screen:
//   python3 tests/ui/on_a_screen.py build/release/bin/bench_section PROJECT [PICTURE.png]
#include <fmt/format.h>

#include <QApplication>
#include <QElapsedTimer>
#include <QTest>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "storage/base/error.h"
#include "ui/model/workbench.h"
#include "ui/section/section_view.h"

namespace {

using namespace footwall::ui;

constexpr int kSteps = 80;
constexpr int kFrames = 200;

void print(const char* what, std::vector<double> ms) {
  std::ranges::sort(ms);
  fmt::print("{:<26} median {:6.2f}   95 % {:6.2f}   worst {:6.2f} ms\n", what, ms[ms.size() / 2],
             ms[ms.size() * 95 / 100], ms.back());
}

// 200 faults of 5000 faces each, as the layer of what stands still draws them after a step.
void measure_many_cuts() {
  constexpr int kFaults = 200, kDown = 50, kAlong = 50;
  std::vector<footwall::survey::IndexPoint> places;
  std::vector<footwall::project::MeshFace> faces;
  for (int a = 0; a <= kAlong; ++a) {
    for (int b = 0; b <= kDown; ++b)
      places.push_back({a * 5.0 + 0.3, 100 + 5 * std::sin(0.2 * a + 0.1 * b), b * 5.0});
  }
  for (int a = 0; a < kAlong; ++a) {
    for (int b = 0; b < kDown; ++b) {
      const int at = a * (kDown + 1) + b;
      faces.push_back({.panel = 1, .n = 0, .vertices = {at, at + 1, at + kDown + 1}});
      faces.push_back({.panel = 1, .n = 0, .vertices = {at + 1, at + kDown + 2, at + kDown + 1}});
    }
  }
  ViewTransform view;
  view.set_area({52, 24, 738, 530});
  view.set_frame(
      {.size = {256, 256}, .metres_per_u = 12.5, .metres_per_v = 4, .upward = false, .vertical = true});
  QImage image(800, 600, QImage::Format_RGB32);
  std::vector<double> cutting, drawing;
  for (int n = 0; n < 10; ++n) {
    std::vector<ShapedFault> shapes(kFaults);
    QElapsedTimer timer;
    timer.start();
    for (ShapedFault& shape : shapes) {
      shape.cut = mesh_cut({.kind = Section::Kind::kInline, .index = 100 + n}, places, faces);
      shape.lines = joined(shape.cut);
    }
    cutting.push_back(static_cast<double>(timer.nsecsElapsed()) * 1e-6);
    footwall::require(shapes[0].lines.size() == 1, "one line through the sheet");
    timer.start();
    QPainter painter(&image);
    painter.setRenderHint(QPainter::Antialiasing);
    for (const ShapedFault& shape : shapes) draw_fault(painter, shape, view, {}, {}, {});
    drawing.push_back(static_cast<double>(timer.nsecsElapsed()) * 1e-6);
  }
  print("200 meshes: cut", cutting);
  print("200 cuts: drawn", drawing);
}

double time_of(const std::function<void()>& f) {
  QElapsedTimer timer;
  timer.start();
  f();
  return static_cast<double>(timer.nsecsElapsed()) * 1e-6;
}

void measure(const char* project, const char* picture) {
  QString held;
  const auto bench = open_workbench(project, {}, &held);
  footwall::require(bench->document.survey().has_value() && !bench->document.volumes().empty(),
                    "a project with a volume");
  for (const auto& [kind, name] : {std::pair{Section::Kind::kInline, "inline"},
                                   {Section::Kind::kCrossline, "crossline"},
                                   {Section::Kind::kSlice, "slice"}}) {
    const Id shown = bench->display.add_section({.kind = kind});
    SectionView view(*bench, shown);
    SectionCanvas& canvas = view.canvas();
    const auto is_there = [&] { return canvas.samples() && canvas.samples()->section == canvas.section(); };
    view.resize(800, 620);
    view.show();
    footwall::require(QTest::qWaitForWindowExposed(&view) && QTest::qWaitFor(is_there, 60000),
                      "a view with samples");
    const auto step = [&](int by) {
      return time_of([&] {
        canvas.step(by);
        footwall::require(QTest::qWaitFor(is_there, 60000), "the step's samples");
        canvas.repaint();
      });
    };
    std::vector<double> first, again, frames;
    for (int n = 0; n < kSteps; ++n) first.push_back(step(1));
    for (int n = 0; n < kSteps; ++n) again.push_back(step(-1));
    const int layers = canvas.still_redraws();
    for (int n = 0; n < kFrames; ++n) {
      bench->display.set_cursor(index_of(canvas.section(), {n % 50 + 0.3, n % 40 + 0.7}));
      frames.push_back(time_of([&] { canvas.repaint(); }));
    }
    footwall::require(canvas.still_redraws() == layers, "frames that draw no layer");
    print(fmt::format("{}: first step", name).c_str(), first);
    print(fmt::format("{}: step back", name).c_str(), again);
    print(fmt::format("{}: cursor frame", name).c_str(), frames);
    if (picture != nullptr && kind == Section::Kind::kInline)
      view.grab().save(QString::fromLocal8Bit(picture));
    bench->display.remove_section(shown);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const QApplication application(argc, argv);
  if (argc < 2) return std::fputs("bench_section PROJECT [PICTURE.png]\n", stderr), 2;
  try {
    measure_many_cuts();
    measure(argv[1], argc > 2 ? argv[2] : nullptr);
  } catch (const footwall::Error& error) {
    return fmt::print(stderr, "{}\n", error.message()), 1;
  }
  return 0;
}
