// The models that views show, watched by Qt's own tester while a hand edits at random, jobs come and go, and
// an engine answers: each change is announced as it happens.
#include <QAbstractItemModelTester>
#include <QTest>

#include <algorithm>

#include "rounds.h"
#include "ui/crowded_project.h"
#include "ui/model/history_list.h"
#include "ui/model/project_tree.h"
#include "ui/model/workbench.h"
#include "ui/random_hand.h"
#include "ui/test_class.h"

namespace footwall::ui {

class ModelsTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void announce_what_changes();
};

void ModelsTest::announce_what_changes() {
  const SampleProject sample;
  {
    project::Project project = sample.open();
    interpolate_samples(project, 6);
  }
  Workbench bench(sample.open(), {.ranks = 1, .starts_at_once = true});
  HistoryList history(bench.document);
  ProjectTree tree(bench.document, bench.display);
  const QAbstractItemModelTester of_history(&history, QAbstractItemModelTester::FailureReportingMode::QtTest);
  const QAbstractItemModelTester of_tree(&tree, QAbstractItemModelTester::FailureReportingMode::QtTest);
  const QAbstractItemModelTester of_jobs(&bench.jobs, QAbstractItemModelTester::FailureReportingMode::QtTest);
  const auto done = [&] {
    return std::ranges::count_if(bench.document.history(), [](const auto& step) { return !step.undone; });
  };
  const auto at_first = done();
  RandomHand hand(bench.document, bench.selection, bench.picking, 8);
  std::mt19937 random(8);
  const auto some_row = [&](const QModelIndex& heading) {
    const int rows = tree.rowCount(heading);
    return rows == 0 ? QModelIndex()
                     : tree.index(static_cast<int>(random() % static_cast<unsigned>(rows)), 0, heading);
  };
  int answers = 0, ended = 0;
  connect(&bench.engine, &EngineLink::numbers, this, [&] { ++answers; });
  connect(&bench.jobs, &Jobs::finished, this, [&] { ++ended; });

  int started = 0;
  for (int n = 0; n < rounds(150); ++n) {
    hand.act();
    // The tree's own ways: boxes, names, removals; what only the display has.
    const QModelIndex fault = some_row(tree.index(1, 0));
    const QModelIndex isosurface = some_row(tree.index(2, 0));
    switch (n % 6) {
      case 0:
        tree.setData(fault, n % 4 == 0 ? Qt::Checked : Qt::Unchecked, Qt::CheckStateRole);
        break;
      case 1:
        tree.setData(fault, QStringLiteral("name %1").arg(n), Qt::EditRole);
        break;
      case 2:
        bench.display.add_isosurface(bench.display.volume(), n * 0.01);
        break;
      case 3:
        tree.setData(isosurface, Qt::Unchecked, Qt::CheckStateRole);
        if (n % 5 == 0 && isosurface.isValid()) tree.remove({tree.item_of(isosurface)});
        break;
      case 4: {
        project::ViewRecord view;
        view.name = "view " + std::to_string(n % 9);
        view.camera = "30,20,1";
        bench.document.store().save_view(view);
        Q_EMIT bench.document.views_changed();
        break;
      }
      default: {
        ++started;
        const bool fails = n % 4 == 1;
        const int job = bench.jobs.start(QStringLiteral("job %1").arg(n), [fails](const JobContext& context) {
          for (int step = 0; step < 20; ++step) {
            context.check();
            context.report(step / 20.0, "counts", "some");
          }
          if (fails) throw Error(ErrorCode::kInvalid, "it was to fail");
        });
        if (n % 3 == 0) bench.jobs.cancel(job);
        if (n % 12 == 11) bench.jobs.clear_finished();
      }
    }
    QCoreApplication::processEvents();
  }
  QTRY_COMPARE_WITH_TIMEOUT(ended, started, 30000);
  bench.jobs.clear_finished();
  QCOMPARE(bench.jobs.rowCount(), 0);
  QTRY_VERIFY_WITH_TIMEOUT(answers > 0 && bench.surfaces.is_settled(), 60000);
  // The hand may have left no fault that can be triangulated. The first ones can be.
  while (done() > at_first) bench.document.undo();
  QTRY_VERIFY_WITH_TIMEOUT(bench.surfaces.live_run().has_value(), 60000);
  bench.surfaces.store_live_run();
  Q_EMIT bench.document.runs_changed();
  QVERIFY(tree.rowCount(tree.index(3, 0)) > 0);
  // What the models show in the end is what there is.
  QCOMPARE(history.rowCount(), static_cast<int>(bench.document.history().size()) + 1);
  QCOMPARE(tree.rowCount(tree.index(1, 0)), static_cast<int>(bench.document.faults().size()));
  QCOMPARE(tree.rowCount(tree.index(2, 0)), static_cast<int>(bench.display.isosurfaces().size()));
}

static const RegisterTest<ModelsTest> kRegistered;

}  // namespace footwall::ui

#include "models_test.moc"
