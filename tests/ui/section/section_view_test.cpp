#include "ui/section/section_view.h"

#include <QSignalSpy>
#include <QTest>
#include <QWheelEvent>
#include <cmath>
#include <fstream>

#include "engine/tasks/import_surface.h"
#include "engine/tasks/new_project.h"
#include "ui/model/fault_commands.h"
#include "ui/model/sample_colours.h"
#include "ui/sample_project.h"
#include "ui/test_class.h"

namespace footwall::ui {
namespace {

// A view in a window on the screen, its samples arrived.
struct OpenView {
  explicit OpenView(const SampleProject& sample,
                    const Section& section = {.kind = Section::Kind::kInline, .index = 20})
      : bench(sample.open(), {}), shown(bench.display.add_section(section)), view(bench, shown) {
    view.resize(800, 600);
    view.show();
    view.activateWindow();
    view.canvas().setFocus();
    arrived = QTest::qWaitForWindowExposed(&view) &&
              QTest::qWaitFor([&] { return has_its_samples() || !canvas().message().isEmpty(); }, 20000) &&
              has_its_samples();
    QTest::qWait(0);
  }
  SectionCanvas& canvas() { return view.canvas(); }
  bool has_its_samples() { return canvas().samples() && canvas().samples()->section == canvas().section(); }
  QPoint at(double u, double v) { return canvas().view().to_pixels({u, v}).toPoint(); }
  void wheel(const QPointF& at, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
    QWheelEvent event(at, canvas().mapToGlobal(at), {}, {0, 120}, Qt::NoButton, modifiers, Qt::NoScrollPhase,
                      false);
    QApplication::sendEvent(&canvas(), &event);
  }
  void key(Qt::Key key, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
    QTest::keyClick(&canvas(), key, modifiers);
  }

  Workbench bench;
  Id shown;
  SectionView view;
  bool arrived = false;
};

// One pillar on inline 20, from (10, 10) to (20, 50), and one of another fault on inline 23. Neither has a
// surface, whose coming would draw the layer again.
struct Picked {
  explicit Picked(Workbench& bench) {
    const survey::Geometry survey = *bench.document.survey();
    bench.document.edit(QStringLiteral("Pick"), [&](project::Interpretation& now) {
      fault = now.add_fault("Picked");
      now.set_fault_property(fault, "colour", "#ff00ff");
      const std::array here{survey.world_of({20, 10, 10}), survey.world_of({20, 15, 30}),
                            survey.world_of({20, 20, 50})};
      on_section = now.add_pillar(fault, survey::PillarKind::kInterpreted, here).id;
      const std::array near{survey.world_of({23, 30, 10}), survey.world_of({23, 30, 50})};
      other_fault = now.add_fault("Nearby");
      now.set_fault_property(other_fault, "colour", "#ff00ff");
      now.add_pillar(other_fault, survey::PillarKind::kInterpreted, near);
    });
    for (const Fault& other : bench.document.faults()) {
      const bool ours = other.record.id == fault || other.record.id == other_fault;
      bench.display.set_visible({.kind = Item::Kind::kFault, .id = other.record.id}, ours);
    }
  }
  Id fault = 0, on_section = 0, other_fault = 0;
};

int accented(const QImage& image, const QColor& accent, const QRect& box) {
  int count = 0;
  for (int y = box.top(); y <= box.bottom(); ++y) {
    for (int x = box.left(); x <= box.right(); ++x) count += image.pixelColor(x, y) == accent ? 1 : 0;
  }
  return count;
}

int coloured(const QImage& image, const QRect& box) {
  int count = 0;
  for (int y = box.top(); y <= box.bottom(); ++y) {
    for (int x = box.left(); x <= box.right(); ++x) {
      const QRgb pixel = image.pixel(x, y);
      count += qRed(pixel) > qGreen(pixel) + 40 && qBlue(pixel) > qGreen(pixel) + 40 ? 1 : 0;
    }
  }
  return count;
}

}  // namespace

class SectionViewTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void pixels_are_the_volumes_samples();
  void keys_step_and_jump();
  void the_slider_steps();
  void zoom_keeps_what_is_under_the_mouse();
  void presets_say_what_the_mouse_does();
  void steps_on_after_a_pillar();
  void space_and_middle_button_pan();
  void cursors_are_linked();
  void moves_of_the_mouse_draw_no_layer();
  void a_drag_draws_the_moving_fault_alone();
  void finds_what_lies_under_the_mouse();
  void pillars_fade_with_distance();
  void selects_by_click_box_and_lasso();
  void a_lasso_catches_what_is_seen_of_pillars();
  void a_box_around_the_cut_of_an_imported_surface_selects_it();
  void a_selected_face_has_a_thicker_cut();
  void a_hovered_fault_without_a_cut_shows_by_its_pillars();
  void keys_are_let_go_with_the_focus();
  void frames_the_selection();
  void an_empty_view_says_what_to_do();
  void a_missing_volume_is_told();
  void bears_one_sample();
  void hides_what_the_tree_hides();
};

