#include "ui/window/assign_menu.h"

#include <QMenu>
#include <QTest>

#include "ui/model/fault_commands.h"
#include "ui/sample_project.h"
#include "ui/test_class.h"
#include "ui/window/main_window.h"

namespace footwall::ui {
namespace {

// A window over a project with two pillars that belong to no fault.
struct Loose {
  Loose() {
    window.resize(1200, 800);
    window.show();
    is_open = window.open_project(QString::fromStdString(sample.path().string()));
    if (!is_open) return;
    Document& document = window.workbench()->document;
    const survey::Geometry survey = *document.survey();
    document.edit(QStringLiteral("Pick"), [&](project::Interpretation& now) {
      const Id unassigned = now.add_fault(kUnassigned);
      for (const double j : {10.0, 14.0}) {
        const std::array nodes{survey.world_of({20, j, 10}), survey.world_of({20, j, 40})};
        pillars.insert(now.add_pillar(unassigned, survey::PillarKind::kInterpreted, nodes).id);
      }
    });
    steps = document.history().size();
  }
  QMenu* menu() const { return window.findChild<QMenu*>(QStringLiteral("assign")); }
  // Clicks the line of this text; false where there is none.
  bool choose(const QString& text) const {
    if (menu() == nullptr || !QTest::qWaitFor([this] { return menu()->isVisible(); })) return false;
    for (QAction* action : menu()->actions()) {
      if (action->text() != text) continue;
      QTest::mouseClick(menu(), Qt::LeftButton, {}, menu()->actionGeometry(action).center());
      return QTest::qWaitFor([this] { return menu() == nullptr; });
    }
    return false;
  }

  SampleProject sample;
  MainWindow window{{}};
  std::set<Id> pillars;
  std::size_t steps = 0;
  bool is_open = false;
};

}  // namespace

class AssignMenuTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void a_lasso_makes_a_fault_in_one_step();
  void a_lasso_gives_pillars_to_the_active_fault();
  void select_only_changes_nothing();
  void what_belongs_to_a_fault_is_not_asked_about();
};

void AssignMenuTest::a_lasso_makes_a_fault_in_one_step() {
  Loose loose;
  QVERIFY(loose.is_open);
  Workbench& bench = *loose.window.workbench();
  const std::size_t faults = bench.document.faults().size();
  bench.selection.select_by_lasso({}, loose.pillars, {});
  QVERIFY(loose.choose(QStringLiteral("New fault")));
  QCOMPARE(bench.document.faults().size(), faults + 1);
  QCOMPARE(bench.document.history().size(), loose.steps + 1);
  const Fault& made = bench.document.faults().back();
  QCOMPARE(made.pillars.size(), std::size_t{2});
  QCOMPARE(bench.selection.active_fault(), made.record.id);
  QVERIFY(bench.document.undo());
  QVERIFY(is_unassigned(*bench.document.fault_of_pillar(*loose.pillars.begin())));
}

void AssignMenuTest::a_lasso_gives_pillars_to_the_active_fault() {
  Loose loose;
  QVERIFY(loose.is_open);
  Workbench& bench = *loose.window.workbench();
  const Id locked = bench.document.faults()[0].record.id;
  const Id active = bench.document.faults()[1].record.id;
  const auto name_of = [&](Id fault) {
    return QString::fromStdString(bench.document.fault(fault)->record.name);
  };
  lock_faults(bench.document, {locked}, true);
  bench.selection.set_active_fault(active);
  const std::size_t steps = bench.document.history().size();
  bench.selection.select_by_lasso({}, loose.pillars, {});
  QVERIFY(loose.menu() != nullptr);
  QStringList texts;
  for (const QAction* action : loose.menu()->actions()) {
    if (!action->isSeparator()) texts.append(action->text());
  }
  QCOMPARE(texts.first(), QStringLiteral("New fault"));
  QCOMPARE(texts[1], name_of(active));
  QCOMPARE(texts.last(), QStringLiteral("Select only"));
  QVERIFY(!texts.contains(name_of(locked)) && !texts.contains(QLatin1String(kUnassigned)));
  QVERIFY(loose.choose(name_of(active)));
  QCOMPARE(bench.document.history().size(), steps + 1);
  for (const Id pillar : loose.pillars) QCOMPARE(bench.document.fault_of_pillar(pillar)->record.id, active);
}

void AssignMenuTest::select_only_changes_nothing() {
  Loose loose;
  QVERIFY(loose.is_open);
  Workbench& bench = *loose.window.workbench();
  bench.selection.select_by_lasso({}, loose.pillars, {});
  QVERIFY(loose.choose(QStringLiteral("Select only")));
  QCOMPARE(bench.document.history().size(), loose.steps);
  QCOMPARE(bench.selection.pillars(), loose.pillars);
}

void AssignMenuTest::what_belongs_to_a_fault_is_not_asked_about() {
  Loose loose;
  QVERIFY(loose.is_open);
  Workbench& bench = *loose.window.workbench();
  const Id owned = bench.document.faults()[0].pillars[0].id;
  bench.selection.select_by_lasso({}, {owned}, {});
  QVERIFY(loose.menu() == nullptr);
  // Of what was caught only the pillars without a fault are given to one.
  const Id owner = bench.document.fault_of_pillar(owned)->record.id;
  std::set<Id> all = loose.pillars;
  all.insert(owned);
  bench.selection.select_by_lasso({}, all, {});
  QCOMPARE(bench.selection.pillars(), all);
  QVERIFY(loose.choose(QStringLiteral("New fault")));
  QCOMPARE(bench.document.fault_of_pillar(owned)->record.id, owner);
  QCOMPARE(bench.document.faults().back().pillars.size(), std::size_t{2});
}

static const RegisterTest<AssignMenuTest> kRegistered;

}  // namespace footwall::ui

#include "assign_menu_test.moc"
