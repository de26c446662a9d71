#include "ui/model/project_tree.h"

#include <QAbstractItemModelTester>
#include <QLineEdit>
#include <QMessageBox>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>

#include "ui/model/fault_commands.h"
#include "ui/model/history_list.h"
#include "ui/panels/project_panel.h"
#include "ui/sample_project.h"
#include "ui/test_class.h"

namespace footwall::ui {
namespace {

Item fault_item(Id id) {
  return {.kind = Item::Kind::kFault, .id = id};
}

void press(const ProjectPanel& panel, const char* button) {
  const auto* box = panel.findChild<QMessageBox*>();
  QVERIFY(box != nullptr && box->isVisible());
  if (button == nullptr) return box->button(QMessageBox::Cancel)->click();
  auto* one = box->findChild<QPushButton*>(QLatin1String(button));
  QVERIFY(one != nullptr);
  one->click();
}

std::unique_ptr<Workbench> open(const SampleProject& sample) {
  QString held;
  return open_workbench(sample.path(), {}, &held);
}

}  // namespace

class ProjectTreeTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void lists_what_there_is();
  void follows_edits_undo_and_what_is_shown();
  void a_rename_is_one_edit();
  void deletes_with_undo();
  void history_follows();
  void selects_both_ways();
  void a_click_on_the_ring_hides();
  void rows_under_the_mouse_are_hovered();
  void volumes_and_isosurfaces_are_renamed();
  void names_the_fault_of_what_is_selected();
  void a_volume_is_deleted_after_a_question();
  void a_run_is_deleted_after_a_question();
  void one_run_is_shown_or_none();
  void a_click_on_nothing_leaves_the_active_fault();
};

void ProjectTreeTest::lists_what_there_is() {
  const SampleProject sample;
  const auto bench = open(sample);
  ProjectTree tree(bench->document, bench->display);
  QAbstractItemModelTester tester(&tree, QAbstractItemModelTester::FailureReportingMode::QtTest);
  QCOMPARE(tree.rowCount(), 5);
  QCOMPARE(tree.rowCount(tree.index(0, 0)), static_cast<int>(bench->document.volumes().size()));
  QCOMPARE(tree.rowCount(tree.index(1, 0)), static_cast<int>(bench->document.faults().size()));
  const Fault& fault = bench->document.faults().front();
  const QModelIndex index = tree.index_of(fault_item(fault.record.id));
  QCOMPARE(tree.item_of(index), fault_item(fault.record.id));
  QCOMPARE(index.data(ProjectTree::kDetail).toString(), QString::number(fault.pillars.size()));
  QCOMPARE(index.data(ProjectTree::kColour).value<QColor>(),
           QColor(QString::fromStdString(fault.record.colour)));
  QVERIFY(!tree.item_of(tree.index(1, 0)));
  // How an isosurface is shown, where it is not a picture; a cube by its side.
  const Id volume = bench->document.volumes().front().id;
  IsosurfaceLook look{.id = bench->display.add_isosurface(volume, 0.5), .volume = volume, .value = 0.5};
  const auto detail = [&] {
    return tree.index_of({.kind = Item::Kind::kIsosurface, .id = look.id})
        .data(ProjectTree::kDetail)
        .toString();
  };
  QCOMPARE(detail(), QString());
  look.as_picture = false;
  bench->display.change_isosurface(look);
  QCOMPARE(detail(), QStringLiteral("mesh"));
  const SampleProject cube("faulted", {32, 32, 32});
  const auto other = open(cube);
  ProjectTree cubes(other->document, other->display);
  QCOMPARE(cubes.index(0, 0, cubes.index(0, 0)).data(ProjectTree::kDetail).toString(), QStringLiteral("32³"));
}

