// Colours with a real engine: the same numbers as a batch run, following a hand, and going on after the
// engine's death.
#include <QSignalSpy>
#include <QTest>
#include <cmath>
#include <csignal>

#include "engine/service/client/engine_client.h"
#include "engine/synthetic/registry.h"
#include "engine/tasks/add_volume.h"
#include "engine/tasks/extract_run.h"
#include "engine/tasks/volume_sources.h"
#include "ui/made_runs.h"
#include "ui/model/accept_shift.h"
#include "ui/model/engine_link.h"
#include "ui/model/fault_commands.h"
#include "ui/model/surfaces.h"
#include "ui/model/tour.h"
#include "ui/model/update_all.h"
#include "ui/sample_project.h"
#include "ui/test_class.h"

namespace footwall::ui {

constexpr int kPatience = 60000;

// A project whose first fault gets its colours from an engine.
struct Coloured {
  explicit Coloured(const SampleProject& sample, int ranks)
      : document(sample.open()),
        engine(document, {.ranks = ranks, .connection = {}}),
        surfaces(document, &engine) {
    engine.start();
  }
  Id fault() const { return document.faults()[0].record.id; }
  bool is_fresh() const {
    return surfaces.is_settled() && surfaces.freshness(fault(), "variance") == Freshness::kFresh;
  }
  Document document;
  EngineLink engine;
  Surfaces surfaces;
};

class LiveColoursTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void a_picture_asked_for_before_the_engine_runs_comes();
  void surfaces_are_made_without_an_engine();
  void numbers_are_those_of_a_run();
  void offsets_come_when_the_hand_rests();
  void colours_follow_a_hand_and_go_on_after_a_death();
  void a_live_run_is_there_again_when_opened();
  void update_all_computes_and_keeps();
  void an_update_can_be_cancelled();
  void numbers_of_another_volume_are_stale();
  void an_update_goes_by_what_is_known_now_while_a_run_is_shown();
};

void LiveColoursTest::surfaces_are_made_without_an_engine() {
  const SampleProject sample;
  Document document(sample.open());
  Surfaces surfaces(document, nullptr);
  const Id fault = document.faults()[0].record.id;
  QTRY_VERIFY_WITH_TIMEOUT(surfaces.is_settled() && surfaces.surface(fault) != nullptr, kPatience);
  QVERIFY(!document.project().mesh_is_stale(fault));  // kept
  QCOMPARE(surfaces.freshness(fault, "variance"), Freshness::kPlain);
  QCOMPARE(surfaces.freshness(fault, "area_voxels"), Freshness::kFresh);  // needs no voxels
  QVERIFY(surfaces.range({fault}, "area_voxels").has_value());
  // A fault that loses its pillars loses its surface, and an undo brings both back.
  std::vector<Id> pillars;
  for (const auto& pillar : document.faults()[0].pillars) pillars.push_back(pillar.id);
  document.edit("delete", [&](project::Interpretation& now) {
    for (const Id pillar : pillars) now.delete_pillar(pillar);
  });
  QTRY_VERIFY_WITH_TIMEOUT(surfaces.surface(fault) == nullptr, kPatience);
  document.undo();
  QTRY_VERIFY_WITH_TIMEOUT(surfaces.surface(fault) != nullptr, kPatience);
}

