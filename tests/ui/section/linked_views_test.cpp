#include <QTest>
#include <QWheelEvent>
#include <cmath>
#include <utility>

#include "ui/sample_project.h"
#include "ui/section/section_view.h"
#include "ui/test_class.h"

namespace footwall::ui {
namespace {

bool is_near(double a, double b) {
  return std::abs(a - b) <= 1e-9 * std::max({1.0, std::abs(a), std::abs(b)});
}

// What of the plane's heights is shown, top first.
std::pair<double, double> heights(SectionView& view) {
  const ViewTransform& now = view.canvas().view();
  return {now.to_plane(now.area().topLeft()).v, now.to_plane(now.area().bottomLeft()).v};
}

bool same_heights(SectionView& a, SectionView& b) {
  return is_near(heights(a).first, heights(b).first) && is_near(heights(a).second, heights(b).second);
}

double middle_u(SectionView& view) {
  return view.canvas().view().part().centre.u;
}

void wheel(SectionView& view, Qt::KeyboardModifiers modifiers = {}) {
  const QPointF at = view.canvas().view().area().center() + QPointF(60, 40);
  QWheelEvent event(at, view.canvas().mapToGlobal(at), {}, {0, 120}, Qt::NoButton, modifiers,
                    Qt::NoScrollPhase, false);
  QApplication::sendEvent(&view.canvas(), &event);
}

// One section of each kind, and a second inline of another size.
struct Views {
  explicit Views(const SampleProject& sample) : bench(sample.open(), {}) {
    other_inline.resize(420, 300);
    for (SectionView* view : {&one, &crossline, &slice, &line}) view->resize(700, 500);
    for (SectionView* view : {&one, &other_inline, &crossline, &slice, &line}) {
      view->show();
      arrived = QTest::qWaitForWindowExposed(view) && arrived;
    }
  }
  Id add(const Section& section) { return bench.display.add_section(section); }
  void link(SectionView& view, bool on) {
    bench.display.change_section(
        {.id = view.shown(), .section = view.canvas().section(), .in_scene = true, .linked = on});
  }

  Workbench bench;
  SectionView one{bench, add({.kind = Section::Kind::kInline, .index = 20})};
  SectionView other_inline{bench, add({.kind = Section::Kind::kInline, .index = 30})};
  SectionView crossline{bench, add({.kind = Section::Kind::kCrossline, .index = 10})};
  SectionView slice{bench, add({.kind = Section::Kind::kSlice, .index = 10})};
  SectionView line{bench, add({.kind = Section::Kind::kLine, .from = {0, 0, 0}, .to = {30, 30, 0}})};
  bool arrived = true;
};

}  // namespace

class LinkedViewsTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void linked_sections_move_together();
  void fitting_one_fits_all();
  void free_sections_stay();
  void what_is_shown_can_be_kept();
  void bad_looks_do_no_harm();
};

void LinkedViewsTest::linked_sections_move_together() {
  const SampleProject sample;
  Views views(sample);
  QVERIFY(views.arrived);
  const ShownPart slice = views.slice.canvas().view().part();
  const double crossline_scale = views.crossline.canvas().view().pixels_per_u();
  const double crossline_u = middle_u(views.crossline);
  const double line_u = middle_u(views.line);
  wheel(views.one);
  wheel(views.one);
  wheel(views.one, Qt::ShiftModifier);
  QTest::keyClick(&views.one.canvas(), Qt::Key_Left);
  QTest::keyClick(&views.one.canvas(), Qt::Key_Up);
  QVERIFY(same_heights(views.one, views.other_inline));
  QVERIFY(is_near(middle_u(views.one), middle_u(views.other_inline)));
  QCOMPARE(views.other_inline.canvas().view().stretch(), views.one.canvas().view().stretch());
  for (SectionView* vertical : {&views.crossline, &views.line}) QVERIFY(same_heights(views.one, *vertical));
  QCOMPARE(views.crossline.canvas().view().pixels_per_u(), crossline_scale);
  QCOMPARE(middle_u(views.crossline), crossline_u);
  QCOMPARE(middle_u(views.line), line_u);
  const ShownPart after = views.slice.canvas().view().part();
  QCOMPARE(after.pixels_per_metre, slice.pixels_per_metre);
  QVERIFY(after.centre == slice.centre);
  // A slice has no heights to share with the others.
  const ShownPart before = views.one.canvas().view().part();
  wheel(views.slice);
  QVERIFY(views.slice.canvas().view().pixels_per_metre() > slice.pixels_per_metre);
  QCOMPARE(views.one.canvas().view().pixels_per_metre(), before.pixels_per_metre);
}