void ProjectTreeTest::follows_edits_undo_and_what_is_shown() {
  const SampleProject sample;
  const auto bench = open(sample);
  ProjectTree tree(bench->document, bench->display);
  QAbstractItemModelTester tester(&tree, QAbstractItemModelTester::FailureReportingMode::QtTest);
  const int before = tree.rowCount(tree.index(1, 0));
  const Id made = new_fault(bench->document);
  QVERIFY(made != 0);
  QCOMPARE(tree.rowCount(tree.index(1, 0)), before + 1);
  const QModelIndex index = tree.index_of(fault_item(made));
  QVERIFY(tree.setData(index, Qt::Unchecked, Qt::CheckStateRole));
  QVERIFY(!bench->display.is_visible(fault_item(made)));
  QCOMPARE(index.data(Qt::CheckStateRole).toInt(), static_cast<int>(Qt::Unchecked));
  QVERIFY(bench->document.undo());
  QCOMPARE(tree.rowCount(tree.index(1, 0)), before);
  QVERIFY(bench->document.redo());
  QCOMPARE(tree.rowCount(tree.index(1, 0)), before + 1);
  const Id iso = bench->display.add_isosurface(bench->display.volume(), 0.5);
  QCOMPARE(tree.rowCount(tree.index(2, 0)), 1);
  QVERIFY(tree.remove({{.kind = Item::Kind::kIsosurface, .id = iso}}));
  QCOMPARE(tree.rowCount(tree.index(2, 0)), 0);
  bench->document.store().save_view({.name = "south", .camera = "180,30,1", .exaggeration = 0, .when = {}});
  Q_EMIT bench->document.views_changed();
  const QModelIndex view = tree.index(0, 0, tree.index(4, 0));
  QVERIFY(tree.setData(view, QStringLiteral("from the south"), Qt::EditRole));
  QCOMPARE(bench->document.project().views().size(), 1U);
  QCOMPARE(bench->document.project().views().front().name, std::string("from the south"));
  QVERIFY(tree.remove({{.kind = Item::Kind::kView, .name = QStringLiteral("from the south")}}));
  QCOMPARE(tree.rowCount(tree.index(4, 0)), 0);
}

void ProjectTreeTest::a_rename_is_one_edit() {
  const SampleProject sample;
  const auto bench = open(sample);
  ProjectTree tree(bench->document, bench->display);
  QAbstractItemModelTester tester(&tree, QAbstractItemModelTester::FailureReportingMode::QtTest);
  const Id fault = bench->document.faults().front().record.id;
  const QString former = QString::fromStdString(bench->document.faults().front().record.name);
  const std::size_t steps = bench->document.history().size();
  QVERIFY(tree.setData(tree.index_of(fault_item(fault)), QStringLiteral("  main "), Qt::EditRole));
  QCOMPARE(bench->document.history().size(), steps + 1);
  QCOMPARE(tree.index_of(fault_item(fault)).data().toString(), QStringLiteral("main"));
  QSignalSpy failed(&bench->document, &Document::failed);
  QVERIFY(!tree.setData(tree.index_of(fault_item(fault)), QString(), Qt::EditRole));
  const QString other = QString::fromStdString(bench->document.faults().back().record.name);
  QVERIFY(!tree.setData(tree.index_of(fault_item(fault)), other, Qt::EditRole));
  QCOMPARE(failed.size(), 2);
  QCOMPARE(bench->document.history().size(), steps + 1);
  QVERIFY(bench->document.undo());
  QCOMPARE(tree.index_of(fault_item(fault)).data().toString(), former);
}

void ProjectTreeTest::deletes_with_undo() {
  const SampleProject sample;
  const auto bench = open(sample);
  ProjectPanel panel(*bench, [](const QString&) -> QAction* { return nullptr; });
  QAbstractItemModelTester tester(&panel.tree(), QAbstractItemModelTester::FailureReportingMode::QtTest);
  const std::size_t faults = bench->document.faults().size();
  const std::size_t steps = bench->document.history().size();
  QVERIFY(faults > 2);
  bench->selection.select_all({bench->document.faults()[0].record.id, bench->document.faults()[2].record.id},
                              {}, {});
  panel.delete_selected();
  QCOMPARE(bench->document.faults().size(), faults - 2);
  QCOMPARE(bench->document.history().size(), steps + 1);
  QVERIFY(bench->document.undo());
  QCOMPARE(panel.tree().rowCount(panel.tree().index(1, 0)), static_cast<int>(faults));
}

void ProjectTreeTest::history_follows() {
  const SampleProject sample;
  const auto bench = open(sample);
  HistoryList list(bench->document);
  QAbstractItemModelTester tester(&list, QAbstractItemModelTester::FailureReportingMode::QtTest);
  const int before = list.rowCount();
  QCOMPARE(list.current_row(), before - 1);
  QVERIFY(new_fault(bench->document) != 0);
  QCOMPARE(list.rowCount(), before + 1);
  QVERIFY(bench->document.undo());
  QCOMPARE(list.rowCount(), before + 1);
  QCOMPARE(list.current_row(), before - 1);
  QVERIFY(list.index(before).data(HistoryList::kUndone).toBool());
  QCOMPARE(list.index(0).data(HistoryList::kStep).toLongLong(), 0);
}