void LiveColoursTest::a_picture_asked_for_before_the_engine_runs_comes() {
  const SampleProject sample;
  Document document(sample.open());
  EngineLink engine(document, {.ranks = 1, .connection = {}});
  QSignalSpy pictures(&engine, &EngineLink::picture);
  QSignalSpy failed(&engine, &EngineLink::failed);
  PictureRequest wanted;
  wanted.perspective = false;
  wanted.width = wanted.height = 32;
  // Straight down on the middle sample: clip space from voxels, and the volume's index space is the scene.
  wanted.view_projection = {2. / 48, 0, 0, -1, 0, 2. / 40, 0, -1, 0, 0, 1. / 64, 0, 0, 0, 0, 1};
  wanted.eye = {24, 20, 100};
  wanted.right = {1, 0, 0};
  wanted.up = {0, 1, 0};
  wanted.forward = {0, 0, -1};
  wanted.isosurfaces.push_back({.volume = document.volumes().front().id,
                                .value = 0.5F,
                                .colour = qRgb(200, 100, 50),
                                .linear = {1, 0, 0, 0, 1, 0, 0, 0, 1}});
  const std::uint64_t number = engine.draw(wanted);
  QVERIFY(number != 0);
  QTest::qWait(50);  // the link has found out that there is no engine; if not, the picture comes all the same
  engine.start();
  const auto whole = [&] {
    return std::ranges::any_of(pictures, [&](const QList<QVariant>& said) {
      const auto picture = said.front().value<std::shared_ptr<const Picture>>();
      return picture->request == number && picture->last;
    });
  };
  QTRY_VERIFY_WITH_TIMEOUT(whole(), kPatience);
  QCOMPARE(failed.size(), 0);
}

void LiveColoursTest::numbers_are_those_of_a_run() {
  const SampleProject sample;
  Document document(sample.open());
  EngineLink engine(document, {.ranks = 2, .connection = {}});
  Surfaces surfaces(document, &engine);
  QSignalSpy failed(&engine, &EngineLink::failed);
  engine.start();
  const auto all_fresh = [&] {
    return std::ranges::all_of(document.faults(), [&](const Fault& fault) {
      return surfaces.freshness(fault.record.id, "variance") == Freshness::kFresh;
    });
  };
  QTRY_VERIFY_WITH_TIMEOUT(all_fresh(), kPatience);
  QCOMPARE(failed.size(), 0);
  QCOMPARE(engine.ranks(), 2);
  engine.stop();
  const tasks::Extracted run = tasks::extract_run(document.store(), {}, {});
  for (const Fault& fault : document.faults()) {
    const project::FaultRun expected = document.project().fault_statistics(run.run, fault.record.id);
    const auto surface = surfaces.surface(fault.record.id);
    QCOMPARE(surface->faces.size(), expected.panels.size());
    for (const char* name : {"count", "mean", "variance", "min", "max", "contrast", "area", "dip"}) {
      const auto numbers = surfaces.numbers(fault.record.id, name);
      QVERIFY2(numbers != nullptr, name);
      const std::vector<double>& values = expected.statistics.at(name);
      for (std::size_t f = 0; f < values.size(); ++f) {
        QCOMPARE(surface->faces[f].panel, expected.panels[f]);
        QVERIFY2(values[f] == numbers->values[f] || (std::isnan(values[f]) && std::isnan(numbers->values[f])),
                 name);
      }
    }
  }
}

