#include "ui/model/line_drawing.h"

#include <QSignalSpy>
#include <QTest>

#include "ui/sample_project.h"
#include "ui/section/section_view.h"
#include "ui/test_class.h"

namespace footwall::ui {
namespace {

// A slice in a window on the screen: u is the crossline's index, v the inline's.
struct OpenSlice {
  explicit OpenSlice(const SampleProject& sample)
      : bench(sample.open(), {}),
        view(bench, bench.display.add_section({.kind = Section::Kind::kSlice, .index = 20})) {
    view.resize(800, 600);
    view.show();
    view.activateWindow();
    canvas().setFocus();
    arrived = QTest::qWaitForWindowExposed(&view) &&
              QTest::qWaitFor([this] { return canvas().samples() != nullptr; }, 20000);
    sections = bench.display.sections().size();
  }
  SectionCanvas& canvas() { return view.canvas(); }
  QPoint at(double u, double v) { return canvas().view().to_pixels({u, v}).toPoint(); }
  std::size_t made() const { return bench.display.sections().size() - sections; }

  Workbench bench;
  SectionView view;
  bool arrived = false;
  std::size_t sections = 0;
};

}  // namespace

class LineDrawingTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void two_clicks_make_a_line();
  void a_drag_makes_a_line();
  void escape_and_tools_end_it();
  void ends_are_places_of_the_survey();
};

void LineDrawingTest::two_clicks_make_a_line() {
  const SampleProject sample;
  OpenSlice open(sample);
  QVERIFY(open.arrived);
  LineDrawing& line = open.bench.line;
  QSignalSpy changed(&line, &LineDrawing::changed);
  QVERIFY(line.hint().isEmpty());
  line.begin();
  QCOMPARE(open.canvas().cursor().shape(), Qt::CrossCursor);
  QVERIFY(line.hint().contains(QStringLiteral("first end")));
  QTest::mouseClick(&open.canvas(), Qt::LeftButton, {}, open.at(5.2, 10.1));
  QVERIFY(line.first() == (survey::IndexPoint{10, 5, 0}));
  QVERIFY(line.hint().contains(QStringLiteral("other end")));
  // A second click on the same spot is no line.
  QTest::mouseClick(&open.canvas(), Qt::LeftButton, {}, open.at(5.2, 10.1));
  QCOMPARE(open.made(), 0U);
  open.bench.display.set_cursor(survey::IndexPoint{10, 5, 20});
  const QImage before = open.canvas().grab().toImage();
  QTest::mouseMove(&open.canvas(), open.at(30, 40));
  QTRY_VERIFY(open.bench.display.cursor() && open.bench.display.cursor()->i > 39);
  const QImage after = open.canvas().grab().toImage();
  int differ = 0;
  for (double part = 0.1; part < 0.9; part += 0.001) {
    const QPoint at = open.at(5 + part * 25, 10 + part * 30);
    differ += before.pixel(at) != after.pixel(at) ? 1 : 0;
  }
  QVERIFY2(differ > 200, qPrintable(QString::number(differ)));
  QTest::mouseClick(&open.canvas(), Qt::LeftButton, {}, open.at(30, 40));
  QCOMPARE(open.made(), 1U);
  const Section made = open.bench.display.sections().back().section;
  QVERIFY(made == (Section{.kind = Section::Kind::kLine, .from = {10, 5, 0}, .to = {40, 30, 0}}));
  QVERIFY(!line.is_active() && !line.first());
  QVERIFY(open.canvas().cursor().shape() != Qt::CrossCursor);
  QCOMPARE(changed.size(), 3);
  QVERIFY(!open.bench.selection.current());
  // It is over: clicks select again.
  QTest::mouseClick(&open.canvas(), Qt::LeftButton, {}, open.at(3, 3));
  QTest::mouseClick(&open.canvas(), Qt::LeftButton, {}, open.at(9, 30));
  QCOMPARE(open.made(), 1U);
}

void LineDrawingTest::a_drag_makes_a_line() {
  const SampleProject sample;
  OpenSlice open(sample);
  QVERIFY(open.arrived);
  open.bench.line.begin();
  QTest::mousePress(&open.canvas(), Qt::LeftButton, {}, open.at(8, 12));
  QTest::mouseMove(&open.canvas(), open.at(15, 30));
  QTest::mouseMove(&open.canvas(), open.at(20, 44));
  QTest::mouseRelease(&open.canvas(), Qt::LeftButton, {}, open.at(20, 44));
  QCOMPARE(open.made(), 1U);
  const Section made = open.bench.display.sections().back().section;
  QVERIFY(made == (Section{.kind = Section::Kind::kLine, .from = {12, 8, 0}, .to = {44, 20, 0}}));
}

void LineDrawingTest::escape_and_tools_end_it() {
  const SampleProject sample;
  OpenSlice open(sample);
  QVERIFY(open.arrived);
  LineDrawing& line = open.bench.line;
  line.begin();
  QTest::mousePress(&open.canvas(), Qt::LeftButton, {}, open.at(8, 12));
  QTest::keyClick(&open.canvas(), Qt::Key_Escape);
  QVERIFY(!line.is_active());
  QTest::mouseMove(&open.canvas(), open.at(20, 44));
  QTest::mouseRelease(&open.canvas(), Qt::LeftButton, {}, open.at(20, 44));
  QCOMPARE(open.made(), 0U);
  line.begin();
  open.bench.picking.set_tool(Tool::kPick);
  QVERIFY(!line.is_active());
  // While picking a line is no pillar.
  const std::size_t steps = open.bench.document.history().size();
  line.begin();
  QTest::mouseClick(&open.canvas(), Qt::LeftButton, {}, open.at(8, 12));
  QTest::mouseClick(&open.canvas(), Qt::LeftButton, {}, open.at(20, 30));
  QCOMPARE(open.made(), 1U);
  QCOMPARE(open.bench.document.history().size(), steps);
}

void LineDrawingTest::ends_are_places_of_the_survey() {
  const SampleProject sample;
  Workbench bench(sample.open(), {});
  const std::size_t before = bench.display.sections().size();
  bench.line.put({3, 3, 0});  // none is drawn
  QVERIFY(!bench.line.first());
  bench.line.begin();
  bench.line.put({-7.4, 12.6, 5});
  bench.line.put({300, 1e9, 5});
  QCOMPARE(bench.display.sections().size(), before + 1);
  const Section made = bench.display.sections().back().section;
  QVERIFY(made.from == (survey::IndexPoint{0, 13, 0}));
  QVERIFY(made.to == (survey::IndexPoint{47, 39, 0}));
}

static const RegisterTest<LineDrawingTest> kRegistered;

}  // namespace footwall::ui

#include "line_drawing_test.moc"