void LinkedViewsTest::fitting_one_fits_all() {
  const SampleProject sample;
  Views views(sample);
  QVERIFY(views.arrived);
  wheel(views.one);
  for (SectionView* view : {&views.other_inline, &views.crossline, &views.line})
    QVERIFY(!view->canvas().view().is_fitted());
  QTest::keyClick(&views.crossline.canvas(), Qt::Key_Home);
  for (SectionView* view : {&views.one, &views.other_inline, &views.crossline, &views.line})
    QVERIFY(view->canvas().view().is_fitted());
}

void LinkedViewsTest::free_sections_stay() {
  const SampleProject sample;
  Views views(sample);
  QVERIFY(views.arrived);
  views.link(views.other_inline, false);
  wheel(views.one);
  QVERIFY(views.other_inline.canvas().view().is_fitted());
  QVERIFY(!views.crossline.canvas().view().is_fitted());
  // Nor do the others follow it.
  const ShownPart before = views.one.canvas().view().part();
  wheel(views.other_inline);
  QVERIFY(!views.other_inline.canvas().view().is_fitted());
  QCOMPARE(views.one.canvas().view().pixels_per_metre(), before.pixels_per_metre);
}

void LinkedViewsTest::what_is_shown_can_be_kept() {
  const SampleProject sample;
  Views views(sample);
  QVERIFY(views.arrived);
  QVERIFY(views.one.look().isEmpty());
  wheel(views.one);
  wheel(views.one, Qt::ShiftModifier);
  QTest::keyClick(&views.one.canvas(), Qt::Key_Left);
  const QJsonObject look = views.one.look();
  QVERIFY(!look.isEmpty());
  QCOMPARE(views.one.look(), look);
  SectionView again(views.bench, views.one.shown());
  again.set_look(look);
  again.resize(700, 500);
  again.show();
  QVERIFY(QTest::qWaitForWindowExposed(&again));
  QCOMPARE(again.look(), look);
  QCOMPARE(again.canvas().view().pixels_per_u(), views.one.canvas().view().pixels_per_u());
  QVERIFY(same_heights(again, views.one));
  again.canvas().fit(true);
  const QJsonObject fitted = again.look();
  again.canvas().fit(false);
  QVERIFY(again.look().isEmpty());
  again.set_look(fitted);
  QCOMPARE(again.canvas().view().stretch(), 1.0);
}

void LinkedViewsTest::bad_looks_do_no_harm() {
  const SampleProject sample;
  Views views(sample);
  QVERIFY(views.arrived);
  wheel(views.one);
  const QJsonObject before = views.one.look();
  for (const double scale : {0.0, -1.0}) {
    views.one.set_look({{"pixels_per_metre", scale}, {"stretch", 1}, {"u", 1}, {"v", 1}});
    QCOMPARE(views.one.look(), before);
  }
  views.one.set_look({{"pixels_per_metre", 1e300}, {"stretch", 1e300}, {"u", 1e300}, {"v", -1e300}});
  const ViewTransform& now = views.one.canvas().view();
  QVERIFY(std::isfinite(now.to_pixels({1, 1}).x()) && now.pixels_per_v() > 0);
  QVERIFY(!views.one.canvas().grab().isNull());
}

static const RegisterTest<LinkedViewsTest> kRegistered;

}  // namespace footwall::ui

#include "linked_views_test.moc"
