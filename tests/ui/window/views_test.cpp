#include <QInputDialog>
#include <QJsonObject>
#include <QPushButton>
#include <QSpinBox>
#include <QTest>
#include <QTimer>
#include <algorithm>

#include "engine/tasks/new_project.h"
#include "ui/sample_project.h"
#include "ui/test_class.h"
#include "ui/window/actions.h"
#include "ui/window/empty_views.h"
#include "ui/window/line_dialog.h"
#include "ui/window/main_window.h"
#include "ui/window/status_line.h"
#include "ui/window/view_area.h"
#include "ui/window/view_tile.h"

namespace footwall::ui {
namespace {

// A window with the sample project, on the screen.
struct OpenWindow {
  explicit OpenWindow(const std::filesystem::path& project) {
    window.resize(1200, 800);
    window.show();
    opened = window.open_project(QString::fromStdString(project.string())) &&
             QTest::qWaitFor([this] { return window.views()->isVisible(); });
  }
  Display& display() { return window.workbench()->display; }
  QAction& action(const char* id) { return *window.actions().action(QString::fromLatin1(id)); }
  ViewTile* tile_of(Section::Kind kind) {
    for (const Display::ShownSection& shown : display().sections()) {
      if (shown.section.kind != kind) continue;
      for (ViewTile* tile : window.views()->tiles()) {
        if (tile->section() == shown.id) return tile;
      }
    }
    return nullptr;
  }
  const Display::ShownSection& shown(const ViewTile& tile) {
    return *std::ranges::find(display().sections(), tile.section(), &Display::ShownSection::id);
  }

  MainWindow window{{}};
  bool opened = false;
};

}  // namespace

class ViewsTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void a_line_is_drawn_on_a_slice();
  void a_lines_ends_are_numbers();
  void cameras_and_zooms_are_remembered();
  void a_plane_leaves_the_scene_and_comes_back();
  void says_how_far_pillars_are_drawn();
  void closed_views_come_back_by_a_button();
  void a_scene_without_a_survey_offers_an_import();
};

void ViewsTest::a_line_is_drawn_on_a_slice() {
  const SampleProject sample;
  OpenWindow open(sample.path());
  QVERIFY(open.opened);
  while (ViewTile* tile = open.tile_of(Section::Kind::kSlice)) open.window.views()->close(tile);
  QAction& draw = open.action("view.draw-line");
  draw.trigger();
  QVERIFY(open.window.workbench()->line.is_active());
  QVERIFY(draw.isChecked());
  ViewTile* slice = open.tile_of(Section::Kind::kSlice);
  QVERIFY(slice != nullptr && open.window.views()->active() == slice);
  QVERIFY(open.window.status_line().hint().contains(QStringLiteral("first end of the line")));
  open.window.workbench()->picking.set_tool(Tool::kPick);  // ends it
  QVERIFY(!draw.isChecked());
  draw.trigger();
  open.action("tool.leave").trigger();
  QVERIFY(!open.window.workbench()->line.is_active());
  QCOMPARE(open.window.workbench()->picking.tool(), Tool::kPick);  // one Esc, one thing left
  // A view that fills the window makes room for the slice.
  open.window.views()->maximise(open.window.views()->tiles().front());
  draw.trigger();
  QVERIFY(open.window.views()->maximised() == nullptr);
  QCOMPARE(open.tile_of(Section::Kind::kSlice), slice);
  open.window.workbench()->line.put({3, 4, 0});
  open.window.workbench()->line.put({30, 35, 0});
  const Section made = open.display().sections().back().section;
  QVERIFY(made == (Section{.kind = Section::Kind::kLine, .from = {3, 4, 0}, .to = {30, 35, 0}}));
  QCOMPARE(open.window.views()->active_section(), open.display().sections().back().id);
}

