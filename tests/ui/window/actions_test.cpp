#include "ui/window/actions.h"

#include <QDockWidget>
#include <QFile>
#include <QMenuBar>
#include <QSignalSpy>
#include <QTest>
#include <QToolButton>
#include <algorithm>
#include <map>
#include <set>

#include "ui/made_runs.h"
#include "ui/model/fault_commands.h"
#include "ui/sample_project.h"
#include "ui/test_class.h"
#include "ui/window/banner.h"
#include "ui/window/docks.h"
#include "ui/window/help_window.h"
#include "ui/window/main_window.h"
#include "ui/window/theme.h"
#include "ui/window/view_area.h"
#include "ui/window/view_tile.h"

namespace footwall::ui {

class ActionsTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void every_action_has_name_icon_shortcut_tip_and_a_place_in_a_menu();
  void no_shortcut_is_given_twice();
  void mnemonics_of_a_menu_differ();
  void without_a_project_only_what_needs_none_is_enabled();
  void shortcuts_do_what_the_menu_does();
  void enter_accepts_a_shift_over_the_views_alone();
  void shift_escape_leaves_the_active_fault();
  void keys_go_from_pillar_to_pillar_and_from_node_to_node();
  void names_and_runs_need_something_to_name_and_run();
  void deleted_views_and_isosurfaces_are_put_back();
  void a_run_is_shown_by_key_and_left_by_a_click();
  void icons_follow_the_theme();
  void help_lists_every_action();
  void the_guide_has_every_action_with_its_keys();
};

// Shows the project in a window that has the keys.
static void open_with_the_keys(MainWindow& window, const SampleProject& sample) {
  window.resize(1200, 800);
  window.show();
  QApplication::setActiveWindow(&window);  // there is no window manager that would
  QTRY_VERIFY(window.isActiveWindow());
  QVERIFY(window.open_project(QString::fromStdString(sample.path().string())));
}

void ActionsTest::every_action_has_name_icon_shortcut_tip_and_a_place_in_a_menu() {
  MainWindow window({});
  std::set<QAction*> in_menus;
  for (const QAction* top : window.menuBar()->actions()) {
    for (QAction* action : top->menu()->actions()) {
      in_menus.insert(action);
      if (action->menu() == nullptr) continue;
      for (QAction* below : action->menu()->actions()) in_menus.insert(below);
    }
  }
  QVERIFY(window.actions().table().size() > 50);
  for (const ActionRow& row : window.actions().table()) {
    QAction* action = window.actions().action(QString::fromLatin1(row.id));
    QVERIFY2(action != nullptr, row.id);
    QVERIFY2(!action->text().isEmpty(), row.id);
    QVERIFY2(!action->shortcut().isEmpty(), row.id);
    QVERIFY2(!action->statusTip().isEmpty(), row.id);
    QVERIFY2(!action->icon().isNull(), row.id);
    QVERIFY2(in_menus.contains(action), row.id);
    QVERIFY2(row.run != nullptr, row.id);
  }
}

void ActionsTest::no_shortcut_is_given_twice() {
  MainWindow window({});
  std::map<QString, QString> owner;
  for (const ActionRow& row : window.actions().table()) {
    const QAction* action = window.actions().action(QString::fromLatin1(row.id));
    QCOMPARE(action->shortcuts().size(), QString::fromLatin1(row.shortcuts).split(QLatin1Char(' ')).size());
    for (const QKeySequence& key : action->shortcuts()) {
      const QString text = key.toString();
      QVERIFY2(!text.isEmpty(), row.id);
      QVERIFY2(!owner.contains(text), qPrintable(text + QStringLiteral(" of ") + owner[text]));
      owner[text] = action->objectName();
    }
  }
}

void ActionsTest::mnemonics_of_a_menu_differ() {
  MainWindow window({});
  std::set<QChar> tops;
  for (const QAction* top : window.menuBar()->actions()) {
    const qsizetype at = top->text().indexOf(QLatin1Char('&'));
    QVERIFY(at >= 0 && tops.insert(top->text()[at + 1].toLower()).second);
  }
}

