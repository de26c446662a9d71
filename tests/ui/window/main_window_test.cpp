#include "ui/window/main_window.h"

#include <QDockWidget>
#include <QDropEvent>
#include <QListWidget>
#include <QMenu>
#include <QMimeData>
#include <QProcess>
#include <QPushButton>
#include <QTest>
#include <QTimer>
#include <fstream>

#include "ui/dialogs/trim_history_dialog.h"
#include "ui/model/fault_commands.h"
#include "ui/panels/history_panel.h"
#include "ui/panels/inspector_panel.h"
#include "ui/panels/project_panel.h"
#include "ui/sample_project.h"
#include "ui/test_class.h"
#include "ui/window/actions.h"
#include "ui/window/banner.h"
#include "ui/window/dialogs.h"
#include "ui/window/docks.h"
#include "ui/window/saved_views.h"
#include "ui/window/start_page.h"
#include "ui/window/status_line.h"
#include "ui/window/theme.h"
#include "ui/window/tool_bar.h"
#include "ui/window/view_area.h"
#include "ui/window/view_tile.h"

namespace footwall::ui {
namespace {

QString text_of(const std::filesystem::path& path) {
  return QString::fromStdString(path.string());
}

void drop(MainWindow& window, const QString& path) {
  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(path)});
  QDragEnterEvent enter(QPoint(10, 10), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(&window, &enter);
  QVERIFY(enter.isAccepted());
  QDropEvent event(QPointF(10, 10), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(&window, &event);
}

}  // namespace

class MainWindowTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void the_tool_bar_keeps_its_buttons_in_a_narrow_window();
  void initTestCase() { apply_theme(Theme::kDark); }
  void shows_the_start_page_then_a_project();
  void says_why_a_file_is_no_project();
  void docks_are_remembered_with_the_project();
  void hides_and_shows_all_panels();
  void opens_read_only_where_somebody_writes_and_follows();
  void names_a_missing_volume();
  void footwall_edit_shows_in_the_window();
  void drops_old_history_when_told_to();
  void takes_dropped_files();
  void makes_the_demo_as_a_job();
  void reads_out_the_cursor();
  void goes_to_a_step_of_the_history_by_a_click();
  void inspects_what_is_selected();
  void goes_on_without_the_volume_shown();
  void saves_and_restores_views();
  void an_idle_window_paints_nothing();
  void says_that_the_engine_is_off();
  void choices_of_the_tool_bar_open_by_key();
};

void MainWindowTest::shows_the_start_page_then_a_project() {
  const SampleProject sample;
  MainWindow window({});
  window.resize(1400, 900);
  window.show();
  QVERIFY(window.findChild<StartPage*>() != nullptr);
  QVERIFY(window.views() == nullptr);
  QVERIFY(window.open_project(text_of(sample.path())));
  QVERIFY(window.findChild<StartPage*>() == nullptr);
  QVERIFY(window.views() != nullptr);
  QVERIFY(window.windowTitle().startsWith(QStringLiteral("sample.footwall")));
  for (const Panel panel : {Panel::kProject, Panel::kInspector, Panel::kJobs, Panel::kHistory}) {
    QVERIFY(window.docks().is_open(panel));
  }
  window.actions().action(QStringLiteral("file.close"))->trigger();
  QVERIFY(window.workbench() == nullptr);
  const auto* page = window.findChild<StartPage*>();
  QVERIFY(page != nullptr);
  const auto* recent = page->findChild<QListWidget*>();
  QVERIFY(recent->count() >= 1);
  QCOMPARE(recent->item(0)->data(Qt::UserRole).toString(), text_of(sample.path()));
  Q_EMIT recent->parent()->findChild<QListWidget*>()->itemClicked(recent->item(0));
  QTRY_VERIFY(window.workbench() != nullptr);
}

void MainWindowTest::says_why_a_file_is_no_project() {
  QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("no.footwall"));
  std::ofstream(path.toStdString()) << "this is no project";
  MainWindow window({});
  QVERIFY(!window.open_project(path));
  QVERIFY(window.banners().has(QStringLiteral("failure")));
  QVERIFY(window.banners().text(QStringLiteral("failure")).contains(QStringLiteral("no.footwall")));
  QVERIFY(window.workbench() == nullptr);
}

