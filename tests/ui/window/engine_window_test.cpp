// The window when its engine dies, cannot be started, or comes back: no edit is lost, and no old colour is
// taken for a new one.
#include <QTest>
#include <csignal>

#include "engine/service/client/engine_client.h"
#include "ui/model/surfaces.h"
#include "ui/sample_project.h"
#include "ui/test_class.h"
#include "ui/window/banner.h"
#include "ui/window/main_window.h"

namespace footwall::ui {
namespace {

constexpr int kPatience = 60000;
const QString kBanner = QStringLiteral("engine");

// A window on a project of its own, and what a user does and sees there.
struct Desk {
  Desk() {
    window.resize(1200, 800);
    window.show();
    opened = window.open_project(QString::fromStdString(sample.path().string()));
  }
  Workbench& bench() { return *window.workbench(); }
  Id fault() { return bench().document.faults().front().record.id; }
  Freshness freshness() { return bench().surfaces.freshness(fault(), QStringLiteral("variance")); }
  bool is_fresh() { return bench().surfaces.is_settled() && freshness() == Freshness::kFresh; }
  bool is_lost() { return bench().engine.state() == EngineLink::State::kLost; }
  void kill_engine() {
    const auto status = service::EngineClient(*bench().engine.connection()).status();
    for (const auto& rank : status.each_rank()) ::kill(rank.process(), SIGKILL);
  }
  survey::PillarNode node() { return bench().document.faults().front().pillars[1].nodes[1]; }
  // As one gesture; whether it is on disk.
  bool move_node(double by) {
    const survey::PillarNode before = node();
    survey::WorldPoint p = before.position;
    p.x += by;
    const bool done = bench().document.edit(
        QStringLiteral("Move node"), [&](project::Interpretation& now) { now.move_node(before.id, p); });
    return done && sample.open(project::OpenMode::kRead).pillars(fault())[1].nodes[1].position.x == p.x;
  }

  SampleProject sample;
  MainWindow window{{.ranks = 1, .starts_at_once = true}};
  bool opened = false;
};

}  // namespace

class EngineWindowTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void cleanup() { qputenv("PATH", path_); }
  void comes_back_by_itself_after_a_death();
  void gives_up_after_three_deaths_and_starts_again_when_asked();
  void edits_without_an_engine_that_cannot_be_started();
  void goes_on_without_the_volume_that_it_computes_on();

 private:
  const QByteArray path_ = qgetenv("PATH");
};

void EngineWindowTest::comes_back_by_itself_after_a_death() {
  Desk desk;
  QVERIFY(desk.opened);
  QTRY_VERIFY_WITH_TIMEOUT(desk.is_fresh(), kPatience);
  const auto before = desk.bench().surfaces.numbers(desk.fault(), QStringLiteral("variance"));
  desk.kill_engine();
  QVERIFY(desk.move_node(40));
  // The surface follows at once; the colours of what moved are old until the next engine has them.
  QVERIFY(desk.freshness() == Freshness::kFresh);  // nothing was made anew yet
  const std::int64_t revision = desk.bench().document.faults().front().record.revision;
  const auto has_new_surface = [&] {
    const auto surface = desk.bench().surfaces.surface(desk.fault());
    return surface != nullptr && surface->revision == revision;
  };
  QTRY_VERIFY_WITH_TIMEOUT(has_new_surface(), kPatience);
  QVERIFY(desk.freshness() != Freshness::kFresh);
  QTRY_VERIFY_WITH_TIMEOUT(desk.is_fresh(), kPatience);
  QVERIFY(desk.bench().surfaces.numbers(desk.fault(), QStringLiteral("variance"))->values != before->values);
  QVERIFY(!desk.window.banners().has(kBanner));
  // The step that was made meanwhile can be taken back, and its colours come too.
  QVERIFY(desk.bench().document.undo());
  const auto is_as_before = [&] {
    return desk.is_fresh() &&
           desk.bench().surfaces.numbers(desk.fault(), QStringLiteral("variance"))->values == before->values;
  };
  QTRY_VERIFY_WITH_TIMEOUT(is_as_before(), kPatience);
}