void SectionViewTest::pixels_are_the_volumes_samples() {
  const SampleProject sample;
  OpenView open(sample);
  QVERIFY(open.arrived);
  SampleLook look = open.bench.display.samples();
  look.interpolate = false;
  look.colour_map = QStringLiteral("viridis");
  open.bench.display.set_samples(look);
  for (const Fault& fault : open.bench.document.faults()) {
    open.bench.display.set_visible({.kind = Item::Kind::kFault, .id = fault.record.id}, false);
  }
  const QImage image = open.canvas().grab().toImage();
  const SampleColours colours(look, open.bench.sections.facts(open.bench.display.volume()));
  const SectionSamples& samples = *open.canvas().samples();
  int compared = 0, agree = 0;
  for (int row = 1; row < samples.rows; row += 3) {
    for (int column = 1; column < samples.columns; column += 3) {
      ++compared;
      const QRgb expected = colours.colour_of(samples.at(column, row));
      const QPoint at = open.at(column, row);  // a grid line may cover it
      agree += image.pixel(at) == expected || image.pixel(at + QPoint(3, 2)) == expected ? 1 : 0;
    }
  }
  QVERIFY2(agree > compared * 0.97, qPrintable(QStringLiteral("%1 of %2").arg(agree).arg(compared)));
}

void SectionViewTest::keys_step_and_jump() {
  const SampleProject sample;
  OpenView open(sample);
  QVERIFY(open.arrived);
  const auto index = [&] { return open.canvas().section().index; };
  open.key(Qt::Key_X);
  QCOMPARE(index(), 21);
  open.key(Qt::Key_Z);
  open.key(Qt::Key_Z);
  QCOMPARE(index(), 19);
  open.key(Qt::Key_PageDown);
  QCOMPARE(index(), 29);
  open.bench.display.set_own_step(4);
  open.key(Qt::Key_Z);
  QCOMPARE(index(), 25);
  open.key(Qt::Key_PageUp);
  QCOMPARE(index(), 0);
  QTRY_VERIFY(open.has_its_samples());
  open.bench.picking.set_tool(Tool::kPick);
  open.bench.display.set_own_step(1);  // the user's own holds while picking, too
  open.key(Qt::Key_X);
  open.key(Qt::Key_Z);
  QCOMPARE(index(), 0);
  open.bench.display.set_own_step(std::nullopt);
  open.key(Qt::Key_X);
  QCOMPARE(index(), 10);
  open.key(Qt::Key_X, Qt::ShiftModifier);
  QCOMPARE(index(), 11);
  open.bench.picking.set_tool(Tool::kSelect);
  const survey::LineAxis& lines = open.bench.document.survey()->inlines;
  const QString wanted = QString::number(lines.line_of(33));
  for (const QChar digit : wanted) QTest::keyClick(&open.canvas(), digit.toLatin1());
  QCOMPARE(open.canvas().jump_text(), wanted);
  QCOMPARE(index(), 11);
  open.key(Qt::Key_Return);
  QCOMPARE(index(), 33);
  QTest::keyClicks(&open.canvas(), QStringLiteral("9"));
  open.key(Qt::Key_Escape);
  open.key(Qt::Key_Return);
  QCOMPARE(index(), 33);
  QTest::keyClicks(&open.canvas(), QStringLiteral("999999"));
  open.key(Qt::Key_Enter);
  QCOMPARE(index(), open.bench.document.survey()->dims()[0] - 1);
  QTRY_VERIFY(open.has_its_samples());
}

void SectionViewTest::the_slider_steps() {
  const SampleProject sample;
  OpenView open(sample);
  auto* slider = open.view.findChild<QSlider*>();
  QCOMPARE(slider->maximum(), 47);
  QCOMPARE(slider->value(), 20);
  slider->setValue(31);
  QCOMPARE(open.canvas().section().index, 31);
  open.bench.display.move_section(open.shown, {.kind = Section::Kind::kSlice, .index = 60});
  QCOMPARE(slider->maximum(), 63);
  QCOMPARE(slider->value(), 60);
}