void ActionsTest::without_a_project_only_what_needs_none_is_enabled() {
  const SampleProject sample;
  MainWindow window({});
  for (const ActionRow& row : window.actions().table()) {
    QCOMPARE(window.actions().action(QString::fromLatin1(row.id))->isEnabled(), row.needs == kNothing);
  }
  QVERIFY(window.open_project(QString::fromStdString(sample.path().string())));
  const auto enabled = [&](const char* id) {
    return window.actions().action(QString::fromLatin1(id))->isEnabled();
  };
  QVERIFY(enabled("view.inline"));
  QVERIFY(enabled("tool.pick"));
  QVERIFY(!enabled("fault.colour"));
  QVERIFY(!enabled("edit.delete"));
  Workbench& bench = *window.workbench();
  bench.selection.select({.kind = Item::Kind::kFault, .id = bench.document.faults().front().record.id});
  QVERIFY(enabled("fault.colour"));
  QVERIFY(enabled("edit.delete"));
  QVERIFY(!enabled("fault.merge"));
  QVERIFY(!enabled("edit.redo"));
}

void ActionsTest::shortcuts_do_what_the_menu_does() {
  const SampleProject sample;
  MainWindow window({});
  open_with_the_keys(window, sample);
  if (QTest::currentTestFailed()) return;
  Display& display = window.workbench()->display;
  QTest::keyClick(&window, Qt::Key_O);
  QVERIFY(!display.perspective());
  QTest::keyClick(&window, Qt::Key_C);
  QCOMPARE(display.faces().statistic, QStringLiteral("contrast"));
  // A time survey: without a velocity there are no metres.
  QTest::keyClick(&window, Qt::Key_B);
  QCOMPARE(display.faces().statistic, QStringLiteral("offset_voxels"));
  window.workbench()->document.store().set_setting("velocity", "2400");
  QTest::keyClick(&window, Qt::Key_B);
  QCOMPARE(display.faces().statistic, QStringLiteral("offset"));
  QTest::keyClick(&window, Qt::Key_E);
  QVERIFY(display.faces().edges);
  const std::size_t sections = display.sections().size();
  QTest::keyClick(&window, Qt::Key_2, Qt::ControlModifier);
  QCOMPARE(display.sections().size(), sections + 1);
  QCOMPARE(window.views()->active_section(), display.sections().back().id);
  const std::int64_t before = display.sections().back().section.index;
  QTest::keyClick(&window, Qt::Key_X);
  QCOMPARE(display.sections().back().section.index, before + 1);
  QTest::keyClick(&window, Qt::Key_Z);
  QCOMPARE(display.sections().back().section.index, before);
  QTest::keyClick(&window, Qt::Key_P);
  QCOMPARE(window.workbench()->picking.tool(), Tool::kPick);
  QTest::keyClick(&window, Qt::Key_Escape);
  QCOMPARE(window.workbench()->picking.tool(), Tool::kSelect);
  QTest::keyClick(&window, Qt::Key_A, Qt::ControlModifier);
  QCOMPARE(window.workbench()->selection.faults().size(), window.workbench()->document.faults().size());
  const std::size_t faults = window.workbench()->document.faults().size();
  QTest::keyClick(&window, Qt::Key_Delete);
  QCOMPARE(window.workbench()->document.faults().size(), 0U);
  QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
  QCOMPARE(window.workbench()->document.faults().size(), faults);
}

void ActionsTest::enter_accepts_a_shift_over_the_views_alone() {
  const SampleProject sample;
  MainWindow window({});
  open_with_the_keys(window, sample);
  if (QTest::currentTestFailed()) return;
  Workbench& bench = *window.workbench();
  const QAction* accept = window.actions().action(QStringLiteral("fault.accept-shift"));
  QSignalSpy triggered(accept, &QAction::triggered);
  QSignalSpy failed(&bench.document, &Document::failed);
  QVERIFY(!accept->isEnabled());
  const Fault& fault = bench.document.faults().front();
  const std::size_t steps = bench.document.history().size();
  bench.selection.select({.kind = Item::Kind::kPillar, .id = fault.pillars[0].id});
  QVERIFY(accept->isEnabled());
  // Without an engine nothing is known: it says so, and changes nothing.
  QTest::keyClick(&window, Qt::Key_Return);
  QCOMPARE(triggered.size(), 1);
  QCOMPARE(failed.size(), 1);
  QCOMPARE(bench.document.history().size(), steps);
  // While picking Enter ends a pillar.
  bench.picking.set_tool(Tool::kPick);
  QVERIFY(!accept->isEnabled());
  QTest::keyClick(&window, Qt::Key_Return);
  QCOMPARE(triggered.size(), 1);
  bench.picking.set_tool(Tool::kSelect);
  // In a panel it belongs to the panel.
  window.docks().open(Panel::kHistory, true);
  QWidget* list = window.docks().dock(Panel::kHistory)->widget();
  list->setFocus();
  QTRY_VERIFY(window.focusWidget() != nullptr && !window.views()->isAncestorOf(window.focusWidget()));
  QTest::keyClick(window.focusWidget(), Qt::Key_Return);
  QCOMPARE(triggered.size(), 1);
}