void ViewsTest::a_lines_ends_are_numbers() {
  const SampleProject sample;
  OpenWindow open(sample.path());
  QVERIFY(open.opened);
  const survey::Geometry survey = *open.window.workbench()->document.survey();
  QAction& ends = open.action("view.line-ends");
  open.window.views()->activate(open.tile_of(Section::Kind::kInline));
  QVERIFY(!ends.isEnabled());
  open.action("view.line").trigger();
  QVERIFY(ends.isEnabled());
  const Section before = open.display().sections().back().section;
  const auto now = [&] { return open.display().sections().back().section; };
  const auto set = [&](const QDialog& dialog, const char* name, const survey::LineAxis& axis,
                       std::int64_t index) {
    dialog.findChild<QSpinBox*>(QLatin1String(name))->setValue(static_cast<int>(axis.line_of(index)));
  };
  ends.trigger();
  auto* dialog = open.window.findChild<LineDialog*>();
  QVERIFY(dialog != nullptr && dialog->isVisible());
  set(*dialog, "from-inline", survey.inlines, 7);
  set(*dialog, "to-crossline", survey.crosslines, 11);
  QVERIFY(now().from == (survey::IndexPoint{7, 0, 0}));
  QVERIFY(now().to == (survey::IndexPoint{47, 11, 0}));
  dialog->reject();
  QVERIFY(now() == before);
  QTRY_VERIFY(open.window.findChild<LineDialog*>() == nullptr);
  // By the view's title, too.
  ViewTile* tile = open.tile_of(Section::Kind::kLine);
  for (auto* button : tile->findChildren<QToolButton*>()) {
    if (button->text() == QStringLiteral("ends…")) button->click();
  }
  dialog = open.window.findChild<LineDialog*>();
  QVERIFY(dialog != nullptr);
  auto* ok = dialog->findChild<QPushButton*>();
  set(*dialog, "from-inline", survey.inlines, 47);
  QVERIFY(ok->isEnabled());
  set(*dialog, "from-crossline", survey.crosslines, 39);
  QVERIFY(!ok->isEnabled());
  QVERIFY(!(now().from == now().to));
  set(*dialog, "from-crossline", survey.crosslines, 20);
  dialog->accept();
  QVERIFY(now().from == (survey::IndexPoint{47, 20, 0}));
}

void ViewsTest::cameras_and_zooms_are_remembered() {
  const SampleProject sample;
  QString camera;
  QJsonObject look;
  {
    OpenWindow open(sample.path());
    QVERIFY(open.opened);
    QTRY_VERIFY(open.window.is_settled());
    const ViewFactories& factories = open.window.views()->factories();
    open.action("view.from-south").trigger();
    ViewTile* section = open.tile_of(Section::Kind::kCrossline);
    for (const Qt::Key key : {Qt::Key_Plus, Qt::Key_Plus, Qt::Key_Left})
      QTest::keyClick(section->view()->focusProxy(), key);
    camera = factories.camera(*open.window.views()->scene()->view());
    look = factories.section_look(*section->view());
    QVERIFY(!look.isEmpty() && !camera.isEmpty());
    const QJsonObject layout = open.window.views()->layout();
    QTest::qWait(50);
    QCOMPARE(open.window.views()->layout(), layout);  // nothing to store anew
    open.window.close();
  }
  OpenWindow open(sample.path());
  QVERIFY(open.opened);
  QTRY_VERIFY(open.window.is_settled());
  const ViewFactories& factories = open.window.views()->factories();
  QCOMPARE(factories.camera(*open.window.views()->scene()->view()), camera);
  QCOMPARE(factories.section_look(*open.tile_of(Section::Kind::kCrossline)->view()), look);
}

