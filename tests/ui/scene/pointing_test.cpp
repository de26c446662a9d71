#include <QKeyEvent>
#include <QMouseEvent>
#include <QSignalSpy>
#include <QTest>
#include <QWheelEvent>

#include "ui/model/fault_commands.h"
#include "ui/scene/made_scene.h"
#include "ui/test_class.h"

namespace footwall::ui {
namespace {

using render::Vec3;

void turn_wheel(QWidget* view, const QPointF& at, int notches) {
  QWheelEvent event(at, view->mapToGlobal(at), {}, QPoint(0, 120 * notches), Qt::NoButton, Qt::NoModifier,
                    Qt::NoScrollPhase, false);
  QCoreApplication::sendEvent(view, &event);
}

// With the button down all the way; modifiers are held throughout.
void drag(QWidget* view, Qt::MouseButton button, const std::vector<QPoint>& path,
          Qt::KeyboardModifiers modifiers = {}) {
  QTest::mousePress(view, button, modifiers, path.front());
  for (const QPoint& at : path) {
    QMouseEvent move(QEvent::MouseMove, at, view->mapToGlobal(at), Qt::NoButton, button, modifiers);
    QApplication::sendEvent(view, &move);
  }
  QTest::mouseRelease(view, button, modifiers, path.back());
}

// The pixels of a pillar's nodes, and some around.
QRect around(const MadeScene& scene, const survey::Pillar& pillar) {
  QPolygonF pixels;
  for (const survey::PillarNode& node : pillar.nodes)
    pixels << *scene.view->pixel_of(scene.bench.document.survey()->index_of(node.position));
  return pixels.boundingRect().toAlignedRect().adjusted(-4, -4, 4, 4);
}

// A fault of three pillars through a plane at inline 24, alone in the scene; the middle one lies on the
// plane.
struct Crossing {
  explicit Crossing(MadeScene& crossed, bool has_faces = true) : scene(crossed) {
    Document& document = scene.bench.document;
    const survey::Geometry survey = *document.survey();
    scene.bench.display.move_section(scene.inline_plane, {.kind = Section::Kind::kInline, .index = 24});
    document.edit("Crossing", [&](project::Interpretation& now) {
      fault = now.add_fault("crossing");
      for (const double i : {14.0, 24.0, 34.0}) {
        const std::array nodes{survey.world_of({i, 20, 10}), survey.world_of({i, 20, 30}),
                               survey.world_of({i, 20, 50})};
        const survey::Pillar made = now.add_pillar(fault, survey::PillarKind::kInterpreted, nodes);
        if (i == 24) node = made.nodes[1].id;
      }
    });
    for (const Fault& other : document.faults()) {
      const Id id = other.record.id;
      scene.bench.display.set_visible({.kind = Item::Kind::kFault, .id = id}, id == fault);
    }
    scene.bench.selection.set_active_fault(fault);
    if (!has_faces) return;
    scene.remake(fault);
    Q_EMIT scene.bench.surfaces.surfaces_changed({fault});
  }
  survey::IndexPoint place() const {
    const Document& document = scene.bench.document;
    for (const survey::Pillar& pillar : document.fault(fault)->pillars) {
      for (const survey::PillarNode& one : pillar.nodes) {
        if (one.id == node) return document.survey()->index_of(one.position);
      }
    }
    return {};
  }
  // A place of the plane that is hidden by what `hides` says, without a node or pillar near.
  template <class Hides>
  std::optional<survey::IndexPoint> hidden_place(const Hides& hides) const {
    for (double j = 4; j < 38; ++j) {
      for (double k = 4; k < 60; ++k) {
        const auto at = scene.view->pixel_of({24, j, k});
        if (at && scene.view->rect().adjusted(20, 20, -20, -20).contains(at->toPoint()) &&
            hides(scene.view->under(at->toPoint())))
          return survey::IndexPoint{24, j, k};
      }
    }
    return {};
  }

  MadeScene& scene;
  Id fault = 0, node = 0;
};

int differing(const QImage& a, const QImage& b) {
  int count = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) count += a.pixel(x, y) != b.pixel(x, y) ? 1 : 0;
  }
  return count;
}