void SectionViewTest::zoom_keeps_what_is_under_the_mouse() {
  const SampleProject sample;
  OpenView open(sample);
  const QPointF mouse(431, 222);
  const PlanePoint before = open.canvas().view().to_plane(mouse);
  const double scale = open.canvas().view().pixels_per_u();
  const double stretch = open.canvas().view().stretch();
  open.wheel(mouse);
  open.wheel(mouse, Qt::ShiftModifier);
  const PlanePoint after = open.canvas().view().to_plane(mouse);
  QVERIFY(std::abs(after.u - before.u) < 1e-9 && std::abs(after.v - before.v) < 1e-9);
  QVERIFY(open.canvas().view().pixels_per_u() > scale);
  QVERIFY(open.canvas().view().stretch() > stretch);
  for (int n = 0; n < 100; ++n) open.wheel(mouse);  // as far as it goes
  QVERIFY(!open.canvas().grab().isNull());
  open.key(Qt::Key_Home);
  QCOMPARE(open.canvas().view().pixels_per_u(), scale);
  open.key(Qt::Key_Home, Qt::ShiftModifier);
  QCOMPARE(open.canvas().view().stretch(), 1.0);
}

void SectionViewTest::space_and_middle_button_pan() {
  const SampleProject sample;
  OpenView open(sample);
  SectionCanvas& canvas = open.canvas();
  const PlanePoint under = canvas.view().to_plane(QPointF(400, 300));
  const auto drag = [&](Qt::MouseButton button) {
    QTest::mousePress(&canvas, button, {}, {400, 300});
    QTest::mouseMove(&canvas, {410, 310});
    QTest::mouseMove(&canvas, {460, 330});
    QTest::mouseRelease(&canvas, button, {}, {460, 330});
  };
  drag(Qt::MiddleButton);
  const PlanePoint now = canvas.view().to_plane(QPointF(460, 330));
  QVERIFY(std::abs(now.u - under.u) < 1e-9 && std::abs(now.v - under.v) < 1e-9);
  canvas.fit();
  QTest::keyPress(&canvas, Qt::Key_Space);
  drag(Qt::LeftButton);
  QTest::keyRelease(&canvas, Qt::Key_Space);
  QVERIFY(std::abs(canvas.view().to_plane(QPointF(460, 330)).u - under.u) < 1e-9);
  QVERIFY(!open.bench.selection.current());
}

void SectionViewTest::presets_say_what_the_mouse_does() {
  const SampleProject sample;
  OpenView open(sample);
  SectionCanvas& canvas = open.canvas();
  const QPoint middle = open.at(20, 30);
  const auto drag = [&](Qt::MouseButton button, const QPoint& by) {
    QTest::mousePress(&canvas, button, {}, middle);
    QTest::mouseMove(&canvas, middle + by / 2);
    QTest::mouseMove(&canvas, middle + by);
    QTest::mouseRelease(&canvas, button, {}, middle + by);
  };
  const double scale = canvas.view().pixels_per_u();
  const auto index = [&] { return canvas.section().index; };
  drag(Qt::RightButton, {0, -60});
  QCOMPARE(canvas.view().pixels_per_u(), scale);  // bound to nothing at first
  open.bench.mouse.choose(QStringLiteral("Landmark"));
  drag(Qt::RightButton, {0, -60});
  QVERIFY(canvas.view().pixels_per_u() > 1.5 * scale);
  const std::int64_t before = index();
  open.wheel(middle);
  QCOMPARE(index(), before + 1);
  const double zoomed = canvas.view().pixels_per_u();
  open.wheel(middle, Qt::ControlModifier);
  QCOMPARE(index(), before + 1);
  QVERIFY(canvas.view().pixels_per_u() > zoomed);
  open.bench.mouse.choose(QStringLiteral("Petrel-like"));
  const QPoint place = open.at(20, 30);
  drag(Qt::RightButton, {40, 20});
  const QPoint off = open.at(20, 30) - place - QPoint(40, 20);
  QVERIFY(std::abs(off.x()) <= 1 && std::abs(off.y()) <= 1);
  open.bench.mouse.choose(QStringLiteral("Footwall"));
  open.wheel(middle);
  QCOMPARE(index(), before + 1);
}

void SectionViewTest::steps_on_after_a_pillar() {
  const SampleProject sample;
  OpenView open(sample);
  open.bench.picking.set_tool(Tool::kPick);
  const auto index = [&] { return open.canvas().section().index; };
  const std::int64_t before = index();
  const auto pick = [&](double from) {
    QTest::mouseClick(&open.canvas(), Qt::LeftButton, {}, open.at(30, from));
    QTest::mouseClick(&open.canvas(), Qt::LeftButton, {}, open.at(31, from + 15));
    open.key(Qt::Key_Return);
  };
  pick(10);
  QCOMPARE(index(), before);
  open.bench.display.set_steps_after_pillar(true);
  pick(40);
  QCOMPARE(index(), before + 10);
  open.bench.display.set_own_step(3);
  QTRY_VERIFY(open.has_its_samples());
  pick(10);
  QCOMPARE(index(), before + 13);
}

