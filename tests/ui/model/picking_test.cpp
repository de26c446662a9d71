#include "ui/model/picking.h"

#include <QSignalSpy>
#include <QTest>
#include <memory>

#include "ui/model/fault_commands.h"
#include "ui/sample_project.h"
#include "ui/test_class.h"

namespace footwall::ui {

using namespace std::chrono_literals;

// One window's models over a sample project without faults, and a mouse over its inline 10.
struct Desk {
  explicit Desk(bool with_faults = false) : document(sample.open()) {
    if (!with_faults) {
      document.edit("empty", [](project::Interpretation& now) {
        for (const auto& fault : now.faults()) now.delete_fault(fault.id);
      });
    }
    picking.set_tool(Tool::kPick);
  }
  Pointer at(double crossline, double sample_index, const Item& under = {},
             Qt::KeyboardModifiers modifiers = {}) {
    Pointer p;
    p.section.index = 10;
    p.place = {10, crossline, sample_index};
    p.x = crossline * 10;
    p.y = sample_index * 10;
    p.on_section = true;
    p.under = under;
    p.modifiers = modifiers;
    p.button = Qt::LeftButton;
    p.time = clock += 10ms;
    return p;
  }
  void click(double crossline, double sample_index, const Item& under = {},
             Qt::KeyboardModifiers modifiers = {}) {
    const Pointer p = at(crossline, sample_index, under, modifiers);
    picking.move(p);
    QVERIFY(picking.press(p));
    QVERIFY(picking.release(p));
  }
  Item node(int pillar, int number) {
    return {.kind = Item::Kind::kNode,
            .id = document.faults()[0]
                      .pillars[static_cast<std::size_t>(pillar)]
                      .nodes[static_cast<std::size_t>(number)]
                      .id};
  }
  survey::IndexPoint place(int pillar, int number) {
    return document.survey()->index_of(document.faults()[0]
                                           .pillars[static_cast<std::size_t>(pillar)]
                                           .nodes[static_cast<std::size_t>(number)]
                                           .position);
  }
  std::size_t steps() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(document.history(), [](const auto& step) { return !step.undone; }));
  }

  SampleProject sample;
  Document document;
  Selection selection{document};
  Display display{document};
  Picking picking{document, selection, display};
  std::chrono::milliseconds clock{0};
};

class PickingTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void clicks_make_a_pillar_and_a_double_click_ends_it();
  void a_click_inserts_where_the_line_gets_least_longer();
  void shift_starts_another_pillar();
  void control_deletes_a_node();
  void a_drag_moves_a_node_as_one_edit();
  void escape_puts_everything_back();
  void a_drag_on_empty_ground_draws_a_pillar();
  void backquote_copies_a_pillar();
  void another_section_starts_another_pillar();
  void a_locked_fault_and_a_reader_change_nothing();
  void a_click_beside_another_fault_stays_with_the_active_one();
  void undo_while_the_button_is_down_is_survived();
  void the_hint_says_what_the_click_does();
  void the_hint_is_true_beside_sections();
  void the_hint_follows_keys();
  void snaps_to_samples_where_that_is_wanted();
};

void PickingTest::clicks_make_a_pillar_and_a_double_click_ends_it() {
  Desk desk;
  QSignalSpy ended(&desk.picking, &Picking::pillar_ended);
  desk.click(5, 3);
  desk.click(6, 20);
  desk.click(7, 40);
  const Pointer last = desk.at(7, 40);
  QVERIFY(desk.picking.double_click(last));
  QCOMPARE(ended.size(), 1);
  QCOMPARE(desk.document.faults().size(), std::size_t{1});
  QCOMPARE(desk.document.faults()[0].record.name, std::string("unassigned"));
  QCOMPARE(desk.document.faults()[0].pillars.size(), std::size_t{1});
  QCOMPARE(desk.document.faults()[0].pillars[0].nodes.size(), std::size_t{3});
  QCOMPARE(desk.place(0, 1).k, 20.0);
  QCOMPARE(desk.picking.active_pillar(), Id{0});
  QCOMPARE(desk.steps(), std::size_t{desk.document.history().size()});
  // The same spot twice leaves one node.
  desk.click(20, 5);
  desk.click(20, 5);
  QCOMPARE(desk.document.faults()[0].pillars[1].nodes.size(), std::size_t{1});
}

void PickingTest::a_click_inserts_where_the_line_gets_least_longer() {
  Desk desk;
  desk.click(5, 10);
  desk.click(5, 30);
  desk.click(6, 20);  // between
  desk.click(5, 2);   // before the first
  QCOMPARE(desk.place(0, 0).k, 2.0);
  QCOMPARE(desk.place(0, 1).k, 10.0);
  QCOMPARE(desk.place(0, 2).k, 20.0);
  QCOMPARE(desk.place(0, 3).k, 30.0);
  // On the line itself the segment decides.
  Pointer p = desk.at(5, 25, {.kind = Item::Kind::kPillar, .id = desk.document.faults()[0].pillars[0].id});
  p.segment = 2;
  desk.picking.move(p);
  QVERIFY(desk.picking.press(p));
  QVERIFY(desk.picking.release(p));
  QCOMPARE(desk.place(0, 3).k, 25.0);
}