void MainWindowTest::docks_are_remembered_with_the_project() {
  const SampleProject sample, other;
  {
    MainWindow window({});
    window.resize(1400, 900);
    window.show();
    QVERIFY(window.open_project(text_of(sample.path())));
    window.docks().open(Panel::kHistory, false);
    window.addDockWidget(Qt::RightDockWidgetArea, window.docks().dock(Panel::kProject));
    window.views()->show_scene(false);
    window.close();
  }
  MainWindow window({});
  window.resize(1400, 900);
  window.show();
  QVERIFY(window.open_project(text_of(sample.path())));
  QVERIFY(!window.docks().is_open(Panel::kHistory));
  QVERIFY(window.docks().is_open(Panel::kProject));
  QCOMPARE(window.dockWidgetArea(window.docks().dock(Panel::kProject)), Qt::RightDockWidgetArea);
  QVERIFY(!window.views()->has_scene());
  QVERIFY(window.open_project(text_of(other.path())));
  QVERIFY(window.docks().is_open(Panel::kHistory));
  QCOMPARE(window.dockWidgetArea(window.docks().dock(Panel::kProject)), Qt::LeftDockWidgetArea);
  QVERIFY(window.views()->has_scene());
}

void MainWindowTest::hides_and_shows_all_panels() {
  const SampleProject sample;
  MainWindow window({});
  window.show();
  QVERIFY(window.open_project(text_of(sample.path())));
  window.docks().open(Panel::kJobs, false);
  QAction* hide = window.actions().action(QStringLiteral("window.docks"));
  hide->trigger();
  QVERIFY(window.docks().all_hidden());
  QVERIFY(hide->isChecked());
  hide->trigger();
  QVERIFY(window.docks().is_open(Panel::kProject));
  QVERIFY(!window.docks().is_open(Panel::kJobs));
}

void MainWindowTest::opens_read_only_where_somebody_writes_and_follows() {
  const SampleProject sample;
  MainWindow window({});
  window.show();
  auto writer = std::make_unique<MainWindow>(EngineLink::Options{});
  QVERIFY(writer->open_project(text_of(sample.path())));
  QVERIFY(window.open_project(text_of(sample.path())));
  QVERIFY(window.workbench()->document.read_only());
  QVERIFY(window.banners().has(QStringLiteral("read-only")));
  QVERIFY(window.banners()
              .text(QStringLiteral("read-only"))
              .contains(QString::number(QCoreApplication::applicationPid())));
  QVERIFY(!window.actions().action(QStringLiteral("tool.pick"))->isEnabled());
  QVERIFY(!window.actions().action(QStringLiteral("fault.new"))->isEnabled());
  const std::size_t faults = window.workbench()->document.faults().size();
  QVERIFY(new_fault(writer->workbench()->document) != 0);
  QTRY_COMPARE(window.workbench()->document.faults().size(), faults + 1);
  writer.reset();
  QVERIFY(window.banners().press(QStringLiteral("read-only"), 0));
  QVERIFY(!window.workbench()->document.read_only());
  QVERIFY(!window.banners().has(QStringLiteral("read-only")));
}

void MainWindowTest::names_a_missing_volume() {
  const SampleProject sample;
  const std::filesystem::path folder = sample.path().parent_path() / "sample.footwall.volumes";
  std::filesystem::rename(folder, sample.path().parent_path() / "elsewhere");
  MainWindow window({});
  QVERIFY(window.open_project(text_of(sample.path())));
  const QString name = QString::fromStdString(window.workbench()->document.volumes().front().name);
  QVERIFY(window.banners().has(QStringLiteral("missing-") + name));
  const std::string file = window.workbench()->document.volumes().front().file;
  window.relink(QString(), text_of(sample.path().parent_path() / "elsewhere" / file));
  QTRY_VERIFY2(!window.banners().has(QStringLiteral("missing-") + name),
               qPrintable(window.banners().text(QStringLiteral("failure"))));
  QVERIFY(window.workbench()->document.project().missing().empty());
}