// How many of a triangle's edges have, at their middles, the colour of what is selected.
int accented_edges(const QImage& image, const std::array<QPointF, 3>& middles) {
  const QColor accent = MadeScene::dark().color(QPalette::Highlight);
  const auto is_near = [&](const QColor& colour) {
    return std::abs(colour.red() - accent.red()) + std::abs(colour.green() - accent.green()) +
               std::abs(colour.blue() - accent.blue()) <
           30;
  };
  return static_cast<int>(std::ranges::count_if(middles, [&](const QPointF& at) {
    for (int n = 0; n < 9; ++n) {
      if (is_near(image.pixelColor(at.toPoint() + QPoint(n % 3 - 1, n / 3 - 1)))) return true;
    }
    return false;
  }));
}

}  // namespace

class PointingTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void finds_faces_pillars_and_nodes();
  void click_selects_and_hover_highlights();
  void a_selected_face_is_outlined();
  void a_hovered_fault_without_faces_shows_by_its_pillars();
  void nodes_before_a_face_move_on_their_section();
  void a_drag_stays_on_the_section_that_it_began_on();
  void a_plane_follows_its_frame();
  void escape_puts_a_plane_back();
  void keys_are_let_go_with_the_focus();
  void wheel_zooms_at_the_mouse();
  void small_moves_turn_nothing();
  void keys_work();
  void selects_by_box_and_lasso();
  void a_box_around_a_surface_without_pillars_selects_it();
  void a_lasso_assigns_pillars_in_one_step();
  void presets_say_what_the_mouse_does();
  void cameras_come_back_exactly();
};

void PointingTest::finds_faces_pillars_and_nodes() {
  MadeScene scene;
  QVERIFY(scene.settle());
  const survey::Geometry& survey = *scene.bench.document.survey();
  const Fault& fault = scene.bench.document.faults().front();
  scene.bench.selection.set_active_fault(fault.record.id);
  int nodes = 0, pillars = 0, faces = 0;
  for (const survey::Pillar& pillar : fault.pillars) {
    const auto& a = pillar.nodes[0];
    const auto& b = pillar.nodes[1];
    const auto at = scene.view->pixel_of(survey.index_of(a.position));
    QVERIFY(at.has_value());
    const SceneView::Under node = scene.view->under(*at);
    if (node.item == Item{.kind = Item::Kind::kNode, .id = a.id}) ++nodes;
    const survey::WorldPoint middle{(a.position.x + b.position.x) / 2, (a.position.y + b.position.y) / 2,
                                    (a.position.z + b.position.z) / 2};
    const SceneView::Under line = scene.view->under(*scene.view->pixel_of(survey.index_of(middle)));
    if (line.item.kind == Item::Kind::kPillar && line.item.id == pillar.id) {
      ++pillars;
      QCOMPARE(line.segment, 0);
    }
  }
  QVERIFY(nodes > 0);
  QVERIFY(pillars > 0);
  // Every pixel that hits a face names one that is there, at a place on it.
  for (int y = 20; y < 700; y += 17) {
    for (int x = 20; x < 900; x += 17) {
      const SceneView::Under under = scene.view->under(QPointF(x, y));
      if (under.item.kind != Item::Kind::kFace) continue;
      ++faces;
      QVERIFY(under.hit);
      const auto again = scene.view->pixel_of(under.place);
      QVERIFY(std::hypot(again->x() - x, again->y() - y) < 2);
    }
  }
  QVERIFY(faces > 50);
}

void PointingTest::click_selects_and_hover_highlights() {
  MadeScene scene;
  QVERIFY(scene.settle());
  std::optional<QPoint> on_face;
  for (int y = 20; y < 700 && !on_face; y += 7) {
    for (int x = 20; x < 900 && !on_face; x += 7) {
      if (scene.view->under(QPointF(x, y)).item.kind == Item::Kind::kFace) on_face = QPoint(x, y);
    }
  }
  QVERIFY(on_face.has_value());
  const std::uint64_t layers = scene.view->counters().layers;
  QTest::mouseMove(scene.view.get(), *on_face + QPoint(1, 0));
  QTest::mouseMove(scene.view.get(), *on_face);
  QTRY_COMPARE(scene.bench.selection.hovered().kind, Item::Kind::kFace);
  QVERIFY(scene.bench.display.cursor().has_value());
  QTRY_VERIFY(scene.settle());
  QCOMPARE(scene.view->counters().layers, layers);  // hovering draws over the layer
  scene.grabbed("hovered");
  QTest::mouseClick(scene.view.get(), Qt::LeftButton, {}, *on_face);
  QCOMPARE(scene.bench.selection.current().kind, Item::Kind::kFace);
  QVERIFY(scene.bench.selection.active_fault() != 0);
  QVERIFY(scene.settle());
  scene.grabbed("selected");
  QTest::mouseClick(scene.view.get(), Qt::LeftButton, {}, QPoint(5, 5));
  QVERIFY(!scene.bench.selection.current());
}