void SectionViewTest::cursors_are_linked() {
  const SampleProject sample;
  OpenView open(sample);
  const Id other_id = open.bench.display.add_section({.kind = Section::Kind::kCrossline, .index = 10});
  SectionView other(open.bench, other_id);
  other.resize(500, 400);
  other.move(850, 0);
  other.show();
  QVERIFY(QTest::qWaitForWindowExposed(&other));
  QTRY_VERIFY(other.canvas().samples() != nullptr);
  QTRY_VERIFY(open.bench.surfaces.is_settled());  // cuts that come later are no part of it
  const QImage before = other.canvas().grab().toImage();
  QTest::mouseMove(&open.canvas(), open.at(12, 30));
  QTRY_VERIFY(open.bench.display.cursor().has_value());
  const survey::IndexPoint cursor = *open.bench.display.cursor();
  QCOMPARE(cursor.i, 20.0);
  QVERIFY(std::abs(cursor.j - 12) < 0.1 && std::abs(cursor.k - 30) < 0.1);
  const QImage after = other.canvas().grab().toImage();
  const QPointF cross = other.canvas().view().to_pixels({cursor.i, cursor.k});
  const int x = static_cast<int>(cross.x()), y = static_cast<int>(cross.y());
  int differ = 0;
  for (int row = 30; row < 300; ++row) differ += before.pixel(x, row) != after.pixel(x, row) ? 1 : 0;
  QVERIFY(differ > 200);
  QCOMPARE(before.pixel(x + 5, y + 5), after.pixel(x + 5, y + 5));
  Display::ShownSection alone{
      .id = other_id, .section = other.canvas().section(), .in_scene = true, .linked = false};
  open.bench.display.change_section(alone);
  QCOMPARE(other.canvas().grab().toImage(), before);
  // Outside the data there is no place.
  QTest::mouseMove(&open.canvas(), {5, 5});
  QTRY_VERIFY(!open.bench.display.cursor().has_value());
}

void SectionViewTest::moves_of_the_mouse_draw_no_layer() {
  const SampleProject sample;
  OpenView open(sample);
  const Picked picked(open.bench);
  open.canvas().grab();
  const int base = open.canvas().base_redraws();
  const int still = open.canvas().still_redraws();
  for (int n = 0; n < 30; ++n) {
    QTest::mouseMove(&open.canvas(), open.at(5 + n * 0.5, 10 + n));
    open.canvas().grab();
  }
  open.bench.selection.hover({.kind = Item::Kind::kPillar, .id = picked.on_section});
  open.canvas().grab();
  QCOMPARE(open.canvas().base_redraws(), base);
  QCOMPARE(open.canvas().still_redraws(), still);
  open.bench.selection.select({.kind = Item::Kind::kPillar, .id = picked.on_section});
  open.canvas().grab();
  QCOMPARE(open.canvas().base_redraws(), base);  // samples and axes stay
  QVERIFY(open.canvas().still_redraws() > still);
}

void SectionViewTest::a_drag_draws_the_moving_fault_alone() {
  const SampleProject sample;
  OpenView open(sample);
  const Picked picked(open.bench);
  const survey::Geometry& survey = *open.bench.document.survey();
  open.bench.display.set_fade_distance(0);
  const QImage before = open.canvas().grab().toImage();
  const QRect new_place(open.at(30, 30) - QPoint(8, 8), QSize(17, 17));
  QCOMPARE(coloured(before, new_place), 0);
  std::vector<survey::Pillar> pillars = open.bench.document.shown_pillars(picked.fault);
  pillars[0].nodes[1].position = survey.world_of({20, 16, 30});
  open.bench.document.show_provisionally(picked.fault, pillars);
  open.canvas().grab();
  const int base = open.canvas().base_redraws();
  const int still = open.canvas().still_redraws();
  for (int n = 0; n <= 40; ++n) {
    pillars[0].nodes[1].position = survey.world_of({20, 16 + 14 * n / 40.0, 30});
    open.bench.document.show_provisionally(picked.fault, pillars);
    open.canvas().grab();
  }
  QCOMPARE(open.canvas().base_redraws(), base);
  QCOMPARE(open.canvas().still_redraws(), still);
  QVERIFY(coloured(open.canvas().grab().toImage(), new_place) > 20);
  open.bench.document.end_provisional();
  QCOMPARE(open.canvas().grab().toImage(), before);
  QCOMPARE(open.canvas().base_redraws(), base);
}