void MainWindowTest::footwall_edit_shows_in_the_window() {
  const SampleProject sample;
  MainWindow window({});
  window.show();
  QVERIFY(window.open_project(text_of(sample.path())));
  Document& document = window.workbench()->document;
  const std::size_t faults = document.faults().size(), steps = document.history().size();
  QProcess footwall;
  footwall.start(QCoreApplication::applicationDirPath() + QStringLiteral("/footwall"),
                 {QStringLiteral("edit"), text_of(sample.path())});
  QVERIFY(footwall.waitForStarted());
  footwall.write(
      "{\"op\":\"add\",\"what\":\"fault\",\"name\":\"one\"}\n{\"op\":\"add\",\"what\":\"fault\",\"name\":"
      "\"two\"}\n");
  footwall.closeWriteChannel();
  QTRY_VERIFY(footwall.state() == QProcess::NotRunning);
  QVERIFY2(footwall.exitCode() == 0, footwall.readAllStandardError());
  QCOMPARE(footwall.readAllStandardOutput().count('\n'), 2);
  QCOMPARE(document.faults().size(), faults + 2);
  QCOMPARE(document.history().size(), steps + 2);
  QVERIFY(document.undo());
  QCOMPARE(document.faults().back().record.name, std::string("one"));
}

void MainWindowTest::drops_old_history_when_told_to() {
  const SampleProject sample;
  MainWindow window({});
  window.show();
  QVERIFY(window.open_project(text_of(sample.path())));
  Document& document = window.workbench()->document;
  QVERIFY(!window.banners().has(QStringLiteral("history")));
  for (int n = 0; n < 3; ++n) QVERIFY(new_fault(document) != 0);
  const std::size_t steps = document.history().size(), faults = document.faults().size();
  document.store().set_setting("history.keep_days", "0");
  QTRY_COMPARE(document.project().history_size(days_ago(0)).steps, static_cast<std::int64_t>(steps));
  warn_of_history(window);
  QVERIFY2(window.banners().text(QStringLiteral("history")).contains(QString::number(steps)),
           qPrintable(window.banners().text(QStringLiteral("history"))));
  QVERIFY(window.banners().press(QStringLiteral("history"), 0));
  auto* dialog = window.findChild<TrimHistoryDialog*>();
  QVERIFY(dialog != nullptr);
  QVERIFY2(dialog->message().startsWith(QStringLiteral("%1 of %1 steps").arg(steps)),
           qPrintable(dialog->message()));
  dialog->trim();
  QTRY_COMPARE(document.history().size(), std::size_t{0});
  QCOMPARE(document.faults().size(), faults);
  QVERIFY(!document.can_undo());
  QVERIFY(new_fault(document) != 0);
  QVERIFY(document.can_undo());
}

void MainWindowTest::takes_dropped_files() {
  const SampleProject sample;
  MainWindow window({});
  window.show();
  const QString sticks = text_of(sample.path().parent_path() / "picks.dat");
  const QString surface = text_of(sample.path().parent_path() / "plane.ts");
  drop(window, text_of(sample.path()));
  QVERIFY(window.workbench() != nullptr);
  Document& document = window.workbench()->document;
  const survey::WorldPoint a = document.survey()->world_of({5, 5, 5});
  const survey::WorldPoint b = document.survey()->world_of({5, 9, 30});
  const survey::WorldPoint c = document.survey()->world_of({20, 5, 5});
  std::ofstream(sticks.toStdString()) << a.x << ' ' << a.y << ' ' << a.z << " 1 1\n"
                                      << b.x << ' ' << b.y << ' ' << b.z << " 1 2\n"
                                      << c.x << ' ' << c.y << ' ' << c.z << " 2 1\n"
                                      << c.x << ' ' << c.y << ' ' << c.z + 40 << " 2 2\n";
  std::ofstream(surface.toStdString())
      << "GOCAD TSurf 1\nHEADER {\nname:plane\n}\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME Default\nAXIS_NAME "
         "\"X\" "
         "\"Y\" \"Z\"\nAXIS_UNIT \"m\" \"m\" \"ms\"\nZPOSITIVE Depth\nEND_ORIGINAL_COORDINATE_SYSTEM\nTFACE\n"
      << "VRTX 1 " << a.x << ' ' << a.y << ' ' << a.z << "\nVRTX 2 " << b.x << ' ' << b.y << ' ' << b.z
      << "\nVRTX 3 " << c.x << ' ' << c.y << ' ' << c.z << "\nTRGL 1 2 3\nEND\n";
  const std::size_t faults = document.faults().size();
  drop(window, sticks);
  QTRY_VERIFY2(document.faults().size() == faults + 1,
               qPrintable(window.banners().text(QStringLiteral("failure"))));
  QTRY_VERIFY(window.banners().has(QStringLiteral("import")));
  drop(window, surface);
  QTRY_VERIFY2(document.faults().size() == faults + 2,
               qPrintable(window.banners().text(QStringLiteral("failure"))));
  QVERIFY(document.undo());
  QVERIFY(document.undo());
  QCOMPARE(document.faults().size(), faults);
  const QString text = text_of(sample.path().parent_path() / "letter.txt");
  std::ofstream(text.toStdString()) << "Dear all,\n";
  drop(window, text);
  QVERIFY(window.banners().text(QStringLiteral("failure")).contains(QStringLiteral("letter.txt")));
}