void ViewsTest::a_plane_leaves_the_scene_and_comes_back() {
  const SampleProject sample;
  OpenWindow open(sample.path());
  QVERIFY(open.opened);
  ViewTile* tile = open.tile_of(Section::Kind::kInline);
  open.window.views()->activate(tile);
  QAction& in_scene = open.action("view.in-scene");
  auto* button = tile->findChild<QToolButton*>(QStringLiteral("in-scene"));
  QVERIFY(in_scene.isEnabled() && in_scene.isChecked() && button->isChecked());
  in_scene.trigger();
  QVERIFY(!open.shown(*tile).in_scene && !in_scene.isChecked() && !button->isChecked());
  button->click();
  QVERIFY(open.shown(*tile).in_scene && in_scene.isChecked() && button->isChecked());
  open.window.views()->activate(open.window.views()->scene());
  QVERIFY(!in_scene.isEnabled());
}

void ViewsTest::says_how_far_pillars_are_drawn() {
  const SampleProject sample;
  OpenWindow open(sample.path());
  QVERIFY(open.opened);
  const auto answer = [&](bool accept) {
    QTimer::singleShot(0, &open.window, [&open, accept] {
      auto* dialog = open.window.findChild<QInputDialog*>();
      if (dialog == nullptr) return;
      dialog->setDoubleValue(4.5);
      accept ? dialog->accept() : dialog->reject();
    });
    open.action("view.fade").trigger();
  };
  const double before = open.display().fade_distance();
  answer(false);
  QCOMPARE(open.display().fade_distance(), before);
  answer(true);
  QCOMPARE(open.display().fade_distance(), 4.5);
}

void ViewsTest::closed_views_come_back_by_a_button() {
  const SampleProject sample;
  OpenWindow open(sample.path());
  QVERIFY(open.opened);
  ViewArea& views = *open.window.views();
  auto* empty = open.window.findChild<EmptyViews*>();
  QVERIFY(!empty->isVisible());
  while (!views.tiles().empty()) views.close(views.tiles().front());
  QVERIFY(empty->isVisible());
  const auto press = [&](const char* action) {
    auto* button = empty->findChild<QPushButton*>(QLatin1String(action));
    QVERIFY(button->isVisible());
    QTest::mouseClick(button, Qt::LeftButton);
  };
  QVERIFY(!empty->findChild<QPushButton*>(QStringLiteral("file.import"))->isVisible());
  press("view.crossline");
  QVERIFY(!empty->isVisible());
  QCOMPARE(views.tiles().size(), 1U);
  QVERIFY(views.active() == open.tile_of(Section::Kind::kCrossline) && views.active()->isVisible());
  views.close(views.active());
  press("view.scene");
  QVERIFY(!empty->isVisible());
  QVERIFY(views.active() == views.scene() && views.scene()->isVisible());
}

void ViewsTest::a_scene_without_a_survey_offers_an_import() {
  QTemporaryDir folder;
  const std::filesystem::path path = std::filesystem::path(folder.path().toStdString()) / "empty.footwall";
  tasks::new_empty_project(path);
  OpenWindow open(path);
  QVERIFY(open.opened);
  ViewArea& views = *open.window.views();
  QString asked;
  // What the window does with it would wait for an answer.
  views.disconnect(&open.window);
  connect(&views, &ViewArea::action_asked, this, [&asked](const QString& action) { asked = action; });
  const auto press_import = [&asked](QWidget& in) {
    for (auto* button : in.findChildren<QPushButton*>()) {
      if (!button->isVisible() || !button->text().startsWith(QStringLiteral("Import"))) continue;
      QTest::mouseClick(button, Qt::LeftButton);
      return true;
    }
    return false;
  };
  QVERIFY(press_import(*views.scene()));
  QCOMPARE(asked, QStringLiteral("file.import"));
  asked.clear();
  while (!views.tiles().empty()) views.close(views.tiles().front());
  QVERIFY(press_import(*open.window.findChild<EmptyViews*>()));
  QCOMPARE(asked, QStringLiteral("file.import"));
  const SampleProject sample;
  OpenWindow surveyed(sample.path());
  QVERIFY(!press_import(*surveyed.window.views()->scene()));
}

static const RegisterTest<ViewsTest> kRegistered;

}  // namespace footwall::ui

#include "views_test.moc"