void LiveColoursTest::offsets_come_when_the_hand_rests() {
  const SampleProject sample;
  Coloured desk(sample, 2);
  Document& document = desk.document;
  Surfaces& surfaces = desk.surfaces;
  const Id fault = desk.fault();
  const auto fresh = [&](Id id) { return surfaces.freshness(id, "offset_voxels") == Freshness::kFresh; };
  const auto all_fresh = [&] {
    return std::ranges::all_of(document.faults(), [&](const Fault& one) { return fresh(one.record.id); });
  };
  QTRY_VERIFY_WITH_TIMEOUT(desk.is_fresh() && all_fresh(), kPatience);
  // 1. They are those of a run.
  tasks::ExtractOptions options;
  options.engine.compute = {"offset"};
  const tasks::Extracted run = tasks::extract_run(document.store(), options, {});
  for (const Fault& one : document.faults()) {
    const project::FaultRun expected = document.project().fault_statistics(run.run, one.record.id);
    for (const char* name : {"offset_voxels", "offset_score"}) {
      const std::vector<double>& values = expected.statistics.at(name);
      const auto numbers = surfaces.numbers(one.record.id, name);
      QVERIFY(numbers != nullptr);
      QCOMPARE(numbers->values.size(), values.size());
      for (std::size_t f = 0; f < values.size(); ++f) {
        QVERIFY(values[f] == numbers->values[f] || (std::isnan(values[f]) && std::isnan(numbers->values[f])));
      }
    }
  }
  const auto range = surfaces.range({fault}, "offset_voxels");
  QVERIFY(range.has_value() && range->first == -range->second && range->second > 0);  // zero in the middle
  // 2. Under a hand those of moved faces are old, and say so; others of the fault are as they were.
  std::vector<survey::Pillar> pillars = document.faults()[0].pillars;
  pillars[0].nodes[0].position.x += 60;
  document.show_provisionally(fault, pillars);
  const auto is_half_stale = [&] {
    const auto numbers = surfaces.numbers(fault, "offset_voxels");
    return surfaces.is_settled() && numbers != nullptr && std::ranges::count(numbers->stale, 1) > 0;
  };
  QTRY_VERIFY_WITH_TIMEOUT(is_half_stale(), kPatience);
  QCOMPARE(surfaces.freshness(fault, "offset_voxels"), Freshness::kFollowing);
  document.end_provisional();
  QTRY_VERIFY_WITH_TIMEOUT(desk.is_fresh() && all_fresh(), kPatience);
  // 3. A face is moved to where its offset says: one step of the history, and its new offset is known soon.
  const auto surface = surfaces.surface(fault);
  const auto stops = farthest_faces(*surface, *surfaces.numbers(fault, "offset_voxels"));
  QVERIFY(!stops.empty());
  Selection selection(document);
  selection.select(stops[0].face);
  QVERIFY(shift_hint(document, surfaces, selection).contains("Enter moves this face by"));
  const std::size_t steps = document.history().size();
  lock_faults(document, {fault}, true);
  QSignalSpy failed(&document, &Document::failed);
  QVERIFY(!accept_shift(document, surfaces, selection));
  QVERIFY(failed.takeLast()[0].toString().contains("locked"));
  lock_faults(document, {fault}, false);
  QTRY_VERIFY_WITH_TIMEOUT(desk.is_fresh() && all_fresh(), kPatience);
  QVERIFY(accept_shift(document, surfaces, selection));
  QCOMPARE(document.history().size(), steps + 3);
  QVERIFY(QString::fromStdString(document.history().back().name).startsWith("Accept shift"));
  QTRY_VERIFY_WITH_TIMEOUT(desk.is_fresh() && all_fresh(), kPatience);
}

void LiveColoursTest::colours_follow_a_hand_and_go_on_after_a_death() {
  const SampleProject sample;
  Coloured desk(sample, 2);
  Document& document = desk.document;
  Surfaces& surfaces = desk.surfaces;
  const Id fault = desk.fault();
  QTRY_VERIFY_WITH_TIMEOUT(desk.is_fresh(), kPatience);
  const auto before = surfaces.numbers(fault, "variance");
  // 1. A hand moves a node to and fro: numbers arrive while it does, and are known to be of a hand.
  std::vector<survey::Pillar> pillars = document.faults()[0].pillars;
  const survey::Pillar pillar = pillars[1];
  QSignalSpy numbers(&surfaces, &Surfaces::numbers_changed);
  for (int n = 1; n <= 20; ++n) {
    pillars[1].nodes[1].position.x = pillar.nodes[1].position.x + n;
    document.show_provisionally(fault, pillars);
    QCOMPARE(surfaces.freshness(fault, "variance"), Freshness::kFollowing);
    QTest::qWait(5);
  }
  QTRY_VERIFY_WITH_TIMEOUT(!numbers.empty(), kPatience);
  // 2. Esc: the stored colours again.
  document.end_provisional();
  QTRY_VERIFY_WITH_TIMEOUT(desk.is_fresh(), kPatience);
  QCOMPARE(surfaces.numbers(fault, "variance")->values, before->values);
  // 3. The engine's ranks are killed; the next gesture gets its colours all the same.
  const auto status = service::EngineClient(*desk.engine.connection()).status();
  for (const auto& rank : status.each_rank()) ::kill(rank.process(), SIGKILL);
  document.edit("Move node", [&](project::Interpretation& now) {
    survey::WorldPoint p = pillar.nodes[1].position;
    p.x += 30;
    now.move_node(pillar.nodes[1].id, p);
  });
  const auto moved = [&] {
    return desk.is_fresh() && surfaces.numbers(fault, "variance")->values != before->values;
  };
  QTRY_VERIFY_WITH_TIMEOUT(moved(), kPatience);
}