void ProjectTreeTest::selects_both_ways() {
  const SampleProject sample;
  const auto bench = open(sample);
  ProjectPanel panel(*bench, [](const QString&) -> QAction* { return nullptr; });
  const Fault& first = bench->document.faults()[0];
  const Fault& second = bench->document.faults()[1];
  const auto is_selected = [&](Id fault) {
    return panel.selectionModel()->isSelected(panel.tree().index_of(fault_item(fault)));
  };
  bench->selection.select({.kind = Item::Kind::kNode, .id = second.pillars[0].nodes[0].id});
  QVERIFY(is_selected(second.record.id));
  QCOMPARE(bench->selection.current().kind, Item::Kind::kNode);
  panel.setCurrentIndex(panel.tree().index_of(fault_item(first.record.id)));
  QCOMPARE(bench->selection.current(), fault_item(first.record.id));
  QCOMPARE(bench->selection.active_fault(), first.record.id);
  QVERIFY(!is_selected(second.record.id));
  panel.selectionModel()->select(panel.tree().index_of(fault_item(second.record.id)),
                                 QItemSelectionModel::Select);
  QCOMPARE(bench->selection.faults(), (std::set<Id>{first.record.id, second.record.id}));
}

void ProjectTreeTest::a_click_on_the_ring_hides() {
  const SampleProject sample;
  const auto bench = open(sample);
  ProjectPanel panel(*bench, [](const QString&) -> QAction* { return nullptr; });
  panel.resize(240, 400);
  panel.show();
  QVERIFY(QTest::qWaitForWindowExposed(&panel));
  const Id fault = bench->document.faults().front().record.id;
  const QModelIndex index = panel.tree().index_of(fault_item(fault));
  const QRect row = panel.visualRect(index);
  QTest::mouseClick(panel.viewport(), Qt::LeftButton, {}, {row.left() + 14, row.center().y()});
  QVERIFY(!bench->display.is_visible(fault_item(fault)));
  QTest::mouseClick(panel.viewport(), Qt::LeftButton, {}, {row.left() + 14, row.center().y()});
  QVERIFY(bench->display.is_visible(fault_item(fault)));
  bench->selection.select(fault_item(fault));
  panel.rename_current();
  auto* field = panel.findChild<QLineEdit*>();
  QVERIFY(field != nullptr);
  field->selectAll();
  QTest::keyClicks(field, QStringLiteral("by hand"));
  QTest::keyClick(field, Qt::Key_Return);
  QTRY_COMPARE(bench->document.fault(fault)->record.name, std::string("by hand"));
}

void ProjectTreeTest::rows_under_the_mouse_are_hovered() {
  const SampleProject sample;
  const auto bench = open(sample);
  ProjectPanel panel(*bench, [](const QString&) -> QAction* { return nullptr; });
  panel.resize(300, 500);
  panel.show();
  QVERIFY(QTest::qWaitForWindowExposed(&panel));
  const Item& hovered = bench->selection.hovered();
  const auto move_to = [&](const QPoint& at) {
    QMouseEvent event(QEvent::MouseMove, at, panel.viewport()->mapToGlobal(at), Qt::NoButton, Qt::NoButton,
                      Qt::NoModifier);
    QCoreApplication::sendEvent(panel.viewport(), &event);
  };
  for (const Fault& fault : bench->document.faults()) {
    const Item item = fault_item(fault.record.id);
    move_to(panel.visualRect(panel.tree().index_of(item)).center());
    QCOMPARE(hovered, item);
  }
  move_to(panel.visualRect(panel.tree().index(0, 0)).center());
  QVERIFY(!hovered);  // a heading
  move_to(
      panel.visualRect(panel.tree().index_of(fault_item(bench->document.faults()[0].record.id))).center());
  QVERIFY(hovered);
  QVERIFY(!bench->selection.current());
  QEvent leave(QEvent::Leave);
  QCoreApplication::sendEvent(panel.viewport(), &leave);
  QVERIFY(!hovered);
}