void PickingTest::shift_starts_another_pillar() {
  Desk desk;
  desk.click(5, 10);
  desk.click(8, 10, {}, Qt::ShiftModifier);
  QCOMPARE(desk.document.faults()[0].pillars.size(), std::size_t{2});
}

void PickingTest::control_deletes_a_node() {
  Desk desk;
  desk.click(5, 10);
  desk.click(5, 30);
  desk.click(5, 30, desk.node(0, 1), Qt::ControlModifier);
  QCOMPARE(desk.document.faults()[0].pillars[0].nodes.size(), std::size_t{1});
  desk.click(5, 10, desk.node(0, 0), Qt::ControlModifier);  // the last one takes the pillar with it
  QVERIFY(desk.document.faults()[0].pillars.empty());
}

void PickingTest::a_drag_moves_a_node_as_one_edit() {
  Desk desk;
  desk.click(5, 10);
  desk.click(5, 30);
  const std::size_t before = desk.steps();
  QVERIFY(desk.picking.press(desk.at(5, 10, desk.node(0, 0))));
  for (int n = 1; n <= 20; ++n) QVERIFY(desk.picking.move(desk.at(5 + 0.1 * n, 10 + 0.2 * n)));
  QVERIFY(desk.picking.is_dragging());
  QCOMPARE(desk.steps(), before);
  const Id fault = desk.document.faults()[0].record.id;
  QVERIFY(desk.document.is_provisional(fault));
  QCOMPARE(desk.document.survey()->index_of(desk.document.shown_pillars(fault)[0].nodes[0].position).k, 14.0);
  QVERIFY(desk.picking.release(desk.at(7, 14)));
  QCOMPARE(desk.steps(), before + 1);
  QVERIFY(!desk.document.is_provisional(fault));
  QCOMPARE(desk.place(0, 0).k, 14.0);
  QCOMPARE(desk.place(0, 0).j, 7.0);
}

void PickingTest::escape_puts_everything_back() {
  Desk desk;
  desk.click(5, 10);
  desk.click(5, 30);
  const std::size_t before = desk.steps();
  desk.picking.press(desk.at(5, 10, desk.node(0, 0)));
  desk.picking.move(desk.at(9, 20));
  QVERIFY(desk.picking.key_press(Qt::Key_Escape, {}));
  QVERIFY(!desk.document.is_provisional(desk.document.faults()[0].record.id));
  desk.picking.release(desk.at(9, 20));
  QCOMPARE(desk.steps(), before);
  QCOMPARE(desk.place(0, 0).k, 10.0);
  QCOMPARE(desk.picking.tool(), Tool::kPick);
  desk.picking.key_press(Qt::Key_Escape, {});
  QCOMPARE(desk.picking.tool(), Tool::kSelect);
}

void PickingTest::a_drag_on_empty_ground_draws_a_pillar() {
  Desk desk;
  const std::size_t before = desk.steps();
  QVERIFY(desk.picking.press(desk.at(5, 5)));
  desk.clock += 300ms;
  for (int n = 1; n <= 50; ++n) desk.picking.move(desk.at(5 + 0.1 * n, 5 + n));
  QVERIFY(!desk.picking.stroke().empty());
  QVERIFY(desk.picking.release(desk.at(10, 55)));
  QCOMPARE(desk.steps(), before + 1);
  QCOMPARE(desk.document.faults()[0].pillars[0].nodes.size(),
           std::size_t{2});  // a straight line needs no more
  QVERIFY(desk.picking.stroke().empty());
  // Shorter than 200 ms it is a click that slipped, and does nothing.
  QVERIFY(desk.picking.press(desk.at(30, 5)));
  desk.picking.move(desk.at(32, 8));
  QVERIFY(desk.picking.release(desk.at(32, 8)));
  QCOMPARE(desk.steps(), before + 1);
}

void PickingTest::backquote_copies_a_pillar() {
  Desk desk;
  desk.click(5, 10);
  desk.click(5, 30);
  desk.picking.key_press(Qt::Key_QuoteLeft, {});
  QVERIFY(desk.picking.press(desk.at(5, 10, desk.node(0, 0))));
  desk.picking.move(desk.at(9, 12));
  QVERIFY(desk.picking.release(desk.at(9, 12)));
  desk.picking.key_release(Qt::Key_QuoteLeft);
  QCOMPARE(desk.document.faults()[0].pillars.size(), std::size_t{2});
  QCOMPARE(desk.place(0, 0).j, 5.0);
  QCOMPARE(desk.place(1, 1).j, 9.0);
  QCOMPARE(desk.place(1, 1).k, 32.0);
}