void SectionViewTest::finds_what_lies_under_the_mouse() {
  const SampleProject sample;
  OpenView open(sample);
  const Picked picked(open.bench);
  const survey::Pillar pillar = *open.bench.document.pillar(picked.on_section);
  const QPointF node = open.canvas().view().to_pixels({15, 30});
  const auto item_at = [&](const QPointF& at) { return open.canvas().hit(at).item; };
  QVERIFY(item_at(node) == (Item{.kind = Item::Kind::kNode, .id = pillar.nodes[1].id}));
  QVERIFY(item_at(node + QPointF(-10.5, 0)).kind == Item::Kind::kNode);
  const QPointF between = open.canvas().view().to_pixels({17.5, 40});
  const FaultShapes::Hit hit = open.canvas().hit(between);
  QVERIFY(hit.item == (Item{.kind = Item::Kind::kPillar, .id = picked.on_section}));
  QCOMPARE(hit.segment, 1);
  QVERIFY(!item_at(between + QPointF(30, 0)));
  QVERIFY(!item_at(open.canvas().view().to_pixels({30, 30})));  // three lines away
  QTest::mouseMove(&open.canvas(), between.toPoint());
  QTRY_VERIFY(open.bench.selection.hovered() == hit.item);
}

void SectionViewTest::pillars_fade_with_distance() {
  const SampleProject sample;
  OpenView open(sample);
  const Picked picked(open.bench);
  const auto strength = [&](double fade) {
    open.bench.display.set_fade_distance(fade);
    const QPoint middle = open.at(30, 30);
    return coloured(open.canvas().grab().toImage(), QRect(middle - QPoint(4, 4), QSize(9, 9)));
  };
  QCOMPARE(strength(2), 0);
  QVERIFY(strength(20) > 0);
  const QPoint solid = open.at(17.5, 40);
  open.bench.display.set_fade_distance(0);
  QVERIFY(coloured(open.canvas().grab().toImage(), QRect(solid - QPoint(4, 4), QSize(9, 9))) > 8);
}

void SectionViewTest::selects_by_click_box_and_lasso() {
  const SampleProject sample;
  OpenView open(sample);
  const Picked picked(open.bench);
  SectionCanvas& canvas = open.canvas();
  Selection& selection = open.bench.selection;
  const survey::Pillar pillar = *open.bench.document.pillar(picked.on_section);
  QTest::mouseClick(&canvas, Qt::LeftButton, {}, open.at(15, 30));
  QCOMPARE(selection.nodes(), std::set<Id>{pillar.nodes[1].id});
  QCOMPARE(selection.active_fault(), picked.fault);
  QTest::mouseClick(&canvas, Qt::LeftButton, Qt::ControlModifier, open.at(10, 10));
  QCOMPARE(selection.nodes().size(), std::size_t{2});
  QTest::mouseClick(&canvas, Qt::LeftButton, {}, open.at(33, 55));
  QVERIFY(selection.nodes().empty());
  const auto drag = [&](const std::vector<QPoint>& path, Qt::KeyboardModifiers modifiers) {
    QTest::mousePress(&canvas, Qt::LeftButton, modifiers, path.front());
    for (const QPoint& at : path) {
      QMouseEvent move(QEvent::MouseMove, at, canvas.mapToGlobal(at), Qt::NoButton, Qt::LeftButton,
                       modifiers);
      QApplication::sendEvent(&canvas, &move);
    }
    QTest::mouseRelease(&canvas, Qt::LeftButton, modifiers, path.back());
  };
  drag({open.at(5, 5), open.at(17, 20), open.at(17, 40)}, {});
  QCOMPARE(selection.nodes(), (std::set<Id>{pillar.nodes[0].id, pillar.nodes[1].id}));
  QVERIFY(selection.pillars().empty());
  drag({open.at(5, 5), open.at(25, 55)}, {});
  QCOMPARE(selection.pillars(), std::set<Id>{picked.on_section});
  QVERIFY(selection.nodes().empty());
  // A lasso around the first and last node that leaves the middle one out.
  drag({open.at(6, 6), open.at(14, 6), open.at(12, 30), open.at(24, 46), open.at(24, 54), open.at(8, 54)},
       Qt::ShiftModifier);
  QCOMPARE(selection.nodes(), (std::set<Id>{pillar.nodes[0].id, pillar.nodes[2].id}));
  // A lasso around a whole pillar, and it belongs to another fault in one step.
  const std::vector<QPoint> ring{open.at(5, 5), open.at(25, 5), open.at(25, 55), open.at(5, 55),
                                 open.at(4, 6)};
  drag(ring, Qt::ShiftModifier);
  QCOMPARE(selection.pillars(), std::set<Id>{picked.on_section});
  const std::size_t steps = open.bench.document.history().size();
  QVERIFY(assign_pillars(open.bench.document, selection.pillars(), picked.other_fault));
  QCOMPARE(open.bench.document.fault_of_pillar(picked.on_section)->record.id, picked.other_fault);
  QCOMPARE(open.bench.document.history().size(), steps + 1);
  // Esc while it is drawn leaves all as it was.
  QTest::mousePress(&canvas, Qt::LeftButton, {}, open.at(5, 5));
  QTest::mouseMove(&canvas, open.at(25, 55));
  open.key(Qt::Key_Escape);
  QTest::mouseRelease(&canvas, Qt::LeftButton, {}, open.at(33, 55));
  QCOMPARE(selection.pillars(), std::set<Id>{picked.on_section});
  // Less than 4 px is a click.
  drag({open.at(33, 55), open.at(33, 55) + QPoint(2, 2)}, {});
  QVERIFY(selection.nodes().empty());
}