void ActionsTest::shift_escape_leaves_the_active_fault() {
  const SampleProject sample;
  MainWindow window({});
  open_with_the_keys(window, sample);
  if (QTest::currentTestFailed()) return;
  Workbench& bench = *window.workbench();
  const QAction* leave = window.actions().action(QStringLiteral("fault.none"));
  QVERIFY(!leave->isEnabled());
  const Id fault = bench.document.faults().front().record.id;
  bench.selection.select({.kind = Item::Kind::kFault, .id = fault});
  QVERIFY(leave->isEnabled());
  bench.picking.set_tool(Tool::kPick);
  Pointer pointer;
  pointer.place = {10, 20, 30};
  pointer.section.index = 10;
  pointer.on_section = true;
  const auto pick = [&] {
    pointer.button = Qt::LeftButton;
    bench.picking.move(pointer);
    QVERIFY(bench.picking.press(pointer));
    QVERIFY(bench.picking.release(pointer));
  };
  const std::size_t pillars = bench.document.faults().front().pillars.size();
  pick();
  QCOMPARE(bench.document.fault(fault)->pillars.size(), pillars + 1);
  QVERIFY(bench.picking.active_pillar() != 0);
  QTest::keyClick(&window, Qt::Key_Escape, Qt::ShiftModifier);
  QCOMPARE(bench.selection.active_fault(), 0);
  QVERIFY(!bench.selection.current());
  QCOMPARE(bench.picking.active_pillar(), 0);
  QCOMPARE(bench.picking.tool(), Tool::kPick);
  QVERIFY(!leave->isEnabled());
  pointer.place.j = 25;
  pick();
  QCOMPARE(bench.document.fault(fault)->pillars.size(), pillars + 1);
  QVERIFY(is_unassigned(bench.document.faults().back()));
  QCOMPARE(bench.document.faults().back().pillars.size(), 1U);
}

void ActionsTest::keys_go_from_pillar_to_pillar_and_from_node_to_node() {
  const SampleProject sample;
  MainWindow window({});
  open_with_the_keys(window, sample);
  if (QTest::currentTestFailed()) return;
  Workbench& bench = *window.workbench();
  const Fault& fault = bench.document.faults().front();
  QVERIFY(fault.pillars.size() > 2);
  bench.selection.select({.kind = Item::Kind::kFault, .id = fault.record.id});
  QTest::keyClick(&window, Qt::Key_Right, Qt::AltModifier);
  QCOMPARE(bench.selection.current().kind, Item::Kind::kPillar);
  const Id first = bench.selection.current().id;
  QTest::keyClick(&window, Qt::Key_Right, Qt::AltModifier | Qt::ShiftModifier);
  QCOMPARE(bench.selection.pillars().size(), 2U);
  QVERIFY(bench.selection.current().id != first);
  QTest::keyClick(&window, Qt::Key_Left, Qt::AltModifier);
  QCOMPARE(bench.selection.pillars(), std::set<Id>{first});
  QTest::keyClick(&window, Qt::Key_Down, Qt::AltModifier);
  QCOMPARE(bench.selection.current().id, bench.document.pillar(first)->nodes.front().id);
  QTest::keyClick(&window, Qt::Key_Up, Qt::AltModifier);
  QCOMPARE(bench.selection.current().id, bench.document.pillar(first)->nodes.back().id);
  QTest::keyClick(&window, Qt::Key_Up, Qt::AltModifier | Qt::ShiftModifier);
  QCOMPARE(bench.selection.nodes().size(), 2U);
  // What keys selected is deleted by keys.
  const std::size_t nodes = bench.document.pillar(first)->nodes.size();
  QTest::keyClick(&window, Qt::Key_Delete);
  QCOMPARE(bench.document.pillar(first)->nodes.size(), nodes - 2);
}