void PickingTest::another_section_starts_another_pillar() {
  Desk desk;
  desk.click(5, 10);
  Pointer p = desk.at(5, 20);
  p.section.index = 20;
  p.place.i = 20;
  desk.picking.press(p);
  desk.picking.release(p);
  QCOMPARE(desk.document.faults()[0].pillars.size(), std::size_t{2});
  QCOMPARE(desk.place(1, 0).i, 20.0);
}

void PickingTest::a_locked_fault_and_a_reader_change_nothing() {
  Desk desk(true);
  const Id fault = desk.document.faults()[0].record.id;
  desk.selection.set_active_fault(fault);
  desk.document.edit("lock",
                     [&](project::Interpretation& now) { now.set_fault_property(fault, "locked", "true"); });
  const std::size_t before = desk.steps();
  const Pointer p = desk.at(5, 10);
  desk.picking.move(p);
  QVERIFY(desk.picking.hint().contains("locked"));
  QVERIFY(desk.picking.press(p));
  desk.picking.release(p);
  QCOMPARE(desk.steps(), before);

  const SampleProject other;
  Document reader(other.open(project::OpenMode::kRead));
  Selection selection(reader);
  Display display(reader);
  Picking picking(reader, selection, display);
  picking.set_tool(Tool::kPick);
  picking.move(p);
  QVERIFY(!picking.press(p));
  QVERIFY(picking.hint().contains("read-only"));
}

void PickingTest::a_click_beside_another_fault_stays_with_the_active_one() {
  Desk desk(true);
  const Id other = desk.document.faults()[0].record.id;
  const Item node = desk.node(0, 0);
  const std::size_t others_nodes = desk.document.faults()[0].pillars[0].nodes.size();
  const Id mine = new_fault(desk.document);
  desk.selection.set_active_fault(mine);
  desk.click(5, 10);
  desk.click(7, 30, node);
  QVERIFY(desk.picking.double_click(desk.at(7, 30, node)));
  QCOMPARE(desk.selection.active_fault(), mine);
  QCOMPARE(desk.document.fault(mine)->pillars.size(), std::size_t{1});
  QCOMPARE(desk.document.fault(mine)->pillars[0].nodes.size(), std::size_t{2});
  QCOMPARE(desk.document.fault(other)->pillars[0].nodes.size(), others_nodes);
  // A lock on the other one does not stop the pick, and a drag does not move what is locked.
  lock_faults(desk.document, {other}, true);
  desk.click(9, 20, node);
  QCOMPARE(desk.document.fault(mine)->pillars.size(), std::size_t{2});
  const std::size_t before = desk.steps();
  QVERIFY(desk.picking.press(desk.at(9, 25, node)));
  desk.picking.move(desk.at(12, 40));
  desk.picking.release(desk.at(12, 40));
  QCOMPARE(desk.steps(), before);
  // Without an active fault a click takes the other one up.
  desk.selection.clear();
  desk.selection.set_active_fault(0);
  lock_faults(desk.document, {other}, false);
  desk.click(5, 10, node);
  QCOMPARE(desk.selection.active_fault(), other);
}

void PickingTest::undo_while_the_button_is_down_is_survived() {
  Desk desk;
  desk.click(5, 10);
  desk.click(5, 30);
  const Item second = desk.node(0, 1);
  desk.picking.press(desk.at(5, 30, second));
  desk.picking.move(desk.at(6, 33));
  desk.document.undo();  // the node is gone
  desk.picking.move(desk.at(7, 35));
  desk.picking.release(desk.at(7, 35));
  QCOMPARE(desk.document.faults()[0].pillars[0].nodes.size(), std::size_t{1});
  desk.picking.press(desk.at(5, 10, second));
  desk.picking.release(desk.at(5, 10, second));
  QCOMPARE(desk.document.faults()[0].pillars[0].nodes.size(), std::size_t{1});
}

void PickingTest::the_hint_says_what_the_click_does() {
  Desk desk(true);
  desk.selection.set_active_fault(desk.document.faults()[0].record.id);
  const QString fault = QString::fromStdString(desk.document.faults()[0].record.name);
  desk.picking.move(desk.at(1, 1));
  QCOMPARE(desk.picking.hint(), QStringLiteral("click starts a pillar of %1; drag draws one").arg(fault));
  QCOMPARE(desk.picking.shape(), PointerShape::kCross);
  desk.click(1, 1);
  desk.picking.move(desk.at(1, 2));
  QVERIFY(desk.picking.hint().startsWith("click adds a node to pillar"));
  QVERIFY(desk.picking.hint().endsWith("double-click ends it"));
  desk.picking.move(desk.at(1, 1, desk.node(0, 0)));
  QCOMPARE(desk.picking.shape(), PointerShape::kMoveNode);
  desk.picking.leave();
  QCOMPARE(desk.picking.hint(), QString());
}