void LiveColoursTest::a_live_run_is_there_again_when_opened() {
  const SampleProject sample;
  std::vector<double> known;
  {
    Coloured desk(sample, 1);
    QTRY_VERIFY_WITH_TIMEOUT(desk.is_fresh(), kPatience);
    known = desk.surfaces.numbers(desk.fault(), "variance")->values;
    desk.surfaces.store_live_run();
  }
  Document document(sample.open());
  Surfaces surfaces(document, nullptr);
  const Id fault = document.faults()[0].record.id;
  QTRY_COMPARE_WITH_TIMEOUT(surfaces.freshness(fault, "variance"), Freshness::kFresh, kPatience);
  QCOMPARE(surfaces.numbers(fault, "variance")->values, known);
}

void LiveColoursTest::update_all_computes_and_keeps() {
  const SampleProject sample;
  Workbench bench(sample.open(), {.ranks = 1, .connection = {}});
  QCOMPARE(bench.engine.state(), EngineLink::State::kOff);
  QSignalSpy ended(&bench.jobs, &Jobs::finished);
  QSignalSpy runs(&bench.document, &Document::runs_changed);
  const int job = start_update(bench);
  QCOMPARE(start_update(bench), job);  // one at a time
  QVERIFY(ended.wait(kPatience));
  QVERIFY2(ended[0][1].value<Jobs::State>() == Jobs::State::kDone, qPrintable(ended[0][2].toString()));
  QCOMPARE(runs.size(), 1);
  for (const Fault& fault : bench.document.faults()) {
    QCOMPARE(bench.surfaces.freshness(fault.record.id, "variance"), Freshness::kFresh);
  }
  const auto stored = bench.document.project().runs();
  QCOMPARE(stored.size(), std::size_t{1});
  QVERIFY(stored[0].live);
  const Fault& fault = bench.document.faults()[0];
  const auto kept = bench.document.project().fault_statistics(stored[0].id, fault.record.id);
  const auto numbers = bench.surfaces.numbers(fault.record.id, "variance");
  QCOMPARE(kept.statistics.at("variance").size(), numbers->values.size());
  for (std::size_t f = 0; f < numbers->values.size(); ++f) {
    QVERIFY(kept.statistics.at("variance")[f] == numbers->values[f] || std::isnan(numbers->values[f]));
  }
  // Again with nothing to do: at once, and the live run is still one.
  QVERIFY(start_update(bench) != job);
  QTRY_COMPARE_WITH_TIMEOUT(ended.size(), 2, kPatience);
  QCOMPARE(ended[1][1].value<Jobs::State>(), Jobs::State::kDone);
  QCOMPARE(bench.document.project().runs().size(), std::size_t{1});
}

void LiveColoursTest::an_update_can_be_cancelled() {
  const SampleProject sample;
  Workbench bench(sample.open(), {.ranks = 1, .connection = {}});
  QSignalSpy ended(&bench.jobs, &Jobs::finished);
  const int job = start_update(bench);
  bench.jobs.cancel(job);
  QVERIFY(ended.wait(kPatience));
  QCOMPARE(ended[0][1].value<Jobs::State>(), Jobs::State::kCancelled);
  QVERIFY(bench.document.project().runs().empty());
  const int another = start_update(bench);
  QVERIFY(another != job);
  bench.jobs.cancel(another);
  QTRY_COMPARE_WITH_TIMEOUT(ended.size(), 2, kPatience);
}