void MainWindowTest::makes_the_demo_as_a_job() {
  QTemporaryDir folder;
  const QString path = folder.filePath(QStringLiteral("demo.footwall"));
  MainWindow window({});
  window.show();
  window.make_demo(path);
  QCOMPARE(window.start_jobs().running(), 1);
  QVERIFY(window.actions().action(QStringLiteral("compute.cancel")) != nullptr);
  // The whole one takes its time; that it can be cancelled, leaving nothing, tells that it is one.
  window.start_jobs().cancel(window.start_jobs().index(0).data(Jobs::kNumber).toInt());
  QTRY_COMPARE_WITH_TIMEOUT(window.start_jobs().running(), 0, 60000);
  QVERIFY(!QFileInfo::exists(path));
  QVERIFY(window.workbench() == nullptr);
}

void MainWindowTest::reads_out_the_cursor() {
  const SampleProject sample;
  MainWindow window({});
  QVERIFY(window.open_project(text_of(sample.path())));
  const survey::Geometry& survey = *window.workbench()->document.survey();
  window.workbench()->display.set_cursor(survey::IndexPoint{3, 7, 11});
  const QString text = window.status_line().text();
  QVERIFY2(text.contains(QStringLiteral("il %1 xl %2 sample 11")
                             .arg(survey.inlines.line_of(3))
                             .arg(survey.crosslines.line_of(7))),
           qPrintable(text));
  QVERIFY(text.contains(QStringLiteral(" ms ")) || text.contains(QStringLiteral(" m ")));
  window.workbench()->display.set_cursor(std::nullopt);
  QVERIFY(window.status_line().text().isEmpty());
}

void MainWindowTest::goes_to_a_step_of_the_history_by_a_click() {
  const SampleProject sample;
  MainWindow window({});
  window.resize(1400, 900);
  window.show();
  QVERIFY(window.open_project(text_of(sample.path())));
  Document& document = window.workbench()->document;
  const std::size_t faults = document.faults().size();
  const int before = static_cast<int>(document.history().size());
  for (int n = 0; n < 3; ++n) QVERIFY(new_fault(document) != 0);
  auto* panel = window.docks().dock(Panel::kHistory)->findChild<HistoryPanel*>();
  QVERIFY(panel != nullptr);
  panel->scrollTo(panel->model()->index(before + 1, 0));
  const QPoint place = panel->visualRect(panel->model()->index(before + 1, 0)).center();
  QTest::mouseClick(panel->viewport(), Qt::LeftButton, {}, place);
  QTRY_COMPARE(document.faults().size(), faults + 1);
  QVERIFY(document.can_redo());
}

void MainWindowTest::inspects_what_is_selected() {
  const SampleProject sample;
  MainWindow window({});
  window.show();
  QVERIFY(window.open_project(text_of(sample.path())));
  Workbench& bench = *window.workbench();
  auto* inspector = window.docks().dock(Panel::kInspector)->findChild<InspectorPanel*>();
  QVERIFY(inspector != nullptr);
  const Fault& fault = bench.document.faults().front();
  bench.selection.select({.kind = Item::Kind::kFault, .id = fault.record.id});
  QVERIFY(inspector->shown().title.contains(QString::fromStdString(fault.record.name)));
  QCOMPARE(inspector->shown().rows.front().second, QString::number(fault.pillars.size()));
  bench.selection.select({.kind = Item::Kind::kNode, .id = fault.pillars.front().nodes.front().id});
  QCOMPARE(inspector->shown().title, QStringLiteral("Node"));
  bench.selection.select({.kind = Item::Kind::kVolume, .id = bench.document.volumes().front().id});
  QVERIFY(inspector->shown().title.startsWith(QStringLiteral("Volume")));
  bench.selection.select({.kind = Item::Kind::kSurvey});
  QCOMPARE(inspector->shown().title, QStringLiteral("Survey"));
}

