#include "ui/model/document.h"

#include <QSignalSpy>
#include <QTest>
#include <cmath>

#include "ui/model/surfaces.h"
#include "ui/sample_project.h"
#include "ui/test_class.h"

namespace footwall::ui {

class DocumentTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void tells_what_an_edit_changed();
  void shows_provisional_pillars_until_the_edit();
  void goes_to_any_step_of_the_history();
  void says_what_the_project_refused();
  void metres_follow_the_velocity();
  void hears_of_runs_and_views_of_others();
};

void DocumentTest::tells_what_an_edit_changed() {
  const SampleProject sample;
  Document document(sample.open());
  QVERIFY(!document.faults().empty());
  const Id fault = document.faults().front().record.id;
  const survey::Pillar before = document.faults().front().pillars.front();
  QSignalSpy shapes(&document, &Document::shapes_changed);
  QSignalSpy facts(&document, &Document::faults_changed);
  QVERIFY(document.edit("Move pillar", [&](project::Interpretation& now) {
    now.move_pillar(before.id, {1, 2, 3});
  }));
  QCOMPARE(shapes.size(), 1);
  QCOMPARE(shapes[0][0].value<std::set<Id>>(), std::set<Id>{fault});
  QCOMPARE(facts.size(), 0);
  QCOMPARE(document.pillar(before.id)->nodes[0].position.y, before.nodes[0].position.y + 2);
  QCOMPARE(document.fault_of_node(before.nodes[0].id)->record.id, fault);
  QVERIFY(document.edit("Rename", [&](project::Interpretation& now) { now.rename_fault(fault, "Main"); }));
  QCOMPARE(shapes.size(), 1);
  QCOMPARE(facts.size(), 1);
  QCOMPARE(document.history().back().name, std::string("Rename"));
}

void DocumentTest::shows_provisional_pillars_until_the_edit() {
  const SampleProject sample;
  Document document(sample.open());
  const Id fault = document.faults().front().record.id;
  std::vector<survey::Pillar> pillars = document.shown_pillars(fault);
  pillars[0].nodes[0].position.x += 100;
  document.show_provisionally(fault, pillars);
  QVERIFY(document.is_provisional(fault));
  QCOMPARE(document.shown_pillars(fault)[0].nodes[0].position.x, pillars[0].nodes[0].position.x);
  QVERIFY(document.faults().front().pillars[0].nodes[0].position.x < pillars[0].nodes[0].position.x);
  document.end_provisional();
  QCOMPARE(document.shown_pillars(fault)[0].nodes[0].position.x, pillars[0].nodes[0].position.x - 100);
}

void DocumentTest::goes_to_any_step_of_the_history() {
  const SampleProject sample;
  Document document(sample.open());
  const survey::Pillar first = document.faults().front().pillars.front();
  const std::size_t known = document.history().size();
  for (int n = 0; n < 5; ++n) {
    document.edit("Move", [&](project::Interpretation& now) { now.move_pillar(first.id, {1, 0, 0}); });
  }
  const auto x = [&] { return document.pillar(first.id)->nodes[0].position.x; };
  QVERIFY(document.go_to_step(document.history()[known + 1].id));
  QCOMPARE(x(), first.nodes[0].position.x + 2);
  QVERIFY(document.can_redo());
  QVERIFY(document.go_to_step(document.history()[known + 4].id));
  QCOMPARE(x(), first.nodes[0].position.x + 5);
  QVERIFY(!document.can_redo());
}

void DocumentTest::says_what_the_project_refused() {
  const SampleProject sample;
  Document document(sample.open());
  QSignalSpy failed(&document, &Document::failed);
  const Id fault = document.faults().front().record.id;
  QVERIFY(!document.edit("Rename", [&](project::Interpretation& now) { now.rename_fault(fault, ""); }));
  QCOMPARE(failed.size(), 1);
  QVERIFY(!failed[0][0].toString().isEmpty());
}

void DocumentTest::metres_follow_the_velocity() {
  const SampleProject sample;
  Document document(sample.open());
  Surfaces surfaces(document, nullptr);
  QTRY_VERIFY_WITH_TIMEOUT(surfaces.is_settled(), 60'000);
  const Id fault = document.faults().front().record.id;
  const auto first = [&](const char* statistic) { return surfaces.numbers(fault, statistic)->values[0]; };
  const auto is_at_rest = [&](double velocity) {
    return document.velocity() == velocity && surfaces.is_settled();
  };
  QSignalSpy survey(&document, &Document::survey_changed);
  document.set_velocity(2000);
  QCOMPARE(survey.size(), 1);
  QTRY_VERIFY_WITH_TIMEOUT(is_at_rest(2000), 60'000);
  const double slow = first("area"), dip = first("dip"), voxels = first("area_voxels");
  QVERIFY(std::isfinite(slow));
  document.set_velocity(4000);
  QTRY_VERIFY_WITH_TIMEOUT(is_at_rest(4000), 60'000);
  QVERIFY(first("area") > slow);
  QVERIFY(first("dip") > dip);
  QCOMPARE(first("area_voxels"), voxels);
  document.set_velocity(4000);  // nothing new
  QCOMPARE(survey.size(), 2);
}

void DocumentTest::hears_of_runs_and_views_of_others() {
  const SampleProject sample;
  project::Project writer = sample.open();
  Document document(sample.open(project::OpenMode::kRead));
  QVERIFY(document.read_only());
  QSignalSpy runs(&document, &Document::runs_changed);
  QSignalSpy views(&document, &Document::views_changed);
  document.refresh();
  QCOMPARE(runs.size() + views.size(), 0);
  project::RunRecord run;
  run.name = "new";
  writer.add_run(run, {});
  document.refresh();
  QCOMPARE(runs.size(), 1);
  QCOMPARE(views.size(), 0);
  project::ViewRecord view;
  view.name = "from above";
  view.camera = "0,90,1";
  writer.save_view(view);
  document.refresh();
  document.refresh();
  QCOMPARE(runs.size(), 1);
  QCOMPARE(views.size(), 1);
}

static const RegisterTest<DocumentTest> kRegistered;

}  // namespace footwall::ui

#include "document_test.moc"