void ProjectTreeTest::volumes_and_isosurfaces_are_renamed() {
  const SampleProject sample;
  const auto bench = open(sample);
  ProjectTree tree(bench->document, bench->display);
  QAbstractItemModelTester tester(&tree, QAbstractItemModelTester::FailureReportingMode::QtTest);
  const Item volume{.kind = Item::Kind::kVolume, .id = bench->document.volumes().front().id};
  const Item isosurface{.kind = Item::Kind::kIsosurface, .id = bench->display.add_isosurface(volume.id, 0.5)};
  const QString computed = tree.index_of(isosurface).data().toString();
  QVERIFY(tree.setData(tree.index_of(isosurface), QStringLiteral("bright spot"), Qt::EditRole));
  QCOMPARE(tree.index_of(isosurface).data().toString(), QStringLiteral("bright spot"));
  // The name is kept with the rest of the look; without one it is called after its value again.
  Display other(bench->document);
  other.from_json(bench->display.to_json());
  QCOMPARE(other.isosurfaces().front().name, QStringLiteral("bright spot"));
  QVERIFY(tree.setData(tree.index_of(isosurface), QString(), Qt::EditRole));
  QCOMPARE(tree.index_of(isosurface).data().toString(), computed);

  const std::size_t steps = bench->document.history().size();
  QVERIFY(tree.setData(tree.index_of(volume), QStringLiteral("full stack"), Qt::EditRole));
  QCOMPARE(bench->document.project().volume("full stack").id, volume.id);
  QCOMPARE(bench->document.history().size(), steps);
  QCOMPARE(tree.index_of(isosurface).data().toString(), QStringLiteral("full stack = 0.5"));
  QSignalSpy failed(&bench->document, &Document::failed);
  QVERIFY(!tree.setData(tree.index_of(volume), QString(), Qt::EditRole));
  QCOMPARE(failed.size(), 1);
  QCOMPARE(tree.index_of(volume).data().toString(), QStringLiteral("full stack"));
}

void ProjectTreeTest::names_the_fault_of_what_is_selected() {
  const SampleProject sample;
  const auto bench = open(sample);
  ProjectPanel panel(*bench, [](const QString&) -> QAction* { return nullptr; });
  panel.show();
  const Fault& fault = bench->document.faults()[1];
  const survey::Pillar& pillar = fault.pillars[0];
  Selection& selection = bench->selection;
  const Item face{.kind = Item::Kind::kFace, .id = fault.record.id, .panel = 1};
  for (const Item& one : {face, Item{.kind = Item::Kind::kPillar, .id = pillar.id},
                          Item{.kind = Item::Kind::kNode, .id = pillar.nodes[0].id}}) {
    selection.select(one);
    QCOMPARE(selection.owner(), fault_item(fault.record.id));
  }
  selection.select_all({}, {fault.pillars[1].id}, {pillar.nodes[0].id, pillar.nodes[1].id});
  QCOMPARE(selection.owner(), fault_item(fault.record.id));
  panel.rename_current();
  auto* field = panel.findChild<QLineEdit*>();
  QVERIFY(field != nullptr);
  QCOMPARE(field->text(), QString::fromStdString(fault.record.name));
  const Id of_another = bench->document.faults()[0].pillars[0].id;
  selection.select_all({}, {of_another}, {}, true);
  QVERIFY(!selection.owner());
  const Item volume{.kind = Item::Kind::kVolume, .id = bench->display.volume()};
  selection.select(volume);
  QCOMPARE(selection.owner(), volume);
}

void ProjectTreeTest::a_volume_is_deleted_after_a_question() {
  const SampleProject sample;
  const auto bench = open(sample);
  ProjectPanel panel(*bench, [](const QString&) -> QAction* { return nullptr; });
  QAbstractItemModelTester tester(&panel.tree(), QAbstractItemModelTester::FailureReportingMode::QtTest);
  panel.show();
  const std::size_t volumes = bench->document.volumes().size();
  const project::VolumeRecord volume = bench->document.volumes().front();
  QCOMPARE(bench->display.volume(), volume.id);
  bench->display.add_isosurface(volume.id, 0.5);
  const std::filesystem::path file = bench->document.project().volume_path(volume);
  const Item item{.kind = Item::Kind::kVolume, .id = volume.id};
  bench->selection.select(item);
  panel.delete_selected();
  const auto* box = panel.findChild<QMessageBox*>();
  QVERIFY(box != nullptr);
  QVERIFY(box->informativeText().contains(QString::fromStdString(file.string())));
  QVERIFY(box->informativeText().contains(QStringLiteral("cannot be undone")));
  press(panel, nullptr);
  QTRY_VERIFY(panel.findChild<QMessageBox*>() == nullptr);
  QCOMPARE(bench->document.volumes().size(), volumes);
  panel.delete_selected();
  press(panel, "delete");
  QCOMPARE(bench->document.volumes().size(), volumes - 1);
  QVERIFY(!panel.tree().index_of(item).isValid());
  QVERIFY(bench->display.isosurfaces().empty());
  QVERIFY(bench->display.volume() != volume.id);
  QVERIFY(!bench->selection.current());
  QVERIFY(std::filesystem::exists(file));
}