void ActionsTest::names_and_runs_need_something_to_name_and_run() {
  const SampleProject sample;
  MainWindow window({});
  QVERIFY(window.open_project(QString::fromStdString(sample.path().string())));
  Workbench& bench = *window.workbench();
  const auto enabled = [&](const char* id) {
    return window.actions().action(QString::fromLatin1(id))->isEnabled();
  };
  QVERIFY(!enabled("edit.rename"));
  QVERIFY(enabled("compute.run"));  // of all faults, though none is selected
  const Fault& fault = bench.document.faults()[0];
  bench.selection.select({.kind = Item::Kind::kNode, .id = fault.pillars[0].nodes[0].id});
  QVERIFY(enabled("edit.rename"));
  bench.selection.select_all({fault.record.id, bench.document.faults()[1].record.id}, {}, {});
  QVERIFY(!enabled("edit.rename"));
  bench.selection.select({.kind = Item::Kind::kVolume, .id = bench.display.volume()});
  QVERIFY(enabled("edit.rename"));
  QVERIFY(enabled("edit.delete"));
  window.actions().action(QStringLiteral("edit.select-all"))->trigger();
  window.actions().action(QStringLiteral("edit.delete"))->trigger();
  QVERIFY(!enabled("compute.run"));
}

void ActionsTest::deleted_views_and_isosurfaces_are_put_back() {
  const SampleProject sample;
  MainWindow window({});
  open_with_the_keys(window, sample);
  if (QTest::currentTestFailed()) return;
  Workbench& bench = *window.workbench();
  const QString banner = QStringLiteral("removed");
  const auto remove = [&](const Item& item) {
    bench.selection.select(item);
    window.actions().action(QStringLiteral("edit.delete"))->trigger();
  };

  const Id first = bench.display.add_isosurface(bench.display.volume(), 0.25);
  bench.display.add_isosurface(bench.display.volume(), 0.5);
  const std::vector<IsosurfaceLook> looks = bench.display.isosurfaces();
  remove({.kind = Item::Kind::kIsosurface, .id = first});
  QCOMPARE(bench.display.isosurfaces().size(), 1U);
  QVERIFY(window.banners().press(banner, 0));
  QVERIFY(bench.display.isosurfaces() == looks);
  QVERIFY(!window.banners().has(banner));

  project::ViewRecord view;
  view.name = "north wall";
  view.camera = "30,20,1";
  bench.document.store().save_view(view);
  Q_EMIT bench.document.views_changed();
  remove({.kind = Item::Kind::kView, .name = QStringLiteral("north wall")});
  QVERIFY(bench.document.project().views().empty());
  QVERIFY(window.banners().text(banner).contains(QStringLiteral("north wall")));
  QVERIFY(window.banners().press(banner, 0));
  QCOMPARE(bench.document.project().view("north wall").camera, view.camera);

  // One that was saved anew meanwhile stays as it is.
  remove({.kind = Item::Kind::kView, .name = QStringLiteral("north wall")});
  view.camera = "10,20,2";
  bench.document.store().save_view(view);
  QVERIFY(window.banners().press(banner, 0));
  QCOMPARE(bench.document.project().view("north wall").camera, std::string("10,20,2"));

  // Faults have the history; a banner that was dismissed does not come again by them.
  remove({.kind = Item::Kind::kIsosurface, .id = first});
  QVERIFY(window.banners().press(banner, 1));
  remove({.kind = Item::Kind::kFault, .id = bench.document.faults().front().record.id});
  QVERIFY(!window.banners().has(banner));
}