void PickingTest::the_hint_is_true_beside_sections() {
  Desk desk(true);
  const Id fault = desk.document.faults()[0].record.id;
  const QString name = QString::fromStdString(desk.document.faults()[0].record.name);
  const Item face{.kind = Item::Kind::kFace, .id = fault};
  const auto said = [&](const Pointer& p) {
    desk.picking.move(p);
    return desk.picking.hint();
  };
  const auto beside = [&](const Item& under) {
    Pointer p = desk.at(1, 1, under);
    p.on_section = false;
    return p;
  };
  const Item surface{.kind = Item::Kind::kIsosurface, .id = 1};
  QCOMPARE(said(beside(surface)),
           QStringLiteral("click selects this isosurface; point at a section to pick"));
  QCOMPARE(said(beside(face)), QStringLiteral("click selects %1; point at a section to pick").arg(name));
  QCOMPARE(said(beside({})), QStringLiteral("point at a section to pick"));
  desk.picking.set_tool(Tool::kMove);
  QCOMPARE(said(beside(face)), QStringLiteral("click selects %1; point at a section to move").arg(name));
  // On a section a drag moves the whole fault, once it is selected.
  QCOMPARE(said(desk.at(1, 1, face)), QStringLiteral("click selects %1, which a drag then moves").arg(name));
  desk.picking.press(desk.at(1, 1, face));
  desk.picking.release(desk.at(1, 1, face));
  QCOMPARE(desk.picking.hint(), QStringLiteral("drag moves %1").arg(name));
  const std::size_t before = desk.steps();
  desk.picking.press(desk.at(1, 1, face));
  desk.picking.move(desk.at(4, 6, face));
  QVERIFY(desk.picking.release(desk.at(4, 6, face)));
  QCOMPARE(desk.steps(), before + 1);
  desk.picking.set_tool(Tool::kSelect);
  QCOMPARE(said(beside(surface)), QStringLiteral("click selects this isosurface"));
  for (const Tool tool : {Tool::kSelect, Tool::kPick, Tool::kMove}) {
    desk.picking.set_tool(tool);
    Pointer frame = beside({});
    frame.on_frame = true;
    QCOMPARE(said(frame), QStringLiteral("drag moves this plane; Esc puts it back"));
    QCOMPARE(desk.picking.shape(), PointerShape::kMoveNode);
  }
}

void PickingTest::the_hint_follows_keys() {
  Desk desk;
  desk.click(5, 10);
  desk.click(5, 30);
  desk.picking.move(desk.at(5, 10, desk.node(0, 0)));
  desk.picking.key_press(Qt::Key_Control, Qt::ControlModifier);
  QCOMPARE(desk.picking.shape(), PointerShape::kDeleteNode);
  QVERIFY(!desk.picking.key_release(Qt::Key_Control));
  QCOMPARE(desk.picking.shape(), PointerShape::kMoveNode);
  desk.picking.key_press(Qt::Key_Space, {});
  QCOMPARE(desk.picking.shape(), PointerShape::kHand);
  QVERIFY(!desk.picking.press(desk.at(5, 10, desk.node(0, 0))));
  desk.picking.let_keys_go();
  QCOMPARE(desk.picking.shape(), PointerShape::kMoveNode);
  desk.picking.key_press(Qt::Key_QuoteLeft, {});
  QCOMPARE(desk.picking.hint(), QStringLiteral("drag a pillar to copy it"));
  desk.picking.let_keys_go();
  QVERIFY(desk.picking.press(desk.at(5, 10, desk.node(0, 0))));
  desk.picking.move(desk.at(9, 12));
  QVERIFY(desk.picking.release(desk.at(9, 12)));
  QCOMPARE(desk.document.faults()[0].pillars.size(), std::size_t{1});  // moved, not copied
}

void PickingTest::snaps_to_samples_where_that_is_wanted() {
  Desk desk;
  desk.click(5.3, 3.6);
  QVERIFY(std::abs(desk.place(0, 0).j - 5.3) < 1e-6 && std::abs(desk.place(0, 0).k - 3.6) < 1e-6);
  desk.display.set_snapping(true, true);
  desk.click(6.4, 20.7);
  QVERIFY(std::abs(desk.place(0, 1).j - 6) < 1e-6 && std::abs(desk.place(0, 1).k - 21) < 1e-6);
  // Both are kept with the project.
  Display other(desk.document);
  other.from_json(desk.display.to_json());
  QVERIFY(other.snaps_to_section() && other.snaps_to_samples());
}

static const RegisterTest<PickingTest> kRegistered;

}  // namespace footwall::ui

#include "picking_test.moc"