void PointingTest::a_selected_face_is_outlined() {
  MadeScene scene({48, 40, 64}, 6, 2);
  const Id fault = scene.first_fault();
  scene.bench.selection.set_active_fault(fault);
  QVERIFY(scene.settle());
  const survey::Geometry& survey = *scene.bench.document.survey();
  const FaultSurface& surface = *scene.surfaces[fault];
  const QImage before = scene.grabbed("face_not_selected");
  // A face that is seen as a whole, in the midst of others.
  Item face;
  std::array<QPointF, 3> middles;
  for (const project::MeshFace& one : surface.faces) {
    const auto middle_of = [&](std::size_t n) {
      const auto& a = surface.vertices[static_cast<std::size_t>(one.vertices[n])];
      const auto& b = surface.vertices[static_cast<std::size_t>(one.vertices[(n + 1) % 3])];
      return *scene.view->pixel_of(survey.index_of({(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2}));
    };
    middles = {middle_of(0), middle_of(1), middle_of(2)};
    const bool is_seen = std::ranges::all_of(middles, [&](const QPointF& at) {
      const Item under = scene.view->under(at).item;
      return under.kind == Item::Kind::kFace && under.id == fault &&
             scene.view->rect().contains(at.toPoint());
    });
    const double size = QLineF(middles[0], middles[1]).length() + QLineF(middles[0], middles[2]).length();
    if (!is_seen || size < 30 || accented_edges(before, middles) != 0) continue;
    face = {.kind = Item::Kind::kFace, .id = fault, .panel = one.panel, .number = one.n};
    break;
  }
  QVERIFY(face);
  scene.bench.selection.select(face);
  QVERIFY(scene.settle());
  QCOMPARE(accented_edges(scene.grabbed("face_selected"), middles), 3);
  scene.bench.display.set_visible({.kind = Item::Kind::kFault, .id = fault}, false);
  QVERIFY(scene.settle());
  QCOMPARE(accented_edges(scene.grabbed("face_hidden"), middles), 0);
  scene.bench.display.set_visible({.kind = Item::Kind::kFault, .id = fault}, true);
  scene.bench.selection.clear();
  QVERIFY(scene.settle());
  QCOMPARE(accented_edges(scene.grabbed("face_left"), middles), 0);
}

void PointingTest::a_hovered_fault_without_faces_shows_by_its_pillars() {
  MadeScene scene;
  const Crossing crossing(scene, false);
  scene.bench.selection.set_active_fault(0);
  QVERIFY(scene.settle());
  const Item fault{.kind = Item::Kind::kFault, .id = crossing.fault};
  const QImage before = scene.grabbed("fault_not_hovered");
  scene.bench.selection.hover(fault);
  QVERIFY(differing(before, scene.grabbed("fault_hovered")) > 200);
  scene.bench.selection.hover({});
  QCOMPARE(differing(before, scene.grabbed("fault_left")), 0);
  scene.bench.display.set_visible(fault, false);
  QVERIFY(scene.settle());
  const QImage hidden = scene.grabbed("fault_hidden");
  scene.bench.selection.hover(fault);
  QCOMPARE(differing(hidden, scene.grabbed("fault_hidden_hovered")), 0);
}

void PointingTest::nodes_before_a_face_move_on_their_section() {
  MadeScene scene;
  const Crossing crossing(scene);
  QVERIFY(scene.settle());
  const QPointF node = *scene.view->pixel_of({24, 20, 30});
  int before_faces = 0;
  QPoint grip, by;
  for (int n = 0; n < 16; ++n) {
    const QPointF to(std::cos(n * M_PI / 8), std::sin(n * M_PI / 8));
    const SceneView::Under under = scene.view->under(node + 8 * to);
    QCOMPARE(under.item, (Item{.kind = Item::Kind::kNode, .id = crossing.node}));
    QVERIFY(under.on_plane);
    QCOMPARE(under.plane, scene.inline_plane);
    QVERIFY(std::abs(under.place.i - 24) < 1e-6);
    if (scene.view->under(node + 16 * to).item.kind != Item::Kind::kFace) continue;
    ++before_faces;
    grip = (node + 8 * to).toPoint();
    by = (40 * to).toPoint();
  }
  QVERIFY(before_faces > 2);
  // Move, then delete, where the face is nearer to the eye than the section.
  scene.bench.picking.set_tool(Tool::kMove);
  const std::size_t steps = scene.bench.document.history().size();
  drag(scene.view.get(), Qt::LeftButton, {grip, grip + by / 2, grip + by});
  QCOMPARE(scene.bench.document.history().size(), steps + 1);
  QVERIFY(std::abs(crossing.place().i - 24) < 1e-6);
  const QPointF now = *scene.view->pixel_of(crossing.place());
  QVERIFY(QLineF(now, node + by).length() < 1.5);
  scene.bench.picking.set_tool(Tool::kPick);
  QVERIFY(scene.settle());
  QTest::mouseClick(scene.view.get(), Qt::LeftButton, Qt::ControlModifier, grip + by);
  QVERIFY(scene.bench.document.fault_of_node(crossing.node) == nullptr);
}

void PointingTest::a_drag_stays_on_the_section_that_it_began_on() {
  MadeScene scene;
  const Crossing crossing(scene);
  scene.bench.display.move_section(scene.slice_plane, {.kind = Section::Kind::kSlice, .index = 20});
  scene.view->look(StandardView::kOblique);
  QVERIFY(scene.settle());
  scene.bench.picking.set_tool(Tool::kMove);
  const auto behind_face = crossing.hidden_place(
      [](const SceneView::Under& under) { return under.item.kind == Item::Kind::kFace; });
  const auto behind_slice = crossing.hidden_place(
      [&](const SceneView::Under& under) { return under.on_plane && under.plane == scene.slice_plane; });
  QVERIFY(behind_face && behind_slice);
  // The topmost node of the pillar is before the slice.
  Id top = 0;
  for (const survey::Pillar& pillar : scene.bench.document.fault(crossing.fault)->pillars) {
    if (pillar.nodes[1].id == crossing.node) top = pillar.nodes[0].id;
  }
  const auto place = [&] {
    const survey::Geometry& survey = *scene.bench.document.survey();
    for (const survey::Pillar& pillar : scene.bench.document.shown_pillars(crossing.fault)) {
      if (pillar.nodes[0].id == top) return survey.index_of(pillar.nodes[0].position);
    }
    return survey::IndexPoint{};
  };
  QPoint at = scene.view->pixel_of(place())->toPoint();
  QCOMPARE(scene.view->under(at).item, (Item{.kind = Item::Kind::kNode, .id = top}));
  QTest::mousePress(scene.view.get(), Qt::LeftButton, {}, at);
  for (const survey::IndexPoint& to : {*behind_slice, *behind_face, *behind_slice}) {
    const QPoint pixel = scene.view->pixel_of(to)->toPoint();
    QMouseEvent move(QEvent::MouseMove, pixel, scene.view->mapToGlobal(pixel), Qt::NoButton, Qt::LeftButton,
                     Qt::NoModifier);
    QApplication::sendEvent(scene.view.get(), &move);
    QVERIFY(scene.bench.picking.is_dragging());
    QVERIFY(std::abs(place().i - 24) < 1e-6);
    QVERIFY(std::abs(place().j - to.j) < 0.5 && std::abs(place().k - to.k) < 0.8);
    at = pixel;
  }
  const std::size_t steps = scene.bench.document.history().size();
  QTest::mouseRelease(scene.view.get(), Qt::LeftButton, {}, at);
  QCOMPARE(scene.bench.document.history().size(), steps + 1);
  QVERIFY(std::abs(place().j - behind_slice->j) < 0.5 && std::abs(place().k - behind_slice->k) < 0.8);
}

void PointingTest::escape_puts_a_plane_back() {
  MadeScene scene;
  QVERIFY(scene.settle());
  std::optional<QPoint> frame;
  for (int y = 20; y < 680 && !frame; y += 2) {
    for (int x = 20; x < 880 && !frame; x += 2) {
      const SceneView::Under under = scene.view->under(QPointF(x, y));
      if (under.on_frame && under.plane == scene.inline_plane) frame = QPoint(x, y);
    }
  }
  QVERIFY(frame.has_value());
  const Section before = scene.bench.display.sections()[0].section;
  QTest::mouseMove(scene.view.get(), *frame + QPoint(30, 30));
  QTest::mouseMove(scene.view.get(), *frame);
  for (const Tool tool : {Tool::kSelect, Tool::kPick, Tool::kMove}) {
    scene.bench.picking.set_tool(tool);
    QVERIFY(scene.bench.picking.hint().startsWith("drag moves this plane"));
    QCOMPARE(scene.view->cursor().shape(), Qt::SizeAllCursor);
  }
  scene.bench.picking.set_tool(Tool::kSelect);
  QTest::mousePress(scene.view.get(), Qt::LeftButton, {}, *frame);
  for (int n = 1; n <= 10; ++n) QTest::mouseMove(scene.view.get(), *frame + QPoint(8 * n, 8 * n));
  QVERIFY(scene.bench.display.sections()[0].section != before);
  QKeyEvent asked(QEvent::ShortcutOverride, Qt::Key_Escape, Qt::NoModifier);
  asked.ignore();
  QCoreApplication::sendEvent(scene.view.get(), &asked);
  QVERIFY(asked.isAccepted());
  QTest::keyClick(scene.view.get(), Qt::Key_Escape);
  QCOMPARE(scene.bench.display.sections()[0].section, before);
  QTest::mouseMove(scene.view.get(), *frame + QPoint(60, 60));
  QTest::mouseRelease(scene.view.get(), Qt::LeftButton, {}, *frame + QPoint(60, 60));
  QCOMPARE(scene.bench.display.sections()[0].section, before);
}

void PointingTest::keys_are_let_go_with_the_focus() {
  MadeScene scene;
  QVERIFY(scene.settle());
  const QString camera = scene.view->camera_text();
  QTest::mouseMove(scene.view.get(), QPoint(6, 6));
  QTest::mouseMove(scene.view.get(), QPoint(5, 5));
  const auto lose_focus = [&] {
    QFocusEvent out(QEvent::FocusOut, Qt::ActiveWindowFocusReason);
    QCoreApplication::sendEvent(scene.view.get(), &out);
  };
  QTest::keyPress(scene.view.get(), Qt::Key_Space);
  QVERIFY(scene.bench.picking.hint().contains("Space"));
  lose_focus();
  QVERIFY(!scene.bench.picking.hint().contains("Space"));
  drag(scene.view.get(), Qt::LeftButton, {{450, 350}, {480, 380}, {510, 400}});
  QCOMPARE(scene.view->camera_text(), camera);
}

void PointingTest::a_plane_follows_its_frame() {
  MadeScene scene;
  QVERIFY(scene.settle());
  const auto index = [&] { return scene.bench.display.sections()[0].section.index; };
  double caught = 1;
  // A place on the inline plane's upper edge, and where that of a plane twenty lines on is.
  const auto at = [&](std::int64_t line) {
    return scene.view->pixel_of({static_cast<double>(line), caught, -0.5})->toPoint();
  };
  const std::int64_t before = index();
  // Where nothing else is in the way.
  while (caught < 39 && !scene.view->under(at(before)).on_frame) ++caught;
  QVERIFY(scene.view->under(at(before)).on_frame);
  QTest::mousePress(scene.view.get(), Qt::LeftButton, {}, at(before));
  for (int n = 1; n <= 20; ++n) QTest::mouseMove(scene.view.get(), at(before - n));
  QVERIFY(std::abs(index() - (before - 20)) <= 1);
  QVERIFY(scene.settle());
  scene.grabbed("plane_dragged");
  QTest::mouseRelease(scene.view.get(), Qt::LeftButton, {}, at(before - 20));
  // Far beyond the survey it stops at its first line.
  QTest::mousePress(scene.view.get(), Qt::LeftButton, {}, at(index()));
  for (int n = 0; n <= 10; ++n) QTest::mouseMove(scene.view.get(), at(index()) + (at(0) - at(40)) * n);
  QTest::mouseRelease(scene.view.get(), Qt::LeftButton, {}, at(0));
  QCOMPARE(index(), 0);
}

void PointingTest::wheel_zooms_at_the_mouse() {
  MadeScene scene;
  QVERIFY(scene.settle());
  const QPointF at(520, 360);
  const SceneView::Under before = scene.view->under(at);
  QVERIFY(before.hit);
  for (int n = 0; n < 5; ++n) turn_wheel(scene.view.get(), at, 1);
  const auto after = scene.view->pixel_of(before.place);
  QVERIFY(after.has_value());
  QVERIFY(std::hypot(after->x() - at.x(), after->y() - at.y()) < 1.5);
}

void PointingTest::small_moves_turn_nothing() {
  MadeScene scene;
  QVERIFY(scene.settle());
  const QString camera = scene.view->camera_text();
  QTest::mousePress(scene.view.get(), Qt::MiddleButton, {}, QPoint(300, 300));
  QTest::mouseMove(scene.view.get(), QPoint(302, 301));
  QCOMPARE(scene.view->camera_text(), camera);
  QTest::mouseMove(scene.view.get(), QPoint(330, 310));
  QVERIFY(scene.view->camera_text() != camera);
  QTest::mouseRelease(scene.view.get(), Qt::MiddleButton, {}, QPoint(330, 310));
  QVERIFY(scene.view->set_camera_text(camera));
  QCOMPARE(scene.view->camera_text(), camera);
  QVERIFY(!scene.view->set_camera_text("45,30"));
  QVERIFY(!scene.view->set_camera_text("1,2,3;1,2,3"));
}

void PointingTest::keys_work() {
  MadeScene scene;
  QVERIFY(scene.settle());
  const QImage plain = scene.grabbed("perspective");
  QTest::keyClick(scene.view.get(), Qt::Key_O);
  QVERIFY(!scene.bench.display.perspective());
  QVERIFY(scene.settle());
  QVERIFY(scene.grabbed("orthographic") != plain);
  QTest::keyClick(scene.view.get(), Qt::Key_O);
  QTest::keyClick(scene.view.get(), Qt::Key_E);
  QVERIFY(scene.bench.display.faces().edges);
  QVERIFY(scene.settle());
  QVERIFY(scene.grabbed("edges") != plain);
  // The window's actions send these two here: they must not come back to the window.
  for (const Qt::Key key : {Qt::Key_F, Qt::Key_Home}) {
    QKeyEvent asked(QEvent::ShortcutOverride, key, Qt::NoModifier);
    asked.ignore();
    QCoreApplication::sendEvent(scene.view.get(), &asked);
    QVERIFY(asked.isAccepted());
  }
}

void PointingTest::selects_by_box_and_lasso() {
  MadeScene scene;
  const Id fault = scene.first_fault();
  for (const Fault& other : scene.bench.document.faults()) {
    const Id id = other.record.id;
    scene.bench.display.set_visible({.kind = Item::Kind::kFault, .id = id}, id == fault);
  }
  QVERIFY(scene.settle());
  Selection& selection = scene.bench.selection;
  const std::vector<survey::Pillar>& pillars = scene.bench.document.fault(fault)->pillars;
  // 1. All of a fault: the fault. Hidden ones are left out.
  drag(scene.view.get(), Qt::LeftButton, {{1, 1}, {400, 300}, {898, 698}});
  QCOMPARE(selection.faults(), std::set<Id>{fault});
  QVERIFY(selection.pillars().empty() && selection.nodes().empty());
  // 2. All of a pillar: the pillar.
  const QRect box = around(scene, pillars.front());
  drag(scene.view.get(), Qt::LeftButton, {box.topLeft(), box.center(), box.bottomRight()});
  QVERIFY(selection.faults().empty());
  QVERIFY(selection.pillars().contains(pillars.front().id));
  QVERIFY(selection.pillars().size() < pillars.size());
  // 3. Ctrl adds; a lasso around one node of another pillar, one that is seen, has that node.
  const std::set<Id> before = selection.pillars();
  std::set<Id> nodes = selection.nodes();  // of neighbours that reach into the box
  QPoint node;
  Id wanted = 0;
  scene.bench.selection.set_active_fault(fault);
  const auto pixel_of = [&](const survey::PillarNode& one) {
    return *scene.view->pixel_of(scene.bench.document.survey()->index_of(one.position));
  };
  const auto stands_alone = [&](const QPointF& at) {
    int near = 0;
    for (const survey::Pillar& pillar : pillars) {
      for (const auto& one : pillar.nodes) near += QLineF(pixel_of(one), at).length() < 16 ? 1 : 0;
    }
    return near == 1;
  };
  for (const survey::Pillar& pillar : pillars) {
    if (before.contains(pillar.id)) continue;
    for (const auto& one : pillar.nodes) {
      const QPointF at = pixel_of(one);
      const Item item{.kind = Item::Kind::kNode, .id = one.id};
      if (nodes.contains(one.id) || !stands_alone(at) || scene.view->under(at).item != item) continue;
      if (scene.view->under(at.toPoint() - QPoint(9, 9)).on_frame) continue;  // where a drag moves a plane
      node = at.toPoint();
      wanted = one.id;
    }
  }
  QVERIFY(wanted != 0);
  const auto ring = [&](Qt::KeyboardModifiers modifiers) {
    drag(scene.view.get(), Qt::LeftButton,
         {node + QPoint(-9, -9), node + QPoint(9, -9), node + QPoint(9, 9), node + QPoint(-9, 9)}, modifiers);
  };
  ring(Qt::ShiftModifier | Qt::ControlModifier);
  QCOMPARE(selection.pillars(), before);
  nodes.insert(wanted);
  QCOMPARE(selection.nodes(), nodes);
  // 4. Esc while it is drawn leaves all as it was; a box around nothing selects nothing.
  QTest::mousePress(scene.view.get(), Qt::LeftButton, {}, {2, 2});
  QTest::mouseMove(scene.view.get(), {300, 300});
  QTest::keyClick(scene.view.get(), Qt::Key_Escape);
  QTest::mouseRelease(scene.view.get(), Qt::LeftButton, {}, {898, 698});
  QCOMPARE(selection.pillars(), before);
  drag(scene.view.get(), Qt::LeftButton, {{2, 2}, {10, 10}, {20, 20}});
  QVERIFY(selection.pillars().empty() && selection.nodes().empty());
  // 5. Behind a plane nothing is seen, so nothing is selected.
  for (const Display::ShownSection& shown : std::vector(scene.bench.display.sections()))
    scene.bench.display.remove_section(shown.id);
  scene.view->look(StandardView::kTop);
  scene.bench.display.add_section({.kind = Section::Kind::kSlice, .index = 0});
  QVERIFY(scene.settle());
  std::set<Id> deep;
  for (const survey::Pillar& pillar : pillars) {
    for (const auto& one : pillar.nodes) {
      if (scene.bench.document.survey()->index_of(one.position).k > 3) deep.insert(one.id);
    }
  }
  QVERIFY(!deep.empty());
  drag(scene.view.get(), Qt::LeftButton, {{1, 1}, {400, 300}, {898, 698}});
  for (const Id hidden : selection.nodes()) QVERIFY(!deep.contains(hidden));
}

void PointingTest::a_box_around_a_surface_without_pillars_selects_it() {
  MadeScene scene;
  const Id with_pillars = scene.first_fault();
  const Id imported = new_fault(scene.bench.document);
  const auto surface = std::make_shared<FaultSurface>(*scene.surfaces[with_pillars]);
  surface->fault = imported;
  scene.surfaces[imported] = surface;
  scene.numbers[imported] = scene.numbers[with_pillars];
  Q_EMIT scene.bench.surfaces.surfaces_changed({imported});
  for (const Fault& fault : scene.bench.document.faults()) {
    const Id id = fault.record.id;
    scene.bench.display.set_visible({.kind = Item::Kind::kFault, .id = id}, id == imported);
  }
  QVERIFY(scene.settle());
  const Selection& selection = scene.bench.selection;
  drag(scene.view.get(), Qt::LeftButton, {{1, 1}, {400, 300}, {898, 698}});
  QCOMPARE(selection.faults(), std::set<Id>{imported});
  drag(scene.view.get(), Qt::LeftButton, {{1, 1}, {200, 300}, {449, 698}});  // half of it
  QVERIFY(selection.faults().empty());
  // Under a plane nothing of it is seen.
  scene.view->look(StandardView::kTop);
  scene.bench.display.add_section({.kind = Section::Kind::kSlice, .index = 0});
  auto deeper = std::make_shared<FaultSurface>(*surface);
  const double depth = scene.bench.document.survey()->world_of({0, 0, 10}).z;
  for (survey::WorldPoint& vertex : deeper->vertices) vertex.z = std::max(vertex.z, depth);
  scene.surfaces[imported] = deeper;
  Q_EMIT scene.bench.surfaces.surfaces_changed({imported});
  QVERIFY(scene.settle());
  drag(scene.view.get(), Qt::LeftButton, {{1, 1}, {400, 300}, {898, 698}});
  QVERIFY(selection.faults().empty());
}

void PointingTest::a_lasso_assigns_pillars_in_one_step() {
  MadeScene scene;
  Document& document = scene.bench.document;
  const survey::Geometry survey = *document.survey();
  std::set<Id> loose;
  document.edit("Pick", [&](project::Interpretation& now) {
    const Id unassigned = now.add_fault(kUnassigned);
    for (const double j : {30.0, 34.0}) {
      const std::array nodes{survey.world_of({44, j, 6}), survey.world_of({44, j + 1, 30})};
      loose.insert(now.add_pillar(unassigned, survey::PillarKind::kInterpreted, nodes).id);
    }
  });
  for (const Fault& fault : document.faults()) {
    if (!is_unassigned(fault))
      scene.bench.display.set_visible({.kind = Item::Kind::kFault, .id = fault.record.id}, false);
  }
  scene.bench.display.remove_section(scene.inline_plane);
  QVERIFY(scene.settle());
  const QSignalSpy caught(&scene.bench.selection, &Selection::unassigned_caught);
  QRect box;
  for (const Id id : loose) box = box.united(around(scene, *document.pillar(id)));
  drag(scene.view.get(), Qt::LeftButton,
       {box.topLeft(), box.topRight(), box.bottomRight(), box.bottomLeft(), box.topLeft() + QPoint(0, 1)},
       Qt::ShiftModifier);
  QCOMPARE(scene.bench.selection.pillars(), loose);
  QCOMPARE(caught.size(), 1);
  QCOMPARE(caught[0][0].value<std::set<Id>>(), loose);
  drag(scene.view.get(), Qt::LeftButton, {box.topLeft(), box.center(), box.bottomRight()});
  QCOMPARE(scene.bench.selection.pillars(), loose);
  QCOMPARE(caught.size(), 1);  // a box only selects
  const std::size_t steps = document.history().size();
  const Id made = split_fault(document, scene.bench.selection.pillars());
  QVERIFY(made != 0);
  QCOMPARE(document.history().size(), steps + 1);
  QCOMPARE(document.fault(made)->pillars.size(), std::size_t{2});
}

void PointingTest::presets_say_what_the_mouse_does() {
  MadeScene scene;
  QVERIFY(scene.settle());
  const QString home = scene.view->camera_text();
  const auto dragged = [&](Qt::MouseButton button, Qt::KeyboardModifiers modifiers = {}) {
    scene.view->set_camera_text(home);
    const double azimuth = scene.view->camera().azimuth();
    const double scale = scene.view->camera().metres_per_pixel({900, 700});
    drag(scene.view.get(), button, {{450, 350}, {480, 380}, {510, 400}}, modifiers);
    if (std::abs(scene.view->camera().azimuth() - azimuth) > 1) return MouseAction::kOrbit;
    if (scene.view->camera_text() == home) return MouseAction::kNone;
    const double now = scene.view->camera().metres_per_pixel({900, 700});
    return std::abs(now - scale) < 1e-9 * scale ? MouseAction::kPan : MouseAction::kZoom;
  };
  QCOMPARE(dragged(Qt::MiddleButton), MouseAction::kOrbit);
  QCOMPARE(dragged(Qt::MiddleButton, Qt::ShiftModifier), MouseAction::kPan);
  QCOMPARE(dragged(Qt::RightButton), MouseAction::kNone);
  for (const MousePreset& preset : mouse_presets()) {
    scene.bench.mouse.choose(QLatin1String(preset.name));
    for (const DragBinding& one : preset.scene) {
      QVERIFY2(dragged(one.button, one.modifiers) == one.action, preset.name);
    }
    QCOMPARE(dragged(Qt::LeftButton), MouseAction::kNone);
    QCOMPARE(dragged(Qt::LeftButton, Qt::AltModifier), MouseAction::kOrbit);
  }
  scene.bench.mouse.choose(QStringLiteral("Footwall"));
}

void PointingTest::cameras_come_back_exactly() {
  MadeScene scene;
  QVERIFY(scene.settle());
  for (const double exaggeration : {1.0, 3.0}) {
    scene.bench.display.set_exaggeration(exaggeration);
    for (const StandardView view : {StandardView::kOblique, StandardView::kTop, StandardView::kSouth}) {
      scene.view->look(view);
      for (int turn = 0; turn < 4; ++turn) {
        const QString camera = scene.view->camera_text();
        const Vec3 eye = scene.view->camera().eye();
        const bool looks = turn == 1;
        QVERIFY(!looks || scene.settle());
        const QImage before = looks ? scene.grabbed("camera_before") : QImage();
        scene.view->look(StandardView::kEast);
        QVERIFY(scene.view->camera_text() != camera);
        QVERIFY(scene.view->set_camera_text(camera));
        QCOMPARE(scene.view->camera_text(), camera);
        QVERIFY(length(scene.view->camera().eye() - eye) < 1e-9 * length(eye));
        QVERIFY(!looks || scene.settle());
        QVERIFY(!looks || scene.grabbed("camera_after") == before);
        QTest::keyClick(scene.view.get(), turn % 2 == 0 ? Qt::Key_Right : Qt::Key_Down);
        QTest::keyClick(scene.view.get(), Qt::Key_Plus);
      }
    }
  }
}

static const RegisterTest<PointingTest> kRegistered;

}  // namespace footwall::ui

#include "pointing_test.moc"