void SectionViewTest::a_lasso_catches_what_is_seen_of_pillars() {
  const SampleProject sample;
  OpenView open(sample);
  const Picked picked(open.bench);
  Document& document = open.bench.document;
  const survey::Geometry survey = *document.survey();
  // Unassigned: one goes off the section to line 44, far beyond the fade distance, one is near on line 24.
  Id off = 0, near = 0;
  document.edit(QStringLiteral("Pick"), [&](project::Interpretation& now) {
    const Id unassigned = now.add_fault(kUnassigned);
    const std::array far_nodes{survey.world_of({20, 34, 10}), survey.world_of({20, 34, 30}),
                               survey.world_of({44, 5, 50})};
    off = now.add_pillar(unassigned, survey::PillarKind::kInterpreted, far_nodes).id;
    const std::array near_nodes{survey.world_of({24, 36, 12}), survey.world_of({24, 36, 28})};
    near = now.add_pillar(unassigned, survey::PillarKind::kInterpreted, near_nodes).id;
  });
  open.bench.display.set_fade_distance(15);
  QSignalSpy caught(&open.bench.selection, &Selection::unassigned_caught);
  const auto lasso = [&](double left, double top, double right, double bottom, Qt::KeyboardModifiers more) {
    const std::vector<QPoint> path{open.at(left, top), open.at(right, top), open.at(right, bottom),
                                   open.at(left, bottom), open.at(left, top + 1)};
    const Qt::KeyboardModifiers held = Qt::ShiftModifier | more;
    QTest::mousePress(&open.canvas(), Qt::LeftButton, held, path.front());
    for (const QPoint& at : path) {
      QMouseEvent move(QEvent::MouseMove, at, open.canvas().mapToGlobal(at), Qt::NoButton, Qt::LeftButton,
                       held);
      QApplication::sendEvent(&open.canvas(), &move);
    }
    QTest::mouseRelease(&open.canvas(), Qt::LeftButton, held, path.back());
  };
  const Selection& selection = open.bench.selection;
  lasso(32, 5, 38, 34, {});
  QCOMPARE(selection.pillars(), (std::set<Id>{off, near}));
  QVERIFY(selection.nodes().empty());
  QCOMPARE(caught.size(), 1);
  QCOMPARE(caught[0][0].value<std::set<Id>>(), (std::set<Id>{off, near}));
  // Adding to the selection asks nothing, nor does what belongs to a fault.
  lasso(32, 5, 38, 34, Qt::ControlModifier);
  lasso(5, 5, 25, 55, {});
  QCOMPARE(selection.pillars(), std::set<Id>{picked.on_section});
  QCOMPARE(caught.size(), 1);
  // What is not drawn is not caught.
  open.bench.display.set_fade_distance(0);
  lasso(32, 5, 38, 34, {});
  QCOMPARE(selection.pillars(), std::set<Id>{off});
  // A node on the section that stays outside leaves its pillar out.
  lasso(32, 5, 38, 20, {});
  QVERIFY(selection.pillars().empty());
  QCOMPARE(selection.nodes(), std::set<Id>{document.pillar(off)->nodes[0].id});
}

