#include "ui/dialogs/run_dialog.h"

#include <QFile>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>

#include "engine/tasks/triangulate.h"
#include "ui/dialogs/compare_dialog.h"
#include "ui/dialogs/export_dialog.h"
#include "ui/dialogs/look.h"
#include "ui/sample_project.h"
#include "ui/test_class.h"

namespace footwall::ui {

class RunDialogTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() { put_on_dark(); }
  void offers_what_is_built_with_auto_first();
  void runs_as_a_job_and_attaches();
  void offers_the_selected_faults();
  void a_cancelled_run_leaves_no_run();
  void refuses_a_project_without_faults();
  void compares_two_runs_on_different_meshes();
};

void RunDialogTest::offers_what_is_built_with_auto_first() {
  const SampleProject sample;
  Workbench workbench(sample.open(), {});
  RunDialog dialog(workbench);
  const tasks::ExtractOptions options = dialog.options();
  QCOMPARE(options.engine.exchange, std::string("auto"));
  QCOMPARE(options.engine.balance, std::string("auto"));
  QCOMPARE(options.launch.ranks, 0);
  QCOMPARE(options.fault, std::string());
  QCOMPARE(options.volume, std::string("amplitude"));
  auto* exchange = dialog.findChild<QComboBox*>(QStringLiteral("exchange"));
  QVERIFY(exchange->count() > 3);
  exchange->setCurrentText(QStringLiteral("push"));
  dialog.findChild<QSpinBox*>(QStringLiteral("ranks"))->setValue(2);
  QCOMPARE(dialog.options().engine.exchange, std::string("push"));
  QCOMPARE(dialog.options().launch.ranks, 2);
  dialog.findChild<QToolButton*>()->setChecked(true);
  dialog.show();
  QVERIFY(QTest::qWaitForWindowExposed(&dialog));
  QCOMPARE(dialog.focusWidget()->objectName(), QStringLiteral("name"));
  keep_picture(dialog, QStringLiteral("run"));
}