void MainWindowTest::goes_on_without_the_volume_shown() {
  const SampleProject sample;
  MainWindow window({});
  window.resize(1400, 900);
  window.show();
  QVERIFY(window.open_project(text_of(sample.path())));
  Workbench& bench = *window.workbench();
  QTRY_VERIFY(window.is_settled());
  // One volume after the other, as the picture of an isosurface and as triangles, until none is left.
  while (!bench.document.volumes().empty()) {
    const Id volume = bench.document.volumes().front().id;
    bench.display.set_volume(volume);
    bench.display.add_isosurface(volume, 0.5);
    IsosurfaceLook mesh = bench.display.isosurfaces().front();
    mesh.id = bench.display.add_isosurface(volume, 0.6);
    mesh.as_picture = false;
    bench.display.change_isosurface(mesh);
    bench.selection.select({.kind = Item::Kind::kVolume, .id = volume});
    window.actions().action(QStringLiteral("edit.delete"))->trigger();
    auto* yes = window.findChild<QPushButton*>(QStringLiteral("delete"));
    QVERIFY(yes != nullptr);
    yes->click();
    QVERIFY(bench.display.volume() != volume);
    QVERIFY(bench.display.isosurfaces().empty());
    QTRY_VERIFY(window.is_settled());
    QTRY_VERIFY(window.findChild<QPushButton*>(QStringLiteral("delete")) == nullptr);
  }
  QCOMPARE(bench.display.volume(), 0);
  QVERIFY(!window.banners().has(QStringLiteral("failure")));
  QVERIFY(!window.actions().action(QStringLiteral("compute.run"))->isEnabled());
  QVERIFY(new_fault(bench.document) != 0);
  QVERIFY(bench.document.undo());
}

void MainWindowTest::saves_and_restores_views() {
  const SampleProject sample;
  MainWindow window({});
  window.resize(1400, 900);
  window.show();
  QVERIFY(window.open_project(text_of(sample.path())));
  if (!window.views()->scene()->is_built()) {
    QVERIFY(!save_view_as(window, QStringLiteral("from the south")));
    QVERIFY(window.banners().has(QStringLiteral("failure")));
    return;
  }
  Display& display = window.workbench()->display;
  QTRY_VERIFY(window.is_settled());
  const Item fault{.kind = Item::Kind::kFault, .id = window.workbench()->document.faults().front().record.id};
  const auto& camera = window.views()->factories().camera;
  const QWidget& scene = *window.views()->scene()->view();
  window.actions().action(QStringLiteral("view.from-south"))->trigger();
  display.set_visible(fault, false);
  const Id volume = window.workbench()->document.volumes().front().id;
  const Id kept = display.add_isosurface(volume, 0.5);
  const Id deleted = display.add_isosurface(volume, 0.7);
  IsosurfaceLook as_triangles = display.isosurfaces()[0];
  as_triangles.as_picture = false;
  display.change_isosurface(as_triangles);
  const QString stored = camera(scene);
  QVERIFY(save_view_as(window, QStringLiteral("from the south")));
  window.actions().action(QStringLiteral("view.from-top"))->trigger();
  display.set_visible(fault, true);
  QVERIFY(camera(scene) != stored);
  as_triangles.as_picture = true;
  as_triangles.colour = QStringLiteral("#123456");
  display.change_isosurface(as_triangles);
  display.remove_isosurface(deleted);
  const Id unknown = display.add_isosurface(volume, 0.9);
  restore_view(window, QStringLiteral("from the south"));
  QVERIFY(!display.is_visible(fault));
  QCOMPARE(camera(scene), stored);
  QCOMPARE(display.isosurfaces().size(), std::size_t{3});
  for (const IsosurfaceLook& look : display.isosurfaces()) {
    QCOMPARE(look.visible, look.id != unknown);
    if (look.id == kept) QVERIFY(!look.as_picture && look.colour != as_triangles.colour);
    if (look.id != kept && look.id != unknown) QCOMPARE(look.value, 0.7);
  }
  // Enter on its row opens the dialog of an isosurface that is there.
  auto* panel = window.findChild<ProjectPanel*>();
  Q_EMIT panel->activated(panel->tree().index_of({.kind = Item::Kind::kIsosurface, .id = kept}));
  QTRY_VERIFY(QApplication::activeModalWidget() != nullptr || !window.findChildren<QDialog*>().isEmpty());
  QDialog* dialog = window.findChildren<QDialog*>().back();
  QCOMPARE(dialog->windowTitle(), QStringLiteral("Isosurface"));
  dialog->reject();
  QCOMPARE(display.isosurfaces().size(), std::size_t{3});
  restore_view(window, QStringLiteral("no such view"));
  QVERIFY(window.banners().has(QStringLiteral("failure")));
}