void ActionsTest::a_run_is_shown_by_key_and_left_by_a_click() {
  const SampleProject sample;
  MainWindow window({});
  open_with_the_keys(window, sample);
  Workbench& bench = *window.workbench();
  const auto runs = add_two_runs(bench);
  QVERIFY(runs);
  const QAction* action = window.actions().action(QStringLiteral("view.run"));
  auto* sign = window.views()->scene()->findChild<QToolButton*>(QStringLiteral("shown-run"));
  QVERIFY(sign != nullptr && !sign->isVisible());
  QVERIFY(!action->isEnabled());
  bench.selection.select({.kind = Item::Kind::kRun, .id = runs->base});
  QVERIFY(action->isEnabled() && !action->isChecked());
  QTest::keyClick(&window, Qt::Key_R, Qt::ShiftModifier);
  QCOMPARE(bench.display.faces().run, runs->base);
  QVERIFY(action->isChecked());
  QVERIFY(sign->isVisible());
  QVERIFY(sign->text().contains(QStringLiteral("run base")));
  // Another one that is selected takes its place.
  bench.selection.select({.kind = Item::Kind::kRun, .id = runs->newer});
  QVERIFY(!action->isChecked());
  QTest::keyClick(&window, Qt::Key_R, Qt::ShiftModifier);
  QCOMPARE(bench.display.faces().run, runs->newer);
  QTest::keyClick(&window, Qt::Key_R, Qt::ShiftModifier);
  QCOMPARE(bench.display.faces().run, Id{0});
  QVERIFY(!sign->isVisible());
  bench.display.show_run(runs->base);
  QTest::keyClick(&window, Qt::Key_Escape);
  QCOMPARE(bench.display.faces().run, runs->base);
  // The tour goes by the contrast of now, which falls where that of the run rises.
  const Id fault = bench.document.faults().front().record.id;
  bench.selection.select({.kind = Item::Kind::kFault, .id = fault});
  QTRY_VERIFY(!bench.shown_numbers.is_reading());
  QTest::keyClick(&window, Qt::Key_W);
  QCOMPARE(bench.selection.current().kind, Item::Kind::kFace);
  QCOMPARE(bench.selection.current().number, bench.surfaces.surface(fault)->faces.back().n);
  QVERIFY(action->isEnabled() && action->isChecked());  // the way back, whatever is selected
  QTest::mouseClick(sign, Qt::LeftButton);
  QCOMPARE(bench.display.faces().run, Id{0});
  QVERIFY(!action->isEnabled());
}

void ActionsTest::icons_follow_the_theme() {
  const QIcon one = icon(QStringLiteral("open"));
  const auto darkest_and_lightest = [&one] {
    const QImage picture = one.pixmap(24, 24).toImage();
    int low = 255, high = 0;
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) {
        const QColor colour = picture.pixelColor(x, y);
        if (colour.alpha() < 250) continue;
        low = std::min(low, colour.lightness());
        high = std::max(high, colour.lightness());
      }
    }
    return std::pair(low, high);
  };
  apply_theme(Theme::kDark);
  QVERIFY(darkest_and_lightest().first > 150);
  QCOMPARE(remembered_theme(), Theme::kDark);
  apply_theme(Theme::kLight);
  QVERIFY(darkest_and_lightest().second < 100);
  QCOMPARE(remembered_theme(), Theme::kLight);
  QCOMPARE(current_theme(), Theme::kLight);
  apply_theme(Theme::kDark);
  QVERIFY(icon(QStringLiteral("no such drawing")).isNull());
}

void ActionsTest::help_lists_every_action() {
  MainWindow window({});
  const QString list = shortcut_list(window.actions());
  for (const ActionRow& row : window.actions().table()) {
    const QAction* action = window.actions().action(QString::fromLatin1(row.id));
    QVERIFY2(list.contains(action->text().remove(QLatin1Char('&'))), row.id);
    QVERIFY2(list.contains(action->shortcut().toString(QKeySequence::NativeText)), row.id);
  }
  window.actions().action(QStringLiteral("help.shortcuts"))->trigger();
  QVERIFY(window.findChild<HelpWindow*>()->isVisible());
  window.actions().action(QStringLiteral("help.guide"))->trigger();
  QVERIFY(window.findChild<HelpWindow*>()->windowTitle().contains(QStringLiteral("Guide")));
}

void ActionsTest::the_guide_has_every_action_with_its_keys() {
  QFile file(QStringLiteral(FOOTWALL_SOURCE_DOCS "/studio.md"));
  QVERIFY(file.open(QIODevice::ReadOnly));
  const QString guide = QString::fromUtf8(file.readAll());
  MainWindow window({});
  for (const ActionRow& row : window.actions().table()) {
    QStringList keys;
    for (const QString& key : QString::fromLatin1(row.shortcuts).split(QLatin1Char(' '))) {
      keys.append(QStringLiteral("`%1`").arg(key));
    }
    const QString name = QString::fromUtf8(row.name).remove(QLatin1Char('&'));
    const QString line = QStringLiteral("| %1 | %2 | %3 |")
                             .arg(name, keys.join(QStringLiteral(" or ")), QString::fromUtf8(row.tip));
    QVERIFY2(guide.contains(line), qPrintable(line));
  }
}

static const RegisterTest<ActionsTest> kRegistered;

}  // namespace footwall::ui

#include "actions_test.moc"
