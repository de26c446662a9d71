#include <QAbstractItemModelTester>
#include <QLabel>
#include <QSemaphore>
#include <QSignalSpy>
#include <QTest>
#include <QToolButton>
#include <algorithm>
#include <cmath>

#include "ui/model/tour.h"
#include "ui/panels/histogram.h"
#include "ui/panels/jobs_panel.h"
#include "ui/panels/properties.h"
#include "ui/sample_project.h"
#include "ui/test_class.h"

namespace footwall::ui {
namespace {

// Whether a label that can be seen has the text in it.
bool says(const QWidget& panel, const QString& text) {
  for (const QLabel* label : panel.findChildren<QLabel*>()) {
    if (label->isVisible() && label->text().contains(text)) return true;
  }
  return false;
}

}  // namespace

class PanelsTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void bins_count_every_finite_value_once();
  void handles_choose_the_range();
  void time_left_is_told_in_words();
  void a_job_is_shown_and_cancelled();
  void a_click_shows_the_log_of_a_job();
  void what_has_ended_is_cleared();
  void area_and_dip_of_a_known_plane();
  void the_tour_goes_from_the_lowest_contrast_up();
  void the_tour_of_offsets_goes_from_the_farthest_down();
};

void PanelsTest::bins_count_every_finite_value_once() {
  const std::vector<double> values{0, 0.1, 0.5, 0.999, 1, 2, -5, NAN, INFINITY};
  const std::vector<int> bins = bins_of(values, 0, 1, 4);
  QCOMPARE(bins, (std::vector<int>{3, 0, 1, 3}));
  QCOMPARE(bins_of({3, 3}, 3, 3, 2), (std::vector<int>{2, 0}));
}

void PanelsTest::handles_choose_the_range() {
  Histogram histogram;
  histogram.resize(208, 84);
  histogram.show();
  histogram.show_values({0, 10, NAN}, {{2, 8}});
  QSignalSpy changed(&histogram, &Histogram::range_changed);
  // 200 pixels for 0 to 10, behind a margin of 4.
  QTest::mousePress(&histogram, Qt::LeftButton, {}, {44, 30});
  QTest::mouseMove(&histogram, {84, 30});
  QTest::mouseRelease(&histogram, Qt::LeftButton, {}, {84, 30});
  QVERIFY(!changed.isEmpty());
  QCOMPARE(changed.last()[0].toDouble(), 4.0);
  QCOMPARE(changed.last()[1].toDouble(), 8.0);
  QTest::keyClick(&histogram, Qt::Key_Up);
  QTest::keyClick(&histogram, Qt::Key_Right);
  QCOMPARE(histogram.range().second, 8.2);
  QSignalSpy reset(&histogram, &Histogram::range_reset);
  QTest::mouseDClick(&histogram, Qt::LeftButton, {}, {84, 30});
  QCOMPARE(reset.size(), 1);
  histogram.show_values({NAN}, {});
  QVERIFY(histogram.is_empty());
}

void PanelsTest::time_left_is_told_in_words() {
  QCOMPARE(time_left_text({}), QString());
  QCOMPARE(time_left_text(1.24), QStringLiteral("1.2 s left"));
  QCOMPARE(time_left_text(40.0), QStringLiteral("40 s left"));
  QCOMPARE(time_left_text(240.0), QStringLiteral("4 min left"));
}

void PanelsTest::a_job_is_shown_and_cancelled() {
  Jobs jobs;
  QAbstractItemModelTester tester(&jobs, QAbstractItemModelTester::FailureReportingMode::QtTest);
  JobsPanel panel({&jobs});
  panel.resize(600, 90);
  panel.show();
  jobs.start(QStringLiteral("Statistics of F2"), [](const JobContext& job) {
    for (;;) job.report(0.5, "exchange", "3 of 6 voxels");
  });
  QTRY_VERIFY(says(panel, QStringLiteral("exchange, 3 of 6 voxels")));
  QVERIFY(says(panel, QStringLiteral("Statistics of F2")));
  QTest::mouseClick(panel.findChild<QToolButton*>(QStringLiteral("cancel")), Qt::LeftButton);
  QTRY_VERIFY(says(panel, QStringLiteral("cancelled")));
  QCOMPARE(jobs.running(), 0);
}

void PanelsTest::a_click_shows_the_log_of_a_job() {
  Jobs jobs;
  JobsPanel panel({&jobs});
  panel.resize(600, 200);
  panel.show();
  jobs.start(QStringLiteral("first"), [](const JobContext& job) {
    job.report(0.2, "reading headers", "");
    throw Error(ErrorCode::kInvalid, "it was to fail", "do something else");
  });
  QTRY_COMPARE(jobs.running(), 0);
  auto* log = panel.findChild<QLabel*>(QStringLiteral("log"));
  QVERIFY(!log->isVisible());
  QTest::mouseClick(log->parentWidget(), Qt::LeftButton, {}, {40, 6});
  QVERIFY(log->isVisible());
  QCOMPARE(log->text(), QStringLiteral("reading headers\nit was to fail\ndo something else"));
  // It stays open when another job comes, which makes the rows anew; Enter puts it away.
  jobs.start(QStringLiteral("second"), [](const JobContext&) {});
  QTRY_COMPARE(jobs.running(), 0);
  const auto logs = panel.findChildren<QLabel*>(QStringLiteral("log"));
  QCOMPARE(logs.size(), 2);
  const auto open = std::ranges::find_if(logs, &QLabel::isVisible);
  QVERIFY(open != logs.end() && (*open)->text().startsWith(QStringLiteral("reading headers")));
  QTest::keyClick((*open)->parentWidget(), Qt::Key_Return);
  QVERIFY(!(*open)->isVisible());
}