void RunDialogTest::runs_as_a_job_and_attaches() {
  const SampleProject sample;
  Workbench workbench(sample.open(), {});
  RunDialog dialog(workbench);
  dialog.findChild<QLineEdit*>(QStringLiteral("name"))->setText(QStringLiteral("first"));
  dialog.findChild<QSpinBox*>(QStringLiteral("ranks"))->setValue(1);
  QSignalSpy ended(&workbench.jobs, &Jobs::finished);
  QSignalSpy runs(&workbench.document, &Document::runs_changed);
  QSignalSpy meshes(&workbench.document, &Document::meshes_changed);
  QSignalSpy started(&dialog, &RunDialog::started);
  QTest::mouseClick(dialog.findChild<QPushButton*>(QStringLiteral("run")), Qt::LeftButton);
  QCOMPARE(started.size(), 1);
  QVERIFY(ended.wait(60'000));
  QVERIFY2(ended[0][1].value<Jobs::State>() == Jobs::State::kDone, qPrintable(ended[0][2].toString()));
  QCOMPARE(runs.size(), 1);
  QVERIFY(!meshes.empty());
  const auto all = workbench.document.project().runs();
  QCOMPARE(all.size(), std::size_t{1});
  QCOMPARE(all[0].name, std::string("first"));

  // The run's faces as a table: a row each, under one of names.
  ExportChoice choice;
  choice.run = all[0].id;
  choice.file = QString::fromStdString(sample.path().string() + ".csv");
  const Exported exported = prepare_export(workbench.document.project(), choice, {})({});
  QVERIFY2(exported.text.endsWith(QLatin1String("statistics of first")), qPrintable(exported.text));
  QVERIFY(exported.notices.empty());
  QFile table(choice.file);
  QVERIFY(table.open(QIODevice::ReadOnly));
  const QByteArrayList rows = table.readAll().trimmed().split('\n');
  QVERIFY(rows.size() > 100);
  QVERIFY(rows[0].contains("variance"));

  // Through the dialog to where nothing can be written: the job's error is said.
  ExportDialog failing(workbench, {});
  failing.findChild<QLineEdit*>(QStringLiteral("file"))->setText(QStringLiteral("/nowhere/at/all.csv"));
  failing.export_chosen();
  QTRY_VERIFY_WITH_TIMEOUT(failing.message().contains(QLatin1String("/nowhere/at")), 60'000);
}

void RunDialogTest::offers_the_selected_faults() {
  const SampleProject sample;
  Workbench workbench(sample.open(), {});
  const auto& faults = workbench.document.faults();
  const std::vector<Id> chosen{faults[0].record.id, faults[2].record.id};
  {
    const RunDialog dialog(workbench);
    QVERIFY(dialog.options().faults.empty());
    QCOMPARE(dialog.findChild<QComboBox*>(QStringLiteral("fault"))->count(),
             static_cast<int>(faults.size()) + 1);
  }
  workbench.selection.select_all({chosen[0], chosen[1]}, {}, {});
  RunDialog dialog(workbench);
  auto* box = dialog.findChild<QComboBox*>(QStringLiteral("fault"));
  QCOMPARE(box->currentText(), QStringLiteral("selected (2)"));
  QCOMPARE(dialog.options().faults, chosen);
  box->setCurrentIndex(0);
  QVERIFY(dialog.options().faults.empty() && dialog.options().fault.empty());
  box->setCurrentIndex(1);
  dialog.findChild<QSpinBox*>(QStringLiteral("ranks"))->setValue(1);
  QSignalSpy ended(&workbench.jobs, &Jobs::finished);
  QTest::mouseClick(dialog.findChild<QPushButton*>(QStringLiteral("run")), Qt::LeftButton);
  QVERIFY(ended.wait(60'000));
  QVERIFY2(ended[0][1].value<Jobs::State>() == Jobs::State::kDone, qPrintable(ended[0][2].toString()));
  const project::Project& project = workbench.document.project();
  QCOMPARE(project.run_faults(project.runs().front().id), chosen);
  QCOMPARE(workbench.jobs.index(0).data().toString(), QStringLiteral("Statistics of 2 faults"));
  tasks::ExtractOptions gone;
  gone.faults = {chosen[0], 123456};
  QVERIFY_EXCEPTION_THROWN(start_run(workbench, gone), Error);
}

void RunDialogTest::a_cancelled_run_leaves_no_run() {
  const SampleProject sample;
  Workbench workbench(sample.open(), {});
  tasks::ExtractOptions options;
  options.launch.ranks = 1;
  QSignalSpy ended(&workbench.jobs, &Jobs::finished);
  const int job = start_run(workbench, options);
  workbench.jobs.cancel(job);
  QVERIFY(ended.wait(60'000));
  QCOMPARE(ended[0][1].value<Jobs::State>(), Jobs::State::kCancelled);
  QVERIFY(workbench.document.project().runs().empty());
}

void RunDialogTest::refuses_a_project_without_faults() {
  const QTemporaryDir folder;
  const std::filesystem::path path = folder.path().toStdString() + "/empty.footwall";
  tasks::new_empty_project(path);
  Workbench workbench(project::Project::open(path, project::OpenMode::kWrite), {});
  RunDialog dialog(workbench);
  QVERIFY(!dialog.findChild<QPushButton*>(QStringLiteral("run"))->isEnabled());
  QVERIFY_EXCEPTION_THROWN(start_run(workbench, {}), Error);
  QCOMPARE(workbench.jobs.running(), 0);
}

void RunDialogTest::compares_two_runs_on_different_meshes() {
  const SampleProject sample;
  auto project = sample.open();
  tasks::ExtractOptions options;
  options.launch.ranks = 1;
  options.name = "fine";
  tasks::extract_run(project, options, {});
  const project::FaultRecord fault = project.faults().front();
  tasks::TriangulateOptions coarse;
  coarse.detail = 3;
  coarse.max_edge = 30;
  tasks::triangulate_fault(project, fault, coarse, {});
  options.name = "coarse";
  tasks::extract_run(project, options, {});
  Workbench workbench(std::move(project), {});
  CompareDialog dialog(workbench);
  QCOMPARE(dialog.choice().fault, fault.name);
  QVERIFY(dialog.choice().run_a != dialog.choice().run_b);
  dialog.resize(1100, 520);
  dialog.show();
  QVERIFY(QTest::qWaitForWindowExposed(&dialog));
  QTest::mouseClick(dialog.findChild<QPushButton*>(QStringLiteral("compare")), Qt::LeftButton);
  QTRY_VERIFY2_WITH_TIMEOUT(dialog.compared() != nullptr, qPrintable(dialog.message()), 60'000);
  const tasks::RunComparison& made = dialog.compared()->comparison;
  QVERIFY(made.both > 100);
  QVERIFY(made.rms.value_or(0) > 0);

  // The cursor tells what the cells hold, in metres; beside the raster nothing.
  const QRectF raster = dialog.view().place_of_raster(2);
  QVERIFY(raster.width() > 50);
  QString said;
  connect(&dialog.view(), &CompareView::pointed, &dialog, [&](const QString& text) { said = text; });
  QTest::mouseMove(&dialog.view(), raster.center().toPoint());
  QTRY_VERIFY(said.startsWith(QStringLiteral("along ")));
  QVERIFY(said.contains(QStringLiteral("B − A")));
  QVERIFY(dialog.view().read_out({2, 2}).isEmpty());
  keep_picture(dialog, QStringLiteral("compare"));

  const QString csv = QString::fromStdString(sample.path().string() + ".difference.csv");
  dialog.write_csv(csv);
  QTRY_VERIFY2_WITH_TIMEOUT(dialog.message().endsWith(QStringLiteral("written")),
                            qPrintable(dialog.message()), 60'000);
  QFile table(csv);
  QVERIFY(table.open(QIODevice::ReadOnly));
  QCOMPARE(table.readAll().trimmed().split('\n').size(), 1 + made.both + made.only_a + made.only_b);
  const QString png = QString::fromStdString(sample.path().string() + ".difference.png");
  dialog.write_picture(png);
  QCOMPARE(QImage(png).width(), 2 * dialog.view().width());
}

static const RegisterTest<RunDialogTest> registered;

}  // namespace footwall::ui

#include "run_dialog_test.moc"
