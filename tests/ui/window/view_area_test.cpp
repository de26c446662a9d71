#include "ui/window/view_area.h"

#include <QLabel>
#include <QTest>

#include "ui/sample_project.h"
#include "ui/test_class.h"
#include "ui/window/view_tile.h"

namespace footwall::ui {
namespace {

// Views that only say what they are of.
ViewFactories labels() {
  ViewFactories views;
  views.section = [](Workbench&, Id section, QWidget* parent) -> QWidget* {
    auto* label = new QLabel(QString::number(section), parent);
    label->setFocusPolicy(Qt::StrongFocus);
    return label;
  };
  views.scene = [](Workbench&, QWidget* parent) -> QWidget* {
    auto* label = new QLabel(QStringLiteral("scene"), parent);
    label->setFocusPolicy(Qt::StrongFocus);
    return label;
  };
  return views;
}

struct Open {
  SampleProject sample;
  QString held;
  std::unique_ptr<Workbench> bench = open_workbench(sample.path(), {}, &held);
};

}  // namespace

class ViewAreaTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void has_a_tile_for_the_scene_and_each_section();
  void titles_follow_what_is_shown();
  void maximises_and_puts_back();
  void tiles_come_and_go_with_sections();
  void remembers_its_columns();
  void bad_layouts_do_no_harm();
  void says_what_is_not_built();
};

void ViewAreaTest::has_a_tile_for_the_scene_and_each_section() {
  const Open open;
  ViewArea area(*open.bench, labels(), {});
  const auto tiles = area.tiles();
  QCOMPARE(tiles.size(), 1 + open.bench->display.sections().size());
  QCOMPARE(tiles.front()->section(), 0);
  QVERIFY(area.active() == tiles.front());
  area.activate_next(1);
  QCOMPARE(area.active_section(), open.bench->display.sections().front().id);
  area.activate_next(-2);
  QVERIFY(area.active() == tiles.back());
}

void ViewAreaTest::titles_follow_what_is_shown() {
  const Open open;
  ViewArea area(*open.bench, labels(), {});
  const auto& shown = open.bench->display.sections().front();
  const ViewTile* tile = area.tiles()[1];
  const auto& survey = *open.bench->document.survey();
  QCOMPARE(tile->title(), title_of(shown.section, survey));
  open.bench->display.move_section(shown.id, stepped(shown.section, 3, survey));
  QCOMPARE(tile->title(), title_of(open.bench->display.sections().front().section, survey));
}

void ViewAreaTest::maximises_and_puts_back() {
  const Open open;
  ViewArea area(*open.bench, labels(), {});
  area.resize(1000, 700);
  area.show();
  const auto tiles = area.tiles();
  const QJsonObject before = area.layout();
  QTest::mouseDClick(tiles[2]->findChild<QWidget*>(QString(), Qt::FindDirectChildrenOnly), Qt::LeftButton);
  QVERIFY(area.maximised() == tiles[2]);
  for (const ViewTile* tile : tiles) QCOMPARE(tile->isVisible(), tile == tiles[2]);
  QCoreApplication::processEvents();
  QCOMPARE(area.layout(), before);  // as a project closed now would keep it
  area.maximise(tiles[2]);
  for (const ViewTile* tile : tiles) QVERIFY(tile->isVisible());
}

void ViewAreaTest::tiles_come_and_go_with_sections() {
  const Open open;
  ViewArea area(*open.bench, labels(), {});
  const std::size_t before = area.tiles().size();
  const Id added = open.bench->display.add_section({.kind = Section::Kind::kSlice, .index = 5});
  QCOMPARE(area.tiles().size(), before + 1);
  for (ViewTile* tile : area.tiles()) {
    if (tile->section() == added) area.activate(tile);
  }
  area.maximise(area.active());
  area.close(area.active());
  QCOMPARE(area.tiles().size(), before);
  QVERIFY(area.maximised() == nullptr);
  QVERIFY(area.active() != nullptr);
  area.show_scene(false);
  QVERIFY(!area.has_scene());
  while (!area.tiles().empty()) area.close(area.tiles().front());
  QVERIFY(area.active() == nullptr);
  area.show_scene(true);
  QCOMPARE(area.tiles().size(), 1U);
}

void ViewAreaTest::remembers_its_columns() {
  const Open open;
  QJsonObject layout;
  std::vector<Id> order;
  {
    ViewArea area(*open.bench, labels(), {});
    area.resize(1000, 700);
    area.show();
    area.move_to_own_column(area.tiles()[2]);
    for (const ViewTile* tile : area.tiles()) order.push_back(tile->section());
    layout = area.layout();
  }
  QCOMPARE(layout["columns"].toArray().size(), 3);
  ViewArea area(*open.bench, labels(), layout);
  std::vector<Id> again;
  for (const ViewTile* tile : area.tiles()) again.push_back(tile->section());
  QCOMPARE(again, order);
  QCOMPARE(area.layout()["columns"].toArray().size(), 3);
}

void ViewAreaTest::bad_layouts_do_no_harm() {
  const Open open;
  const std::size_t all = open.bench->display.sections().size();
  for (const char* text :
       {"[]", "{\"columns\":3}", "{\"columns\":[{\"tiles\":[7,-5,\"a\",0,0,null],\"heights\":[1e300,-3]}]}",
        "{\"columns\":[{\"tiles\":[]}],\"widths\":[\"x\"]}"}) {
    ViewArea area(*open.bench, labels(), QJsonDocument::fromJson(text).object());
    std::size_t sections = 0;
    for (const ViewTile* tile : area.tiles()) sections += tile->section() != 0 ? 1 : 0;
    QCOMPARE(sections, all);
  }
}

void ViewAreaTest::says_what_is_not_built() {
  const Open open;
  ViewArea area(*open.bench, {}, {});
  for (const ViewTile* tile : area.tiles()) {
    QVERIFY(!tile->is_built());
    QVERIFY(qobject_cast<QLabel*>(tile->view()) != nullptr);
  }
}

static const RegisterTest<ViewAreaTest> kRegistered;

}  // namespace footwall::ui

#include "view_area_test.moc"