void PanelsTest::what_has_ended_is_cleared() {
  Jobs jobs, others;
  JobsPanel panel({&jobs, &others});
  panel.resize(600, 200);
  panel.show();
  const auto* clear = panel.findChild<QToolButton*>(QStringLiteral("clear"));
  QVERIFY(!clear->isVisible());
  jobs.start(QStringLiteral("ended"), [](const JobContext&) {});
  others.start(QStringLiteral("ended elsewhere"), [](const JobContext&) {});
  QTRY_COMPARE(jobs.running() + others.running(), 0);
  const int last = jobs.start(QStringLiteral("still at it"), [](const JobContext& job) {
    for (;;) job.report(0.5, "", "");
  });
  QVERIFY(clear->isVisible());
  QTest::mouseClick(const_cast<QToolButton*>(clear), Qt::LeftButton);
  QCOMPARE(jobs.rowCount(), 1);
  QCOMPARE(others.rowCount(), 0);
  QTRY_VERIFY(says(panel, QStringLiteral("still at it")));
  QVERIFY(!clear->isVisible());
  jobs.cancel(last);
  QTRY_VERIFY(clear->isVisible());
}

void PanelsTest::area_and_dip_of_a_known_plane() {
  survey::Geometry survey;
  survey.inlines = {.first = 1, .step = 1, .count = 100};
  survey.crosslines = {.first = 1, .step = 1, .count = 100};
  survey.samples = 100;
  survey.interval = 10;
  survey.domain = survey::Domain::kDepth;
  survey.vertical_unit = survey::VerticalUnit::kMetre;
  survey.map = {.origin_x = 0,
                .origin_y = 0,
                .per_inline_x = 0,
                .per_inline_y = 10,
                .per_crossline_x = 10,
                .per_crossline_y = 0};
  FaultSurface surface;
  // Ten lines wide, ten samples down over ten crosslines: 45 degrees, 100 m by 141.42 m.
  surface.places = {{0, 0, 0}, {10, 0, 0}, {10, 10, 10}, {0, 10, 10}};
  surface.faces = {{.panel = 1, .n = 0, .vertices = {0, 1, 2}}, {.panel = 1, .n = 1, .vertices = {0, 2, 3}}};
  const ShapeFacts facts = shape_facts(surface, survey, std::nullopt);
  QVERIFY(facts.area && std::abs(*facts.area - 100 * 100 * std::sqrt(2)) < 1e-6);
  QVERIFY(facts.dip_low && std::abs(*facts.dip_low - 45) < 1e-6 && std::abs(*facts.dip_high - 45) < 1e-6);
  QVERIFY(std::abs(*facts.dip_mean - 45) < 1e-6);
  survey.domain = survey::Domain::kTime;
  survey.vertical_unit = survey::VerticalUnit::kMillisecond;
  const ShapeFacts in_time = shape_facts(surface, survey, std::nullopt);
  QVERIFY(!in_time.area && !in_time.dip_mean);
  QVERIFY(std::abs(in_time.area_voxels - 10 * 10 * std::sqrt(2)) < 1e-9);
  QVERIFY(shape_facts(surface, survey, 2000).area);
}

void PanelsTest::the_tour_goes_from_the_lowest_contrast_up() {
  FaultSurface surface;
  surface.fault = 7;
  surface.places = {{0, 0, 0}, {3, 0, 0}, {0, 3, 3}};
  for (int n = 0; n < 6; ++n) surface.faces.push_back({.panel = 1, .n = n, .vertices = {0, 1, 2}});
  const FaceNumbers contrast{.values = {0.5, -0.2, NAN, -0.9, -0.8, 0.1},
                             .stale = {0, 0, 0, 1, 0, 0},
                             .hatched = {0, 0, 0, 0, 1, 0}};
  const auto stops = worst_faces(surface, contrast);
  QCOMPARE(stops.size(), 3U);
  QCOMPARE(stops[0].face.number, 1);
  QCOMPARE(stops[0].face.id, 7);
  QCOMPARE(stops[0].place, (survey::IndexPoint{1, 1, 1}));
  QCOMPARE(stops[1].face.number, 5);
  QCOMPARE(stops[2].face.number, 0);
  QVERIFY(next_stop(stops, {}) == &stops[0]);
  QVERIFY(next_stop(stops, stops[0].face) == &stops[1]);
  QVERIFY(next_stop(stops, stops[2].face) == &stops[0]);
  QVERIFY(next_stop({}, stops[0].face) == nullptr);
  QVERIFY(next_stop(stops, stops[1].face, -1) == &stops[0]);
  QVERIFY(next_stop(stops, stops[0].face, -1) == &stops[2]);
  QVERIFY(next_stop(stops, {}, -1) == &stops[2]);
}

void PanelsTest::the_tour_of_offsets_goes_from_the_farthest_down() {
  FaultSurface surface;
  surface.fault = 7;
  surface.places = {{0, 0, 0}, {3, 0, 0}, {0, 3, 3}};
  for (int n = 0; n < 6; ++n) surface.faces.push_back({.panel = 1, .n = n, .vertices = {0, 1, 2}});
  const FaceNumbers offset{
      .values = {2, -5, NAN, 8, 0, 3}, .stale = {0, 0, 0, 1, 0, 0}, .hatched = {0, 0, 0, 0, 0, 0}};
  const auto stops = farthest_faces(surface, offset);
  QCOMPARE(stops.size(), 3U);
  QCOMPARE(stops[0].value, -5.0);
  QCOMPARE(stops[1].value, 3.0);
  QCOMPARE(stops[2].face.number, 0);
}

static const RegisterTest<PanelsTest> kRegistered;

}  // namespace footwall::ui

#include "panels_test.moc"