void ProjectTreeTest::a_run_is_deleted_after_a_question() {
  const SampleProject sample;
  const auto bench = open(sample);
  project::RunRecord run;
  run.volume = "amplitude";
  for (const char* name : {"first", "second", "third"}) {
    run.name = name;
    bench->document.store().add_run(run, {});
  }
  ProjectPanel panel(*bench, [](const QString&) -> QAction* { return nullptr; });
  QAbstractItemModelTester tester(&panel.tree(), QAbstractItemModelTester::FailureReportingMode::QtTest);
  panel.show();
  const QModelIndex runs = panel.tree().index(3, 0);
  QCOMPARE(panel.tree().rowCount(runs), 3);
  panel.setCurrentIndex(panel.tree().index(0, 0, runs));
  QCOMPARE(bench->selection.current().kind, Item::Kind::kRun);
  panel.selectionModel()->select(panel.tree().index(2, 0, runs), QItemSelectionModel::Select);
  panel.delete_selected();
  QCOMPARE(panel.tree().rowCount(runs), 3);
  press(panel, "delete");
  QTRY_COMPARE(panel.tree().rowCount(runs), 1);
  QCOMPARE(bench->document.project().runs().front().name, std::string("second"));
  QTRY_COMPARE(bench->jobs.running(), 0);
}

void ProjectTreeTest::one_run_is_shown_or_none() {
  const SampleProject sample;
  const auto bench = open(sample);
  project::RunRecord run;
  run.name = "first";
  const Id first = bench->document.store().add_run(run, {});
  run.name = "second";
  const Id second = bench->document.store().add_run(run, {});
  ProjectPanel panel(*bench, [](const QString&) -> QAction* { return nullptr; });
  ProjectTree& tree = panel.tree();
  QAbstractItemModelTester tester(&tree, QAbstractItemModelTester::FailureReportingMode::QtTest);
  panel.show();
  const auto row = [&](Id id) { return tree.index_of({.kind = Item::Kind::kRun, .id = id}); };
  const auto checked = [&](Id id) { return row(id).data(Qt::CheckStateRole).toInt() == Qt::Checked; };
  QVERIFY(!checked(first) && !checked(second));
  // Space, as for a volume; the mark moves, and can be taken away.
  panel.setCurrentIndex(row(first));
  QTest::keyClick(&panel, Qt::Key_Space);
  QCOMPARE(bench->display.faces().run, first);
  QVERIFY(checked(first));
  panel.setCurrentIndex(row(second));
  QTest::keyClick(&panel, Qt::Key_Space);
  QCOMPARE(bench->display.faces().run, second);
  QVERIFY(!checked(first) && checked(second));
  QTest::keyClick(&panel, Qt::Key_Space);
  QCOMPARE(bench->display.faces().run, Id{0});
  QVERIFY(!checked(first) && !checked(second));
  QVERIFY(tree.setData(row(first), Qt::Checked, Qt::CheckStateRole));
  // F2: the numbers shown are called so, too.
  QVERIFY(tree.setData(row(first), QStringLiteral("before the move"), Qt::EditRole));
  QCOMPARE(bench->document.project().run(first).name, std::string("before the move"));
  QCOMPARE(row(first).data().toString(), QStringLiteral("before the move"));
  QCOMPARE(bench->shown_numbers.run()->name, std::string("before the move"));
  QVERIFY(!tree.setData(row(first), QStringLiteral("two\nlines"), Qt::EditRole));
  QCOMPARE(row(first).data().toString(), QStringLiteral("before the move"));
  bench->document.store().delete_run(first);
  Q_EMIT bench->document.runs_changed();
  QCOMPARE(bench->display.faces().run, Id{0});
  QVERIFY(!checked(second));
}

void ProjectTreeTest::a_click_on_nothing_leaves_the_active_fault() {
  const SampleProject sample;
  const auto bench = open(sample);
  ProjectPanel panel(*bench, [](const QString&) -> QAction* { return nullptr; });
  panel.resize(240, 600);
  panel.show();
  QVERIFY(QTest::qWaitForWindowExposed(&panel));
  const Id fault = bench->document.faults().front().record.id;
  bench->selection.select(fault_item(fault));
  bench->selection.clear();
  QCOMPARE(bench->selection.active_fault(), fault);  // a click beside everything in a view
  const QPoint nowhere(120, panel.viewport()->height() - 4);
  QVERIFY(!panel.indexAt(nowhere).isValid());
  QTest::mouseClick(panel.viewport(), Qt::LeftButton, {}, nowhere);
  QCOMPARE(bench->selection.active_fault(), 0);
  QVERIFY(!bench->selection.current());
  QVERIFY(panel.selectionModel()->selectedIndexes().isEmpty());
}

static const RegisterTest<ProjectTreeTest> kRegistered;

}  // namespace footwall::ui

#include "project_tree_test.moc"