void LiveColoursTest::numbers_of_another_volume_are_stale() {
  const SampleProject sample;
  auto project = sample.open();
  synthetic::Options options;
  options.size = {48, 40, 64};
  options.seed = 99;
  const synthetic::FaultedSurvey made = synthetic::make_survey("faulted", options);
  const project::VolumeRecord other =
      tasks::add_volume(project, "another", tasks::synthetic_source(made, "another"), {});
  Workbench bench(std::move(project), {.ranks = 1, .connection = {}});
  const Id fault = bench.document.faults()[0].record.id;
  QSignalSpy ended(&bench.jobs, &Jobs::finished);
  start_update(bench);
  QVERIFY(ended.wait(kPatience));
  const auto before = bench.surfaces.numbers(fault, "variance")->values;
  bench.display.set_volume(other.id);
  QVERIFY(bench.surfaces.freshness(fault, "variance") != Freshness::kFresh);
  start_update(bench);
  QTRY_COMPARE_WITH_TIMEOUT(ended.size(), 2, kPatience);
  QCOMPARE(ended[1][1].value<Jobs::State>(), Jobs::State::kDone);
  QVERIFY(bench.surfaces.numbers(fault, "variance")->values != before);
  const auto runs = bench.document.project().runs();  // a live one of each
  QCOMPARE(runs.size(), std::size_t{2});
  QCOMPARE(runs[1].volume, std::string("another"));
  QCOMPARE(bench.document.project().fault_statistics(runs[0].id, fault).statistics.at("variance"), before);
}

void LiveColoursTest::an_update_goes_by_what_is_known_now_while_a_run_is_shown() {
  const SampleProject sample;
  Workbench bench(sample.open(), {.ranks = 1, .connection = {}});
  QVERIFY(has_surfaces(bench));
  const auto made_up = [](std::size_t face) { return 1000 + static_cast<double>(face); };
  const Id run = add_made_run(bench, "made up", made_up);
  bench.display.show_run(run);
  const Id fault = bench.document.faults()[0].record.id;
  const survey::Pillar& pillar = bench.document.faults()[0].pillars.front();
  QVERIFY(bench.document.edit("Move", [&](project::Interpretation& now) {
    now.move_pillar(pillar.id, {40, 0, 0});
  }));
  QSignalSpy ended(&bench.jobs, &Jobs::finished);
  start_update(bench);
  QVERIFY(ended.wait(kPatience));
  QCOMPARE(ended[0][1].value<Jobs::State>(), Jobs::State::kDone);
  // The engine has answered; what is shown is the run's still, and old where the faces moved.
  QCOMPARE(bench.display.faces().run, run);
  QCOMPARE(bench.surfaces.freshness(fault, "variance"), Freshness::kFresh);
  QCOMPARE(bench.shown_numbers.freshness(fault, "variance"), Freshness::kStale);
  const auto shown = bench.shown_numbers.numbers(fault, "variance");
  QCOMPARE(std::ranges::count_if(shown->values, [](double value) { return value < 1000; }), 0);
  // The live run has the engine's numbers and none of the run's.
  const project::RunRecord live = bench.document.project().run(std::nullopt);
  QVERIFY(live.live && live.id != run);
  const auto stored = bench.document.project().fault_statistics(live.id, fault).statistics.at("variance");
  QCOMPARE(stored.size(), shown->values.size());
  QCOMPARE(std::ranges::count_if(stored, [](double value) { return value >= 1000; }), 0);
  QVERIFY(std::ranges::any_of(stored, [](double value) { return value > 0; }));
}

static const RegisterTest<LiveColoursTest> kRegistered;

}  // namespace footwall::ui

#include "live_colours_test.moc"
