// A stored run on the faces, and what is known now beside it.
#include "ui/model/shown_numbers.h"

#include <QDateTime>
#include <QSignalSpy>
#include <QTest>
#include <cmath>

#include "ui/made_runs.h"
#include "ui/model/tour.h"
#include "ui/sample_project.h"
#include "ui/test_class.h"

namespace footwall::ui {
namespace {

const QString kVariance = QStringLiteral("variance");

std::vector<double> known_now(const Workbench& bench, Id fault) {
  return bench.surfaces.numbers(fault, kVariance)->values;
}

// Shows the run, and waits until it has been read.
bool show(Workbench& bench, Id run) {
  bench.display.show_run(run);
  return QTest::qWaitFor([&] { return !bench.shown_numbers.is_reading(); }, 30'000);
}

std::set<Id> all_faults(const Document& document) {
  std::set<Id> all;
  for (const Fault& fault : document.faults()) all.insert(fault.record.id);
  return all;
}

}  // namespace

class ShownNumbersTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void a_run_is_shown_exactly_and_now_again();
  void what_is_known_now_stays_as_it_is();
  void what_a_run_lacks_is_not_in_it();
  void faces_that_moved_since_are_stale();
  void a_run_that_is_deleted_goes_back_to_now();
  void says_which_run_it_is();
  void is_shown_again_when_opened();
};

void ShownNumbersTest::a_run_is_shown_exactly_and_now_again() {
  const SampleProject sample;
  Workbench bench(sample.open(), {});
  bench.document.set_velocity(2000);  // so that there are dips
  const auto runs = add_two_runs(bench);
  QVERIFY(runs);
  const ShownNumbers& shown = bench.shown_numbers;
  const std::set<Id> faults = all_faults(bench.document);
  const auto range_now = shown.range(faults, kVariance);
  FaceLook look = bench.display.faces();
  look.colours = FaceColours::kPlain;
  bench.display.set_faces(look);
  QSignalSpy told(&shown, &ShownNumbers::numbers_changed);
  QSignalSpy another(&shown, &ShownNumbers::run_changed);
  bench.display.show_run(runs->base);
  QCOMPARE(another.size(), 1);
  QVERIFY(shown.is_reading());
  QCOMPARE(bench.display.faces().colours, FaceColours::kStatistic);  // else nothing of it were seen
  for (const Id fault : faults) {  // nothing is shown for it before it is there, the newest least of all
    QVERIFY(shown.numbers(fault, kVariance) == nullptr);
    QCOMPARE(shown.freshness(fault, kVariance), Freshness::kPlain);
  }
  QTRY_VERIFY(!shown.is_reading());
  QCOMPARE(static_cast<std::size_t>(told.size()), faults.size() + 1);
  double low = INFINITY, high = -INFINITY;
  for (const Id fault : faults) {
    const auto stored = bench.document.project().fault_statistics(runs->base, fault);
    const auto numbers = shown.numbers(fault, kVariance);
    QCOMPARE(numbers->values, stored.statistics.at("variance"));
    QCOMPARE(std::ranges::count(numbers->stale, 1), 0);
    QCOMPARE(std::ranges::count(numbers->hatched, 1), 0);
    QCOMPARE(shown.freshness(fault, kVariance), Freshness::kKept);
    low = std::min(low, std::ranges::min(numbers->values));
    high = std::max(high, std::ranges::max(numbers->values));
    // What follows from the places alone is that of now.
    QVERIFY(!shown.is_of_run("dip"));
    QCOMPARE(shown.numbers(fault, "dip")->values, bench.surfaces.numbers(fault, "dip")->values);
    QVERIFY(shown.numbers(fault, "dip")->values != stored.statistics.at("dip"));
    QCOMPARE(shown.freshness(fault, "dip"), Freshness::kFresh);
  }
  const auto range = shown.range(faults, kVariance);
  QVERIFY(range && *range != *range_now && range->first >= low && range->second <= high);
  bench.display.show_run(0);
  QCOMPARE(another.size(), 2);
  QVERIFY(!shown.run());
  for (const Id fault : faults) QCOMPARE(shown.numbers(fault, kVariance)->values, known_now(bench, fault));
  QCOMPARE(shown.range(faults, kVariance), range_now);
}

// Tours, shifts, "Update all" and the live run go by it.
void ShownNumbersTest::what_is_known_now_stays_as_it_is() {
  const SampleProject sample;
  Workbench bench(sample.open(), {});
  const auto runs = add_two_runs(bench);
  QVERIFY(runs);
  const Id fault = bench.document.faults().front().record.id;
  const std::vector<double> before = known_now(bench, fault);
  QCOMPARE(before[1], TwoRuns::of_newer(1));
  const auto live_before = bench.surfaces.live_run();
  const auto range_before = bench.surfaces.range({fault}, kVariance);
  QVERIFY(live_before);
  QVERIFY(show(bench, runs->base));
  QVERIFY(bench.shown_numbers.numbers(fault, kVariance)->values != before);
  QCOMPARE(known_now(bench, fault), before);
  QCOMPARE(bench.surfaces.freshness(fault, kVariance), Freshness::kFresh);
  QCOMPARE(bench.surfaces.range({fault}, kVariance), range_before);
  const auto live = bench.surfaces.live_run();
  QVERIFY(live && live->faults.size() == live_before->faults.size());
  for (std::size_t n = 0; n < live->faults.size(); ++n)
    for (const char* name : {"count", "variance", "contrast"})
      QCOMPARE(live->faults[n].statistics.at(name), live_before->faults[n].statistics.at(name));
  const auto surface = bench.surfaces.surface(fault);
  const auto stops = worst_faces(*surface, *bench.surfaces.numbers(fault, "contrast"));
  QCOMPARE(stops.front().face.number, surface->faces.back().n);
  // An edit is stale by what is known now, the run shown or not.
  const survey::Pillar& pillar = bench.document.faults().front().pillars.front();
  QVERIFY(bench.document.edit("Move", [&](project::Interpretation& now) {
    now.move_pillar(pillar.id, {40, 0, 0});
  }));
  QVERIFY(has_surfaces(bench));
  QVERIFY(bench.surfaces.freshness(fault, kVariance) != Freshness::kFresh);
}

void ShownNumbersTest::what_a_run_lacks_is_not_in_it() {
  const SampleProject sample;
  Workbench bench(sample.open(), {});
  constexpr std::size_t kLeftOut = 3;
  const auto runs = add_two_runs(bench, kLeftOut);
  QVERIFY(runs);
  QVERIFY(show(bench, runs->base));
  const ShownNumbers& shown = bench.shown_numbers;
  const Id fault = bench.document.faults().front().record.id;
  const auto numbers = shown.numbers(fault, kVariance);
  const std::size_t count = bench.surfaces.surface(fault)->faces.size();
  QCOMPARE(numbers->values.size(), count);
  for (std::size_t f = 0; f < count; ++f) {
    QCOMPARE(std::isnan(numbers->values[f]), f + kLeftOut >= count);
    QCOMPARE(static_cast<int>(numbers->stale[f]), 0);  // unknown, not old
  }
  QCOMPARE(shown.freshness(fault, kVariance), Freshness::kKept);
  // A statistic that was not computed.
  QVERIFY(shown.is_of_run("entropy"));
  QVERIFY(shown.numbers(fault, "entropy") == nullptr);
  QCOMPARE(shown.freshness(fault, "entropy"), Freshness::kPlain);
  QVERIFY(!shown.range({fault}, "entropy"));
}

void ShownNumbersTest::faces_that_moved_since_are_stale() {
  const SampleProject sample;
  Workbench bench(sample.open(), {});
  const auto runs = add_two_runs(bench);
  QVERIFY(runs);
  QVERIFY(show(bench, runs->base));
  const ShownNumbers& shown = bench.shown_numbers;
  const Id fault = bench.document.faults().front().record.id;
  const project::FaultRun stored = bench.document.project().fault_statistics(runs->base, fault);
  const survey::Pillar& pillar = bench.document.faults().front().pillars.front();
  QVERIFY(bench.document.edit("Move", [&](project::Interpretation& now) {
    now.move_pillar(pillar.id, {40, 0, 0});
  }));
  QVERIFY(has_surfaces(bench));
  const auto surface = bench.surfaces.surface(fault);
  const auto numbers = shown.numbers(fault, kVariance);
  std::map<std::pair<Id, std::int32_t>, std::size_t> of_run;
  for (std::size_t f = 0; f < stored.panels.size(); ++f) of_run[{stored.panels[f], stored.numbers[f]}] = f;
  std::size_t stale = 0;
  for (std::size_t f = 0; f < surface->faces.size(); ++f) {
    const auto then = of_run.find({surface->faces[f].panel, surface->faces[f].n});
    if (then == of_run.end()) {
      QVERIFY(std::isnan(numbers->values[f]) && numbers->stale[f] == 0);
      continue;
    }
    const bool moved = stored.lattice[then->second] != surface->lattice[f];
    QCOMPARE(numbers->values[f], stored.statistics.at("variance")[then->second]);
    QCOMPARE(numbers->stale[f] != 0, moved);
    QCOMPARE(numbers->hatched[f] != 0, moved);
    stale += moved ? 1 : 0;
  }
  QVERIFY(stale > 0);
  QCOMPARE(shown.freshness(fault, kVariance), Freshness::kStale);
  // While a hand is on it, too.
  auto pillars = bench.document.shown_pillars(fault);
  pillars.front().nodes.front().position.x += 25;
  bench.document.show_provisionally(fault, pillars);
  QCOMPARE(shown.freshness(fault, kVariance), Freshness::kStale);
  bench.document.end_provisional();
  QVERIFY(bench.document.undo());
  QVERIFY(has_surfaces(bench));
  QCOMPARE(shown.freshness(fault, kVariance), Freshness::kKept);
  QCOMPARE(shown.numbers(fault, kVariance)->values, stored.statistics.at("variance"));
}

void ShownNumbersTest::a_run_that_is_deleted_goes_back_to_now() {
  const SampleProject sample;
  Workbench bench(sample.open(), {});
  const auto runs = add_two_runs(bench);
  QVERIFY(runs);
  QVERIFY(show(bench, runs->base));
  const Id other = add_made_run(bench, "other", TwoRuns::of_base);
  bench.document.store().delete_run(other);
  Q_EMIT bench.document.runs_changed();
  QCOMPARE(bench.display.faces().run, runs->base);
  bench.document.store().delete_run(runs->base);
  Q_EMIT bench.document.runs_changed();
  QCOMPARE(bench.display.faces().run, Id{0});
  QVERIFY(!bench.shown_numbers.run());
  const Id fault = bench.document.faults().front().record.id;
  QCOMPARE(bench.shown_numbers.numbers(fault, kVariance)->values, known_now(bench, fault));
  // One that goes while it is being read is nothing to complain of.
  QSignalSpy failed(&bench.document, &Document::failed);
  bench.display.show_run(runs->newer);
  bench.display.show_run(0);
  bench.display.show_run(runs->newer);
  bench.document.store().delete_run(runs->newer);
  Q_EMIT bench.document.runs_changed();
  QCOMPARE(bench.display.faces().run, Id{0});
  QCOMPARE(failed.size(), 0);
  // One that never was says so, and changes nothing.
  bench.display.show_run(9999);
  QCOMPARE(failed.size(), 1);
  QCOMPARE(bench.display.faces().run, Id{0});
  QVERIFY(!bench.shown_numbers.run());
  QCOMPARE(bench.shown_numbers.numbers(fault, kVariance)->values, known_now(bench, fault));
}

void ShownNumbersTest::says_which_run_it_is() {
  const SampleProject sample;
  project::Project project = sample.open();
  project::VolumeRecord edges = project.volumes().front();
  edges.name = "edges";
  edges.checksum = "0123456789abcdef";
  const Id other = project.add_volume(edges);
  Workbench bench(std::move(project), {});
  const auto runs = add_two_runs(bench);
  QVERIFY(runs);
  QCOMPARE(bench.shown_numbers.origin(), QStringList());
  QVERIFY(show(bench, runs->base));
  const QStringList lines = bench.shown_numbers.origin();
  QCOMPARE(lines.size(), 2);
  QCOMPARE(lines[0], QStringLiteral("run base"));
  const QDateTime made =
      QDateTime::fromString(QString::fromStdString(bench.shown_numbers.run()->when), Qt::ISODate);
  QVERIFY(made.isValid());
  QCOMPARE(lines[1], made.toLocalTime().toString(QStringLiteral("yyyy-MM-dd HH:mm")));
  bench.display.set_volume(other);
  QCOMPARE(bench.shown_numbers.origin().size(), 3);
  QCOMPARE(bench.shown_numbers.origin()[2],
           QStringLiteral("of %1").arg(QString::fromStdString(bench.document.volumes().front().name)));
  project::RunRecord nameless;
  nameless.id = 7;
  QCOMPARE(words_for(nameless), QStringLiteral("run 7"));
  project::RunRecord numbered;
  numbered.name = "run 2";  // as jobs call a run without a name
  QCOMPARE(words_for(numbered), QStringLiteral("run 2"));
  nameless.live = true;
  QCOMPARE(words_for(nameless), QStringLiteral("run live"));
}

void ShownNumbersTest::is_shown_again_when_opened() {
  const SampleProject sample;
  Id base = 0;
  QJsonObject stored;
  {
    Workbench bench(sample.open(), {});
    const auto runs = add_two_runs(bench);
    QVERIFY(runs);
    base = runs->base;
    bench.display.show_run(base);
    stored = bench.display.to_json();
  }
  {
    Workbench again(sample.open(), {});
    QCOMPARE(again.display.faces().run, base);
    QVERIFY(again.shown_numbers.run());
    QVERIFY(has_surfaces(again));
    QTRY_VERIFY(!again.shown_numbers.is_reading());
    const Id fault = again.document.faults().front().record.id;
    QCOMPARE(again.shown_numbers.numbers(fault, kVariance)->values[1], TwoRuns::of_base(1));
    again.document.store().delete_run(base);  // as another program may
  }
  Workbench without(sample.open(), {});
  QCOMPARE(without.display.faces().run, Id{0});
  QVERIFY(!without.shown_numbers.run());
  QCOMPARE(without.display.faces().statistic, kVariance);  // the rest is taken
  without.display.from_json({{"faces", QJsonObject{{"run", "base"}}}});
  QCOMPARE(without.display.faces().run, Id{0});
}

static const RegisterTest<ShownNumbersTest> kRegistered;

}  // namespace footwall::ui

#include "shown_numbers_test.moc"
