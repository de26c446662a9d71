#include <QAbstractItemModelTester>
#include <QApplication>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QSemaphore>
#include <QSignalSpy>
#include <QTest>
#include <QToolButton>
#include <algorithm>
#include <cmath>

#include "ui/made_runs.h"
#include "ui/model/fault_commands.h"
#include "ui/model/tour.h"
#include "ui/model/volume_spread.h"
#include "ui/model/workbench.h"
#include "ui/panels/fault_fields.h"
#include "ui/panels/histogram.h"
#include "ui/panels/inspector_panel.h"
#include "ui/panels/jobs_panel.h"
#include "ui/panels/properties.h"
#include "ui/panels/volume_box.h"
#include "ui/sample_project.h"
#include "ui/test_class.h"

namespace footwall::ui {
namespace {

QAction* no_action(const QString&) {
  return nullptr;
}

std::set<Id> pillars_of(const Fault& fault) {
  std::set<Id> pillars;
  for (const survey::Pillar& pillar : fault.pillars) pillars.insert(pillar.id);
  return pillars;
}

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
  void several_things_are_counted();
  void what_is_taken_away_is_not_inspected();
  void a_run_that_is_shown_is_inspected();
  void an_isosurface_is_told();
  void a_clip_belongs_to_a_range();
  void handles_set_the_clip_of_the_sections();
  void a_volume_without_its_file_is_told();
  void fields_of_a_fault_are_one_edit_each();
  void fields_of_a_locked_fault_are_fixed();
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

void PanelsTest::several_things_are_counted() {
  const SampleProject sample;
  Workbench bench(sample.open(), {});
  const InspectorPanel inspector(bench, no_action);
  const Fault& first = bench.document.faults()[0];
  const Fault& second = bench.document.faults()[1];
  const QString name = QString::fromStdString(first.record.name);
  const std::set<Id> pillars = pillars_of(first);
  bench.selection.select_all({}, pillars, {});
  QCOMPARE(inspector.shown().title, QStringLiteral("%1 pillars of %2").arg(pillars.size()).arg(name));
  const Id node = second.pillars[0].nodes[0].id;
  bench.selection.select_all({}, {}, {first.pillars[0].nodes[0].id, first.pillars[0].nodes[1].id, node});
  QCOMPARE(inspector.shown().title, QStringLiteral("3 nodes of 2 faults"));
  QCOMPARE(inspector.shown().rows.front(), (std::pair{name, QStringLiteral("2 nodes")}));
  bench.selection.select_all({}, {second.pillars[1].id}, {node}, true);
  QCOMPARE(inspector.shown().title, QStringLiteral("1 pillar, 3 nodes of 2 faults"));
  bench.selection.select_all({first.record.id, second.record.id}, {}, {});
  QCOMPARE(inspector.shown().title, QStringLiteral("2 faults"));
  QCOMPARE(inspector.shown().rows.front(),
           (std::pair{name, QStringLiteral("all of %1 pillars").arg(first.pillars.size())}));
}

void PanelsTest::a_run_that_is_shown_is_inspected() {
  const SampleProject sample;
  Workbench bench(sample.open(), {});
  const auto runs = add_two_runs(bench);
  QVERIFY(runs);
  InspectorPanel inspector(bench, no_action);
  inspector.resize(300, 900);
  inspector.show();
  const Id fault = bench.document.faults().front().record.id;
  const project::MeshFace face = bench.surfaces.surface(fault)->faces[1];
  bench.selection.select({.kind = Item::Kind::kFace, .id = fault, .panel = face.panel, .number = face.n});
  const auto variance = [&] {
    for (const auto& [name, value] : inspector.shown().rows) {
      if (name == QStringLiteral("variance")) return value.section(u' ', 0, 0).toDouble();
    }
    return 0.0;
  };
  QCOMPARE(variance(), TwoRuns::of_newer(1));
  QVERIFY(says(inspector, QStringLiteral("VARIANCE")) && !says(inspector, QStringLiteral("run base")));
  QVERIFY(inspector.histogram().range().second < 0 || inspector.histogram().range().first < 0);
  bench.display.show_run(runs->base);
  QTRY_COMPARE(variance(), TwoRuns::of_base(1));
  QTRY_VERIFY(inspector.histogram().range().first >= 0 && inspector.histogram().range().second > 2);
  QVERIFY(says(inspector, QStringLiteral("VARIANCE · run base")));
  QVERIFY(says(inspector, QStringLiteral("of run base")));
  bench.display.show_run(0);
  QTRY_COMPARE(variance(), TwoRuns::of_newer(1));
  QVERIFY(!says(inspector, QStringLiteral("run base")));
}

void PanelsTest::what_is_taken_away_is_not_inspected() {
  const SampleProject sample;
  Workbench bench(sample.open(), {});
  const Fault& fault = bench.document.faults().front();
  const Item first{.kind = Item::Kind::kPillar, .id = fault.pillars[0].id};
  const Item second{.kind = Item::Kind::kPillar, .id = fault.pillars[1].id};
  bench.selection.select(first);
  bench.selection.select(second, true);
  QVERIFY(bench.selection.current() == second);
  bench.selection.select(second, true);
  QVERIFY(bench.selection.current() == first);
  bench.selection.select(first, true);
  QVERIFY(!bench.selection.current());
}

void PanelsTest::an_isosurface_is_told() {
  const SampleProject sample;
  Workbench bench(sample.open(), {});
  const InspectorPanel inspector(bench, no_action);
  const Id id = bench.display.add_isosurface(bench.display.volume(), 0.25);
  bench.selection.select({.kind = Item::Kind::kIsosurface, .id = id});
  QCOMPARE(inspector.shown().title, QStringLiteral("Isosurface"));
  const auto row = [&](const QString& name) {
    for (const auto& [left, right] : inspector.shown().rows) {
      if (left == name) return right;
    }
    return QString();
  };
  QCOMPARE(row(QStringLiteral("volume")), QStringLiteral("amplitude"));
  QCOMPARE(row(QStringLiteral("value")), QStringLiteral("0.25 amplitude"));
  QCOMPARE(row(QStringLiteral("shown as")), QStringLiteral("picture by the engine"));
  IsosurfaceLook look = bench.display.isosurfaces().front();
  look.as_picture = false;
  look.value = -0.5;
  look.colour = QStringLiteral("#102030");
  bench.display.change_isosurface(look);
  QTRY_COMPARE(row(QStringLiteral("shown as")), QStringLiteral("mesh of triangles"));
  QCOMPARE(row(QStringLiteral("value")), QStringLiteral("-0.5 amplitude"));
  QCOMPARE(row(QStringLiteral("colour")), QStringLiteral("#102030"));
}

void PanelsTest::a_clip_belongs_to_a_range() {
  SectionReader::VolumeFacts facts{.signed_values = false, .percentiles = {}, .max_abs = 1};
  for (int p = 0; p <= 100; ++p) facts.percentiles.push_back(p / 100.0);
  SampleLook look;
  look.gain = 3;
  look.colour_map = QStringLiteral("viridis");
  QCOMPARE(clipped_at(look, facts, 0.905, false).clip_percentile, 90.5);
  QCOMPARE(clipped_at(look, facts, 0.08, true).clip_percentile, 92.0);
  QCOMPARE(clipped_at(look, facts, 2, false).clip_percentile, 100.0);
  QCOMPARE(clipped_at(look, facts, 0.6, true).clip_percentile, 75.0);  // no further than that
  QCOMPARE(clipped_at(look, facts, 0.9, false).gain, 1.0);
  QCOMPARE(clipped_at(look, facts, 0.9, false).colour_map, look.colour_map);
  facts.signed_values = true;
  QCOMPARE(clipped_at(look, facts, -0.95, true).clip_percentile, 95.0);
}

void PanelsTest::handles_set_the_clip_of_the_sections() {
  const SampleProject sample;
  Workbench bench(sample.open(), {});
  InspectorPanel inspector(bench, no_action);
  inspector.resize(300, 700);
  inspector.show();
  bench.selection.select({.kind = Item::Kind::kVolume, .id = bench.display.volume()});
  Histogram& histogram = inspector.volume().histogram();
  QTRY_VERIFY_WITH_TIMEOUT(!histogram.is_empty(), 30'000);
  QVERIFY(inspector.volume().state().contains(QStringLiteral("checksum that the project knows")));
  const auto [low, high] = histogram.range();
  QVERIFY(high > 0 && low == -high);  // a volume of both signs
  // The right handle is moved inwards by the keys: fewer samples are within, at both ends.
  QTest::keyClick(&histogram, Qt::Key_Down);
  for (int n = 0; n < 3; ++n) QTest::keyClick(&histogram, Qt::Key_Left);
  const double clip = bench.display.samples().clip_percentile;
  QVERIFY(clip < 99 && clip >= 75);
  QVERIFY(histogram.range().second < high);
  QCOMPARE(histogram.range().first, -histogram.range().second);
  // Where the sections' colours say so, the handles follow.
  SampleLook look = bench.display.samples();
  look.gain = 2;
  const double before = histogram.range().second;
  bench.display.set_samples(look);
  QCOMPARE(histogram.range().second, before / 2);
  QTest::mouseDClick(&histogram, Qt::LeftButton, {}, histogram.rect().center());
  QCOMPARE(bench.display.samples().clip_percentile, 99.0);
  QCOMPARE(bench.display.samples().gain, 1.0);
  QCOMPARE(histogram.range().second, high);
}

void PanelsTest::a_volume_without_its_file_is_told() {
  const SampleProject sample;
  Workbench bench(sample.open(), {});
  InspectorPanel inspector(bench, no_action);
  inspector.show();
  const project::VolumeRecord volume = bench.document.volumes().front();
  const std::filesystem::path file = bench.document.project().volume_path(volume);
  std::filesystem::rename(file, file.string() + ".away");
  bench.selection.select({.kind = Item::Kind::kVolume, .id = volume.id});
  QTRY_VERIFY_WITH_TIMEOUT(
      inspector.volume().state().contains(QString::fromStdString(file.filename().string())), 30'000);
  QVERIFY(inspector.volume().histogram().is_empty());
  QVERIFY(inspector.shown().title.startsWith(QStringLiteral("Volume")));
}

void PanelsTest::fields_of_a_fault_are_one_edit_each() {
  const SampleProject sample;
  Workbench bench(sample.open(), {});
  InspectorPanel inspector(bench, no_action);
  inspector.resize(300, 700);
  inspector.show();
  QApplication::setActiveWindow(&inspector);  // there is no window manager that would
  QTRY_VERIFY(inspector.isActiveWindow());
  const Id fault = bench.document.faults()[0].record.id;
  const auto record = [&] { return bench.document.fault(fault)->record; };
  const std::size_t steps = bench.document.history().size();
  bench.selection.select({.kind = Item::Kind::kFault, .id = fault});
  auto* status = inspector.fields().findChild<QLineEdit*>(QStringLiteral("status"));
  auto* interpreter = inspector.fields().findChild<QLineEdit*>(QStringLiteral("interpreter"));
  auto* note = inspector.fields().findChild<QPlainTextEdit*>(QStringLiteral("note"));
  QCOMPARE(status->text(), QString::fromStdString(record().status));
  status->setFocus();
  status->selectAll();
  QTest::keyClicks(status, QStringLiteral("final"));
  QTest::keyClick(status, Qt::Key_Return);
  QCOMPARE(record().status, std::string("final"));
  QCOMPARE(bench.document.history().size(), steps + 1);
  // A field that is left without a change makes no step; one with a change does, also by another selection.
  interpreter->setFocus();
  note->setFocus();
  QCOMPARE(bench.document.history().size(), steps + 1);
  QTest::keyClicks(note, QStringLiteral("throws 40 m"));
  bench.selection.select({.kind = Item::Kind::kFault, .id = bench.document.faults()[1].record.id});
  QCOMPARE(record().note, std::string("throws 40 m"));
  QCOMPARE(bench.document.history().size(), steps + 2);
  QVERIFY(note->toPlainText().isEmpty());
  bench.selection.select({.kind = Item::Kind::kFault, .id = fault});
  QCOMPARE(note->toPlainText(), QStringLiteral("throws 40 m"));
  // Esc puts back what was; undo shows at once what is stored.
  interpreter->setFocus();
  QTest::keyClicks(interpreter, QStringLiteral("nobody"));
  QTest::keyClick(interpreter, Qt::Key_Escape);
  QCOMPARE(interpreter->text(), QString::fromStdString(record().interpreter));
  QVERIFY(bench.document.undo());
  QTRY_VERIFY(note->toPlainText().isEmpty());
  QCOMPARE(bench.document.history().size(), steps + 2);
}

void PanelsTest::fields_of_a_locked_fault_are_fixed() {
  const SampleProject sample;
  Workbench bench(sample.open(), {});
  const InspectorPanel inspector(bench, no_action);
  const Id fault = bench.document.faults()[0].record.id;
  bench.selection.select({.kind = Item::Kind::kFault, .id = fault});
  const auto* status = inspector.findChild<QLineEdit*>(QStringLiteral("status"));
  QVERIFY(!status->isReadOnly());
  QVERIFY(lock_faults(bench.document, {fault}, true));
  QTRY_VERIFY(status->isReadOnly());
  QVERIFY(lock_faults(bench.document, {fault}, false));
  QTRY_VERIFY(!status->isReadOnly());
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