void SectionViewTest::a_box_around_the_cut_of_an_imported_surface_selects_it() {
  const SampleProject sample;
  {
    // A square that stands across inline 20, from crossline 10 to 25 and sample 15 to 45.
    project::Project project = sample.open();
    const survey::Geometry survey = *project.survey();
    const std::filesystem::path file = sample.path().parent_path() / "square.ts";
    std::ofstream out(file);
    out << "GOCAD TSurf 1\nHEADER {\nname:square\n}\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME Default\n"
           "AXIS_NAME \"X\" \"Y\" \"Z\"\nAXIS_UNIT \"m\" \"m\" \"ms\"\nZPOSITIVE Depth\n"
           "END_ORIGINAL_COORDINATE_SYSTEM\nTFACE\n"
        << std::fixed;
    int n = 0;
    for (const survey::IndexPoint& corner :
         {survey::IndexPoint{10, 10, 15}, {30, 10, 15}, {30, 25, 45}, {10, 25, 45}}) {
      const survey::WorldPoint p = survey.world_of(corner);
      out << "VRTX " << ++n << ' ' << p.x << ' ' << p.y << ' ' << p.z << '\n';
    }
    out << "TRGL 1 2 3\nTRGL 1 3 4\nEND\n";
    out.close();
    tasks::import_surface(project, file, {}, {});
  }
  OpenView open(sample);
  QVERIFY(open.arrived);
  const Id square = open.bench.document.faults().back().record.id;
  QVERIFY(open.bench.document.fault(square)->pillars.empty());
  QTRY_VERIFY_WITH_TIMEOUT(open.bench.surfaces.is_settled(), 60'000);
  for (const Fault& fault : open.bench.document.faults()) {
    const Id id = fault.record.id;
    open.bench.display.set_visible({.kind = Item::Kind::kFault, .id = id}, id == square);
  }
  const auto box = [&](const QPoint& from, const QPoint& to) {
    QTest::mousePress(&open.canvas(), Qt::LeftButton, {}, from);
    for (const QPoint& at : {(from + to) / 2, to}) {
      QMouseEvent move(QEvent::MouseMove, at, open.canvas().mapToGlobal(at), Qt::NoButton, Qt::LeftButton,
                       {});
      QApplication::sendEvent(&open.canvas(), &move);
    }
    QTest::mouseRelease(&open.canvas(), Qt::LeftButton, {}, to);
  };
  box(open.at(6, 8), open.at(29, 52));
  QCOMPARE(open.bench.selection.faults(), std::set<Id>{square});
  box(open.at(6, 8), open.at(29, 30));  // a part of it
  QVERIFY(open.bench.selection.faults().empty());
}

void SectionViewTest::a_selected_face_has_a_thicker_cut() {
  const SampleProject sample;
  OpenView open(sample);
  QPoint at;
  const auto finds_a_cut = [&] {
    const QRect area = open.canvas().view().area().toRect().adjusted(30, 30, -30, -30);
    for (int y = area.top(); y < area.bottom(); y += 3) {
      for (int x = area.left(); x < area.right(); x += 3) {
        if (open.canvas().hit(QPointF(x, y)).item.kind != Item::Kind::kFace) continue;
        at = {x, y};
        return true;
      }
    }
    return false;
  };
  QTRY_VERIFY(finds_a_cut());
  const Item face = open.canvas().hit(at).item;
  const QColor accent = open.canvas().palette().color(QPalette::Highlight);
  const QRect near(at - QPoint(9, 9), QSize(19, 19));
  const auto shown = [&] { return accented(open.canvas().grab().toImage(), accent, near); };
  open.bench.selection.select({.kind = Item::Kind::kFault, .id = face.id});
  QCOMPARE(shown(), 0);
  QTest::mouseClick(&open.canvas(), Qt::LeftButton, {}, at);
  QVERIFY(open.bench.selection.current() == face);
  open.bench.selection.hover({});
  const int selected = shown();
  QVERIFY2(selected > 8, qPrintable(QString::number(selected)));
  open.bench.selection.hover(face);
  QVERIFY(shown() > 0);  // seen beside what is hovered
  open.bench.selection.clear();
  open.bench.selection.hover({});
  QCOMPARE(shown(), 0);
}

void SectionViewTest::a_hovered_fault_without_a_cut_shows_by_its_pillars() {
  const SampleProject sample;
  OpenView open(sample);
  const Picked picked(open.bench);
  open.bench.selection.set_active_fault(0);
  const QPoint middle = open.at(17.5, 40);
  const QRect near(middle - QPoint(6, 6), QSize(13, 13));
  const int before = coloured(open.canvas().grab().toImage(), near);
  open.bench.selection.hover({.kind = Item::Kind::kFault, .id = picked.fault});
  QVERIFY(coloured(open.canvas().grab().toImage(), near) > before);
  open.bench.selection.hover({});
  QCOMPARE(coloured(open.canvas().grab().toImage(), near), before);
}

void SectionViewTest::keys_are_let_go_with_the_focus() {
  const SampleProject sample;
  OpenView open(sample);
  open.bench.picking.set_tool(Tool::kPick);
  QTest::mouseMove(&open.canvas(), open.at(20, 20));
  QTRY_VERIFY(!open.bench.picking.hint().isEmpty());
  const QString hint = open.bench.picking.hint();
  for (const Qt::Key key : {Qt::Key_Space, Qt::Key_QuoteLeft}) {
    QTest::keyPress(&open.canvas(), key);
    QVERIFY(open.bench.picking.hint() != hint);
    QFocusEvent out(QEvent::FocusOut, Qt::ActiveWindowFocusReason);
    QCoreApplication::sendEvent(&open.canvas(), &out);
    QCOMPARE(open.bench.picking.hint(), hint);
  }
}

void SectionViewTest::frames_the_selection() {
  const SampleProject sample;
  OpenView open(sample);
  const Picked picked(open.bench);
  open.bench.selection.select({.kind = Item::Kind::kPillar, .id = picked.on_section});
  for (int n = 0; n < 20; ++n) open.wheel({60, 40});
  open.key(Qt::Key_F);
  const QRectF& area = open.canvas().view().area();
  QVERIFY(area.contains(open.at(10, 10)) && area.contains(open.at(20, 50)));
  QVERIFY(std::abs(open.at(10, 10).y() - open.at(20, 50).y()) > 0.4 * area.height() ||
          std::abs(open.at(10, 10).x() - open.at(20, 50).x()) > 0.4 * area.width());
}

void SectionViewTest::an_empty_view_says_what_to_do() {
  QTemporaryDir folder;
  const std::filesystem::path path = std::filesystem::path(folder.path().toStdString()) / "empty.footwall";
  tasks::new_empty_project(path);
  Workbench bench(project::Project::open(path, project::OpenMode::kWrite), {});
  SectionView view(bench, bench.display.add_section({}));
  view.resize(500, 400);
  view.show();
  QVERIFY(QTest::qWaitForWindowExposed(&view));
  QVERIFY(!view.canvas().message().isEmpty());
  QSignalSpy wanted(&view, &SectionView::import_wanted);
  auto* button = view.findChild<QPushButton*>();
  QVERIFY(button->isVisible());
  QTest::mouseClick(button, Qt::LeftButton);
  QCOMPARE(wanted.size(), 1);
  // Nothing breaks without a survey.
  for (const auto key : {Qt::Key_X, Qt::Key_Home, Qt::Key_F, Qt::Key_1, Qt::Key_Return})
    QTest::keyClick(&view.canvas(), key);
  QTest::mouseMove(&view.canvas(), {100, 100});
  bench.display.remove_section(view.shown());
  QVERIFY(!view.grab().isNull());
}

void SectionViewTest::a_missing_volume_is_told() {
  const SampleProject sample;
  std::filesystem::path file;
  {
    const Document document(sample.open());
    file = document.project().volume_path(document.volumes().front());
  }
  std::filesystem::rename(file, file.string() + ".away");
  OpenView open(sample);
  QVERIFY(!open.arrived);
  QVERIFY(open.canvas().message().contains(QString::fromStdString(file.filename().string())));
  std::filesystem::rename(file.string() + ".away", file);
  QTest::mouseClick(open.view.findChild<QPushButton*>(), Qt::LeftButton);
  QTRY_VERIFY(open.canvas().message().isEmpty() && open.has_its_samples());
}

void SectionViewTest::bears_one_sample() {
  QTemporaryDir folder;
  const std::filesystem::path path = std::filesystem::path(folder.path().toStdString()) / "one.footwall";
  tasks::VolumeSource source;
  source.fill = [](const survey::Box&, std::span<float> values, std::span<std::uint8_t>) { values[0] = 3; };
  tasks::new_project(path, "one", source, {});
  Workbench bench(project::Project::open(path, project::OpenMode::kWrite), {});
  const Id shown = bench.display.add_section({});
  SectionView view(bench, shown);
  view.resize(400, 300);
  view.show();
  QVERIFY(QTest::qWaitForWindowExposed(&view));
  const auto has_its_samples = [&] {
    return view.canvas().samples() && view.canvas().samples()->section == view.canvas().section();
  };
  for (const auto kind :
       {Section::Kind::kInline, Section::Kind::kCrossline, Section::Kind::kSlice, Section::Kind::kLine}) {
    bench.display.move_section(shown, {.kind = kind});
    QTRY_VERIFY(has_its_samples());
    QCOMPARE(view.canvas().samples()->values, std::vector<float>{3});
    for (const auto key : {Qt::Key_X, Qt::Key_Z, Qt::Key_Plus, Qt::Key_Home})
      QTest::keyClick(&view.canvas(), key);
    QVERIFY(!view.canvas().grab().isNull());
  }
  view.resize(170, 150);
  QVERIFY(!view.canvas().grab().isNull());
}

void SectionViewTest::hides_what_the_tree_hides() {
  const SampleProject sample;
  OpenView open(sample);
  const Picked picked(open.bench);
  const QRect at(open.at(15, 30) - QPoint(3, 3), QSize(7, 7));
  QVERIFY(coloured(open.canvas().grab().toImage(), at) > 10);
  open.bench.display.set_visible({.kind = Item::Kind::kFault, .id = picked.fault}, false);
  QCOMPARE(coloured(open.canvas().grab().toImage(), at), 0);
  QVERIFY(!open.canvas().hit(open.canvas().view().to_pixels({15, 30})).item);
}

static const RegisterTest<SectionViewTest> kRegistered;

}  // namespace footwall::ui

#include "section_view_test.moc"