void EngineWindowTest::gives_up_after_three_deaths_and_starts_again_when_asked() {
  Desk desk;
  QVERIFY(desk.opened);
  int starts = 0;
  connect(&desk.bench().engine, &EngineLink::state_changed, this,
          [&] { starts += desk.bench().engine.state() == EngineLink::State::kStarting ? 1 : 0; });
  const auto is_ready = [&] {
    return desk.is_fresh() && desk.bench().engine.state() == EngineLink::State::kReady;
  };
  for (int death = 0; death < 3; ++death) {
    QTRY_VERIFY_WITH_TIMEOUT(is_ready(), kPatience);
    const int before = starts;
    desk.kill_engine();
    QTRY_VERIFY_WITH_TIMEOUT(starts > before, kPatience);
  }
  QTRY_VERIFY_WITH_TIMEOUT(desk.is_lost(), kPatience);
  QVERIFY(desk.window.banners().has(kBanner));
  QVERIFY2(desk.window.banners().text(kBanner).contains(QStringLiteral("three times")),
           qPrintable(desk.window.banners().text(kBanner)));
  // Faults stay editable; what was moved is marked as old, what was not keeps its colours.
  QCOMPARE(desk.freshness(), Freshness::kFresh);
  QVERIFY(desk.move_node(40));
  QTRY_COMPARE_WITH_TIMEOUT(desk.freshness(), Freshness::kStale, kPatience);
  const auto numbers = desk.bench().surfaces.numbers(desk.fault(), QStringLiteral("variance"));
  QVERIFY(std::ranges::count(numbers->stale, 1) > 0);
  QVERIFY(desk.window.banners().press(kBanner, 0));
  QTRY_VERIFY_WITH_TIMEOUT(desk.is_fresh(), kPatience);
  QVERIFY(!desk.window.banners().has(kBanner));
}

void EngineWindowTest::edits_without_an_engine_that_cannot_be_started() {
  qputenv("PATH", "/nowhere");  // where mpirun is not
  Desk desk;
  QVERIFY(desk.opened);
  QTRY_VERIFY_WITH_TIMEOUT(desk.is_lost(), kPatience);
  QVERIFY(desk.window.banners().has(kBanner));
  QVERIFY2(desk.window.banners().text(kBanner).contains(QStringLiteral("can be edited")),
           qPrintable(desk.window.banners().text(kBanner)));
  QTRY_VERIFY_WITH_TIMEOUT(desk.bench().surfaces.surface(desk.fault()) != nullptr, kPatience);
  QCOMPARE(desk.freshness(), Freshness::kPlain);
  const auto before = desk.bench().surfaces.surface(desk.fault());
  QVERIFY(desk.move_node(40));
  QTRY_VERIFY_WITH_TIMEOUT(desk.bench().surfaces.surface(desk.fault()) != before, kPatience);
  QCOMPARE(desk.freshness(), Freshness::kPlain);
  // Once it can be started, the banner's button does.
  qputenv("PATH", path_);
  QVERIFY(desk.window.banners().press(kBanner, 0));
  QTRY_VERIFY_WITH_TIMEOUT(desk.is_fresh(), kPatience);
  QVERIFY(!desk.window.banners().has(kBanner));
}

void EngineWindowTest::goes_on_without_the_volume_that_it_computes_on() {
  Desk desk;
  QVERIFY(desk.opened);
  QTRY_VERIFY_WITH_TIMEOUT(desk.is_fresh(), kPatience);
  project::VolumeRecord again = desk.bench().document.volumes().front();
  const Id first = again.id;
  QCOMPARE(desk.bench().engine.volume(), first);
  again.name = "the same again";
  const Id second = desk.bench().document.store().add_volume(again);
  desk.bench().document.reload_volumes();
  desk.bench().document.store().delete_volume(first);
  desk.bench().document.reload_volumes();
  QCOMPARE(desk.bench().engine.volume(), second);
  QVERIFY(desk.move_node(40));
  QTRY_VERIFY_WITH_TIMEOUT(desk.is_fresh(), kPatience);
  // The last one: edits go on without colours, and the engine is not thought dead.
  desk.bench().document.store().delete_volume(second);
  desk.bench().document.reload_volumes();
  QCOMPARE(desk.bench().engine.volume(), 0);
  QVERIFY(desk.move_node(80));
  QTRY_VERIFY_WITH_TIMEOUT(desk.freshness() != Freshness::kFresh, kPatience);
  QVERIFY(!desk.window.banners().has(kBanner));
}

static const RegisterTest<EngineWindowTest> kRegistered;

}  // namespace footwall::ui

#include "engine_window_test.moc"