void MainWindowTest::an_idle_window_paints_nothing() {
  const SampleProject sample;
  MainWindow window({});
  window.resize(1400, 900);
  window.show();
  QVERIFY(window.open_project(text_of(sample.path())));
  QTRY_VERIFY(window.is_settled());
  class Count final : public QObject {
   public:
    int paints = 0;

   protected:
    bool eventFilter(QObject*, QEvent* event) override {
      paints += event->type() == QEvent::Paint ? 1 : 0;
      return false;
    }
  } count;
  // Until nothing is painted for half a second; the deadline is what fails.
  qApp->installEventFilter(&count);
  bool idle = false;
  for (int n = 0; n < 20 && !idle; ++n) {
    count.paints = 0;
    QTest::qWait(500);
    idle = count.paints == 0;
  }
  qApp->removeEventFilter(&count);
  QVERIFY(idle);
}

void MainWindowTest::says_that_the_engine_is_off() {
  const SampleProject sample;
  MainWindow window({});  // nobody asked for an engine
  window.show();
  QVERIFY(window.open_project(QString::fromStdString(sample.path().string())));
  const QString key = QStringLiteral("engine");
  QVERIFY2(window.banners().text(key).contains(QLatin1String("no live colours")),
           qPrintable(window.banners().text(key)));
  QVERIFY(!window.banners().text(key).contains(QLatin1String("isosurfaces")));
  // An isosurface that the engine would draw is not waited for.
  Display& display = window.workbench()->display;
  display.add_isosurface(display.volume(), 0.5);
  QVERIFY(window.banners().text(key).contains(QLatin1String("isosurfaces")));
  QVERIFY(QTest::qWaitFor([&] { return window.is_settled(); }, 20000));
  QVERIFY(window.banners().press(key, 0));
  QVERIFY(window.workbench()->engine.is_wanted());
  QTRY_VERIFY_WITH_TIMEOUT(!window.banners().has(key), 30000);
}

void MainWindowTest::choices_of_the_tool_bar_open_by_key() {
  const SampleProject sample;
  MainWindow window({});
  window.show();
  QVERIFY(window.open_project(QString::fromStdString(sample.path().string())));
  Display& display = window.workbench()->display;
  // The menu is modal: what is to be done in it comes from a timer.
  const auto choose = [&](const char* action, const QString& what) {
    QTimer::singleShot(0, &window, [&window, what] {
      auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
      QVERIFY(menu != nullptr);
      for (QAction* one : menu->actions()) {
        if (one->text() == what) menu->setActiveAction(one);
      }
      QTest::keyClick(menu, Qt::Key_Return);
    });
    window.actions().action(QString::fromLatin1(action))->trigger();
  };
  choose("choose.colours", QStringLiteral("viridis"));
  QTRY_COMPARE(display.samples().colour_map, QStringLiteral("viridis"));
  choose("choose.clip", QStringLiteral("clip 95 %"));
  QTRY_COMPARE(display.samples().clip_percentile, 95.0);
}

void MainWindowTest::the_tool_bar_keeps_its_buttons_in_a_narrow_window() {
  const SampleProject sample;
  MainWindow window({});
  window.show();
  QVERIFY(window.open_project(QString::fromStdString(sample.path().string())));
  const auto buttons = window.tool_bar()->findChildren<ActionButton*>();
  QVERIFY(!buttons.isEmpty());
  const auto width_of_all = [&] {
    int width = 0;
    for (const ActionButton* button : buttons) width += button->width();
    return width;
  };
  window.resize(1800, 800);
  QCoreApplication::processEvents();
  const int wide = width_of_all();
  for (const int width : {1280, 1100}) {
    window.resize(width, 800);
    QCoreApplication::processEvents();
    QCOMPARE(window.width(), width);
    for (const ActionButton* button : buttons) QVERIFY(button->isVisible());
    QVERIFY(width_of_all() < wide);
  }
  window.resize(1800, 800);
  QCoreApplication::processEvents();
  QCOMPARE(width_of_all(), wide);
}

static const RegisterTest<MainWindowTest> kRegistered;

}  // namespace footwall::ui

#include "main_window_test.moc"
