#include "ui/model/picking.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "ui/model/fault_commands.h"
#include "ui/model/provisional_move.h"
#include "ui/model/stroke.h"

namespace footwall::ui {
namespace {

using namespace std::chrono_literals;
using survey::IndexPoint;
using survey::WorldPoint;

constexpr double kStill = 4;               // pixels: less is a click
constexpr double kStrokeTravel = 5;        // pixels
constexpr auto kStrokeTime = 200ms;        // longer than a click that slipped
constexpr double kStrokeTolerance = 0.75;  // voxels
constexpr int kStepWhilePicking = 10;      // lines

double travel(const Pointer& from, const Pointer& to) {
  return std::hypot(to.x - from.x, to.y - from.y);
}

QString name_of(const Fault& fault) {
  return QString::fromStdString(fault.record.name);
}

}  // namespace

struct Picking::State {
  // What the button that is down does.
  enum class Gesture { kNone, kClick, kMoveItems, kStroke, kCopy };

  State(Picking& owner, Document& d, Selection& s, Display& v)
      : self(owner), document(d), selection(s), display(v) {}

  Picking& self;
  Document& document;
  Selection& selection;
  Display& display;

  Tool tool = Tool::kSelect;
  Id active = 0;           // the pillar that clicks add to
  Section active_section;  // on which they do
  bool navigates = false;  // Space is held
  bool copies = false;     // ` is held

  Gesture gesture = Gesture::kNone;
  Pointer pressed;  // where the gesture began
  Pointer at;       // the last place of the mouse
  bool inside = false;
  std::map<Id, std::vector<survey::PillarNode>> grabbed;  // by pillar: as they stood
  std::vector<IndexPoint> stroke;
  QString hint;
  PointerShape shape = PointerShape::kArrow;

  bool can_pick(const Pointer& p) const {
    return p.on_section && document.survey() && !document.read_only() && !navigates;
  }
  IndexPoint snapped(IndexPoint p, const Section& section) const {
    if (!display.snaps_to_samples()) return p;
    IndexPoint sample{std::round(p.i), std::round(p.j), std::round(p.k)};
    if (section.kind == Section::Kind::kLine) sample = {p.i, p.j, std::round(p.k)};
    return sample;
  }
  WorldPoint world(const IndexPoint& p) const { return document.survey()->world_of(p); }
  IndexPoint index(const WorldPoint& p) const { return document.survey()->index_of(p); }
  const Fault* fault_at(const Item& item) const {
    switch (item.kind) {
      case Item::Kind::kNode:
        return document.fault_of_node(item.id);
      case Item::Kind::kPillar:
        return document.fault_of_pillar(item.id);
      case Item::Kind::kFace:
      case Item::Kind::kFault:
        return document.fault(item.id);
      default:
        return nullptr;
    }
  }
  // The pillar pointed at, also by one of its nodes; null where it is gone.
  const survey::Pillar* pillar_at(const Item& item) const {
    if (item.kind == Item::Kind::kPillar) return document.pillar(item.id);
    const Fault* fault = item.kind == Item::Kind::kNode ? document.fault_of_node(item.id) : nullptr;
    if (fault == nullptr) return nullptr;
    const auto has_node = [&](const survey::Pillar& pillar) {
      return std::ranges::find(pillar.nodes, item.id, &survey::PillarNode::id) != pillar.nodes.end();
    };
    const auto found = std::ranges::find_if(fault->pillars, has_node);
    return found == fault->pillars.end() ? nullptr : &*found;
  }
  const Fault* active_fault() const { return document.fault(selection.active_fault()); }
  // While one fault is picked, the nodes and lines of others do not catch its clicks: faults meet, and a pick
  // beside another fault must not go to that one.
  bool is_of_another(const Item& item) const {
    const Fault* owner = fault_at(item);
    return tool == Tool::kPick && owner != nullptr && active_fault() != nullptr && owner != active_fault();
  }
  // The pillar that a click on empty ground of this section adds to, or null where it starts a new one.
  const survey::Pillar* pillar_to_extend(const Pointer& p) const {
    if (active == 0 || !(p.section == active_section) || (p.modifiers & Qt::ShiftModifier) != 0)
      return nullptr;
    const survey::Pillar* pillar = document.pillar(active);
    const Fault* fault = document.fault_of_pillar(active);
    const bool elsewhere = active_fault() != nullptr && fault != active_fault();
    return elsewhere ? nullptr : pillar;
  }
  // Whether a click on this pillar's line puts a node there.
  bool inserts_into(const Pointer& p) const {
    if (p.under.kind != Item::Kind::kPillar || p.segment < 0 || (p.modifiers & Qt::ShiftModifier) != 0)
      return false;
    const Fault* fault = document.fault_of_pillar(p.under.id);
    return p.under.id == active || (fault != nullptr && fault == active_fault());
  }

  void activate(Id pillar, const Section& section) {
    active_section = section;
    if (std::exchange(active, pillar) != pillar) Q_EMIT self.active_pillar_changed();
  }

  // ---- what a click does ----

  // Adds a pillar to the active fault, or to those that belong to none; its id, 0 where that was refused.
  Id add_pillar(const std::vector<IndexPoint>& nodes) {
    const Fault* fault = active_fault();
    const QString name = fault != nullptr ? tr("Add pillar (%1)").arg(name_of(*fault)) : tr("Add pillar");
    Id owner = fault != nullptr ? fault->record.id : 0;
    if (owner == 0) {
      const auto unassigned = std::ranges::find_if(document.faults(), is_unassigned);
      if (unassigned != document.faults().end()) owner = unassigned->record.id;
    }
    std::vector<WorldPoint> positions;
    for (const IndexPoint& p : nodes) positions.push_back(world(p));
    Id made = 0;
    const bool done = document.edit(name, [&](project::Interpretation& now) {
      if (owner == 0) {
        owner = now.add_fault(kUnassigned);
        now.set_fault_property(owner, "colour", "#8d95a1");
      }
      made = now.add_pillar(owner, survey::PillarKind::kInterpreted, positions).id;
    });
    return done ? made : 0;
  }

  void click(const Pointer& p) {
    const bool control = (p.modifiers & Qt::ControlModifier) != 0;
    if (!control && is_of_another(p.under)) return add_node(p);
    if (p.under.kind == Item::Kind::kNode) {
      if (control) {
        delete_node(p.under.id);
      } else {
        selection.select(p.under);
        if (const survey::Pillar* pillar = pillar_at(p.under)) activate(pillar->id, p.section);
      }
      return;
    }
    if (control) return;
    if (inserts_into(p)) {
      insert(p, static_cast<std::size_t>(p.segment) + 1, p.under.id);
    } else if (p.under.kind == Item::Kind::kPillar && (p.modifiers & Qt::ShiftModifier) == 0) {
      selection.select(p.under);
      activate(p.under.id, p.section);
    } else {
      add_node(p);
    }
  }

  void add_node(const Pointer& p) {
    const survey::Pillar* pillar = pillar_to_extend(p);
    if (pillar == nullptr) {
      if (const Id made = add_pillar({snapped(p.place, p.section)}); made != 0) activate(made, p.section);
      return;
    }
    std::vector<IndexPoint> line;
    for (const survey::PillarNode& node : pillar->nodes) line.push_back(index(node.position));
    insert(p, best_place(line, snapped(p.place, p.section)), pillar->id);
  }

  void insert(const Pointer& p, std::size_t place, Id pillar) {
    const WorldPoint position = world(snapped(p.place, p.section));
    const survey::Pillar* found = document.pillar(pillar);
    const Fault* fault = document.fault_of_pillar(pillar);
    if (found == nullptr || fault == nullptr) return;
    // A second click on the same spot adds nothing.
    const bool stands_there = std::ranges::any_of(
        found->nodes, [&](const survey::PillarNode& node) { return node.position == position; });
    if (stands_there) return;
    const bool done =
        document.edit(tr("Add node (%1)").arg(name_of(*fault)), [&](project::Interpretation& now) {
          now.insert_node(pillar, static_cast<std::int64_t>(place), position);
        });
    if (done) activate(pillar, p.section);
  }

  void delete_node(Id node) { delete_items(document, {}, {}, {node}); }

  void end_pillar() {
    const Id ended = active;
    activate(0, active_section);
    if (ended == 0) return;
    if (display.steps_after_pillar()) step_on();
    Q_EMIT self.pillar_ended(ended);
  }

  // The section that the pillar was picked on, also where that was in the scene.
  void step_on() {
    const auto& all = display.sections();
    const auto shown = std::ranges::find(all, active_section, &Display::ShownSection::section);
    if (shown == all.end() || !document.survey()) return;
    display.move_section(shown->id, stepped(shown->section, self.step_lines(), *document.survey()));
  }

  // ---- dragging ----

  // What a drag that began here moves: the selection where the item is part of it, else the item alone.
  bool grab(const Pointer& p) {
    grabbed.clear();
    const auto grab_pillar = [this](const survey::Pillar& pillar, const auto& wanted) {
      for (const survey::PillarNode& node : pillar.nodes) {
        if (wanted(node)) grabbed[pillar.id].push_back(node);
      }
    };
    const auto all = [](const survey::PillarNode&) { return true; };
    const auto picked = [](const survey::Pillar& pillar) {
      return pillar.kind != survey::PillarKind::kInterpolated;
    };
    const bool of_selection =
        (p.under.kind == Item::Kind::kNode && selection.nodes().contains(p.under.id)) ||
        (p.under.kind == Item::Kind::kPillar && selection.pillars().contains(p.under.id)) ||
        (p.under.kind == Item::Kind::kFace && selection.faults().contains(p.under.id));
    for (const Fault& fault : document.faults()) {
      for (const survey::Pillar& pillar : fault.pillars) {
        if (of_selection) {
          if (selection.pillars().contains(pillar.id) ||
              (selection.faults().contains(fault.record.id) && p.under.kind == Item::Kind::kFace &&
               picked(pillar))) {
            grab_pillar(pillar, all);
          } else {
            grab_pillar(pillar, [this](const survey::PillarNode& node) {
              return selection.nodes().contains(node.id);
            });
          }
        } else if (p.under.kind == Item::Kind::kNode) {
          grab_pillar(pillar, [&p](const survey::PillarNode& node) { return node.id == p.under.id; });
        } else if (p.under.kind == Item::Kind::kPillar && pillar.id == p.under.id) {
          grab_pillar(pillar, all);
        }
      }
    }
    return !grabbed.empty();
  }

  // Where the grabbed nodes stand now that the mouse is at p: moved in the plane of the section.
  std::map<Id, WorldPoint> dragged_to(const Pointer& p) const {
    const Section& section = pressed.section;
    const PlanePoint from = plane_of(section, pressed.place);
    const PlanePoint to = plane_of(section, p.place);
    std::size_t count = 0;
    for (const auto& [pillar, nodes] : grabbed) count += nodes.size();
    std::map<Id, WorldPoint> moved;
    for (const auto& [pillar, nodes] : grabbed) {
      for (const survey::PillarNode& node : nodes) {
        const IndexPoint before = index(node.position);
        const PlanePoint plane = plane_of(section, before);
        const IndexPoint on_plane = index_of(section, plane);
        const PlanePoint shifted{plane.u + to.u - from.u, plane.v + to.v - from.v};
        IndexPoint after = index_of(section, shifted);
        // Only a single node is drawn onto the plane: a group keeps its shape.
        if (count > 1 || !display.snaps_to_section() || gesture == Gesture::kCopy) {
          after = {after.i + before.i - on_plane.i, after.j + before.j - on_plane.j,
                   after.k + before.k - on_plane.k};
        }
        moved[node.id] = world(count == 1 ? snapped(after, section) : after);
      }
    }
    return moved;
  }

  void show_dragged(const Pointer& p) {
    const std::map<Id, WorldPoint> moved = dragged_to(p);
    std::set<Id> faults;
    for (const auto& [pillar, nodes] : grabbed) {
      if (const Fault* fault = document.fault_of_pillar(pillar)) faults.insert(fault->record.id);
    }
    for (const Id fault : faults) {
      std::vector<survey::Pillar> pillars = document.fault(fault)->pillars;
      if (gesture == Gesture::kCopy) {
        pillars.push_back(copy_of(grabbed.begin()->second, moved));
        document.show_provisionally(fault, std::move(pillars));
      } else {
        document.show_provisionally(fault, moved_provisionally(std::move(pillars), moved));
      }
    }
  }

  static survey::Pillar copy_of(const std::vector<survey::PillarNode>& nodes,
                                const std::map<Id, WorldPoint>& moved) {
    survey::Pillar copy;
    for (const survey::PillarNode& node : nodes) copy.nodes.push_back({0, moved.at(node.id)});
    return copy;
  }

  void drop(const Pointer& p) {
    const std::map<Id, WorldPoint> moved = dragged_to(p);
    if (gesture == Gesture::kCopy) {
      const Id original = grabbed.begin()->first;
      const survey::Pillar copy = copy_of(grabbed.begin()->second, moved);
      const Fault* fault = document.fault_of_pillar(original);
      Id made = 0;
      const bool done =
          document.edit(tr("Copy pillar (%1)").arg(name_of(*fault)), [&](project::Interpretation& now) {
            made = now.add_pillar(now.fault_of_pillar(original), copy).id;
          });
      if (done) activate(made, pressed.section);
      return;
    }
    const Fault* fault = document.fault_of_pillar(grabbed.begin()->first);
    const QString name = moved.size() == 1     ? tr("Move node (%1)").arg(name_of(*fault))
                         : grabbed.size() == 1 ? tr("Move pillar (%1)").arg(name_of(*fault))
                                               : tr("Move selection");
    document.edit(name, [&](project::Interpretation& now) {
      for (const auto& [node, position] : moved) now.move_node(node, position);
    });
  }

  void end_stroke() {
    const std::vector<IndexPoint> points = std::exchange(stroke, {});
    Q_EMIT self.stroke_changed();
    std::vector<IndexPoint> nodes = simplified(points, kStrokeTolerance);
    for (IndexPoint& node : nodes) node = snapped(node, pressed.section);
    nodes.erase(std::ranges::unique(nodes).begin(), nodes.end());
    if (nodes.empty()) return;
    if (const Id made = add_pillar(nodes); made != 0) {
      activate(made, pressed.section);
      end_pillar();
    }
  }

  // Not so after an undo while the button was down.
  bool holds_what_is_there() const {
    return std::ranges::all_of(grabbed, [this](const auto& entry) {
      return std::ranges::all_of(
          entry.second, [this](const auto& node) { return document.fault_of_node(node.id) != nullptr; });
    });
  }

  // Whatever the hand was doing, nothing of it stays.
  void abandon() {
    const Gesture was = std::exchange(gesture, Gesture::kNone);
    grabbed.clear();
    if (was == Gesture::kMoveItems || was == Gesture::kCopy) document.end_provisional();
    if (was == Gesture::kStroke) {
      stroke.clear();
      Q_EMIT self.stroke_changed();
    }
  }

  // ---- what is said ----

  std::pair<QString, PointerShape> next_click() const {
    if (!inside) return {{}, PointerShape::kArrow};
    if (navigates) return {tr("drag moves the view; let Space go to pick on"), PointerShape::kHand};
    if (gesture == Gesture::kStroke)
      return {tr("let go to end the pillar; Esc drops it"), PointerShape::kPen};
    if (gesture == Gesture::kMoveItems)
      return {tr("let go to move it here; Esc puts it back"), PointerShape::kMoveNode};
    if (gesture == Gesture::kCopy)
      return {tr("let go to put the copy here; Esc drops it"), PointerShape::kMoveNode};
    if (at.on_frame) return {tr("drag moves this plane; Esc puts it back"), PointerShape::kMoveNode};
    if (tool == Tool::kSelect) return select_hint();
    if (document.read_only())
      return {tr("read-only: somebody else writes this project"), PointerShape::kArrow};
    if (!at.on_section) return hint_beside_sections();
    const Fault* under = fault_at(at.under);
    if (under != nullptr && under->record.locked && !is_of_another(at.under)) {
      return {tr("%1 is locked: unlock it to change it").arg(name_of(*under)), PointerShape::kArrow};
    }
    return tool == Tool::kMove ? move_hint() : pick_hint();
  }
  std::pair<QString, PointerShape> select_hint() const {
    const Fault* under = fault_at(at.under);
    if (under != nullptr)
      return {tr("click selects %1; Ctrl+click adds to the selection").arg(words_for(at.under)),
              PointerShape::kArrow};
    if (at.under.kind == Item::Kind::kIsosurface)
      return {tr("click selects %1").arg(words_for(at.under)), PointerShape::kArrow};
    return {tr("drag a box to select, Shift+drag a lasso; P picks, M moves"), PointerShape::kArrow};
  }
  // Where nothing can be picked or moved a click selects, whatever the tool.
  std::pair<QString, PointerShape> hint_beside_sections() const {
    const QString rest =
        tool == Tool::kMove ? tr("point at a section to move") : tr("point at a section to pick");
    const QString under = words_for(at.under);
    return {under.isEmpty() ? rest : tr("click selects %1; %2").arg(under, rest), PointerShape::kArrow};
  }
  std::pair<QString, PointerShape> move_hint() const {
    if (fault_at(at.under) == nullptr)
      return {tr("drag a node, a pillar or the selection to move it"), PointerShape::kArrow};
    if (at.under.kind == Item::Kind::kFace && !selection.faults().contains(at.under.id))
      return {tr("click selects %1, which a drag then moves").arg(words_for(at.under)), PointerShape::kArrow};
    return {tr("drag moves %1").arg(words_for(at.under)), PointerShape::kMoveNode};
  }
  std::pair<QString, PointerShape> pick_hint() const {
    const Fault* target = active_fault();
    if (copies) return {tr("drag a pillar to copy it"), PointerShape::kMoveNode};
    const bool another = is_of_another(at.under);
    if (at.under.kind == Item::Kind::kNode) {
      if ((at.modifiers & Qt::ControlModifier) != 0)
        return {tr("click deletes this node"), PointerShape::kDeleteNode};
      if (!another) return {tr("drag moves this node; Ctrl+click deletes it"), PointerShape::kMoveNode};
    }
    if (inserts_into(at))
      return {tr("click inserts a node into %1").arg(words_for(at.under)), PointerShape::kAddNode};
    if (at.under.kind == Item::Kind::kPillar && !another && (at.modifiers & Qt::ShiftModifier) == 0) {
      return {tr("click goes on with %1").arg(words_for(at.under)), PointerShape::kArrow};
    }
    if (target != nullptr && target->record.locked) {
      return {tr("%1 is locked: unlock it to change it").arg(name_of(*target)), PointerShape::kArrow};
    }
    if (const survey::Pillar* pillar = pillar_to_extend(at)) {
      return {tr("click adds a node to %1; double-click ends it")
                  .arg(words_for({.kind = Item::Kind::kPillar, .id = pillar->id})),
              PointerShape::kAddNode};
    }
    return {target == nullptr ? tr("click starts a pillar; drag draws one")
                              : tr("click starts a pillar of %1; drag draws one").arg(name_of(*target)),
            PointerShape::kCross};
  }
  QString words_for(const Item& item) const {
    if (item.kind == Item::Kind::kIsosurface) return tr("this isosurface");
    const Fault* fault = fault_at(item);
    if (fault == nullptr) return {};
    switch (item.kind) {
      case Item::Kind::kNode:
        return tr("a node of %1").arg(name_of(*fault));
      case Item::Kind::kPillar: {
        const auto place =
            std::ranges::find(fault->pillars, item.id, &survey::Pillar::id) - fault->pillars.begin();
        return tr("pillar %1 of %2").arg(place + 1).arg(name_of(*fault));
      }
      default:
        return name_of(*fault);
    }
  }
  void say() {
    auto [words, pointer] = next_click();
    const bool differs = words != hint || pointer != shape;
    hint = std::move(words);
    shape = pointer;
    if (differs) Q_EMIT self.hint_changed();
  }
};

Picking::Picking(Document& document, Selection& selection, Display& display, QObject* parent)
    : QObject(parent), state_(std::make_unique<State>(*this, document, selection, display)) {
  const auto drop_what_is_gone = [this] {
    if (state_->active != 0 && state_->document.pillar(state_->active) == nullptr) {
      state_->activate(0, state_->active_section);
    }
    state_->say();
  };
  connect(&document, &Document::shapes_changed, this, drop_what_is_gone);
  connect(&document, &Document::faults_changed, this, drop_what_is_gone);
  connect(&selection, &Selection::active_fault_changed, this, [this] { state_->say(); });
  connect(&selection, &Selection::changed, this, [this] { state_->say(); });
}

Picking::~Picking() = default;

Tool Picking::tool() const {
  return state_->tool;
}

void Picking::set_tool(Tool tool) {
  state_->abandon();
  if (std::exchange(state_->tool, tool) != tool) Q_EMIT tool_changed();
  state_->say();
}

Id Picking::active_pillar() const {
  return state_->active;
}
int Picking::step_lines() const {
  return state_->display.own_step().value_or(state_->tool == Tool::kPick ? kStepWhilePicking : 1);
}

bool Picking::press(const Pointer& pointer) {
  State& s = *state_;
  s.inside = true;
  s.at = pointer;
  if (pointer.button != Qt::LeftButton || s.tool == Tool::kSelect || !s.can_pick(pointer)) return false;
  if (pointer.modifiers & Qt::AltModifier) return false;  // the scene's orbit
  s.abandon();
  s.pressed = pointer;
  const Fault* under = s.fault_at(pointer.under);
  if (under != nullptr && under->record.locked && s.is_of_another(pointer.under)) {
    s.pressed.under = {};  // a drag leaves it alone, too
    under = nullptr;
  }
  const bool locked = (under != nullptr && under->record.locked) ||
                      (under == nullptr && s.active_fault() != nullptr && s.active_fault()->record.locked);
  if (locked) return true;  // the hint says why nothing happens
  s.gesture = s.tool == Tool::kPick || under != nullptr ? State::Gesture::kClick : State::Gesture::kNone;
  return s.gesture != State::Gesture::kNone;
}

bool Picking::move(const Pointer& pointer) {
  State& s = *state_;
  s.inside = true;
  s.at = pointer;
  const auto began = s.gesture;
  if (s.gesture == State::Gesture::kClick && travel(s.pressed, pointer) > kStill && pointer.on_section &&
      pointer.section == s.pressed.section) {
    const bool on_node = s.pressed.under.kind == Item::Kind::kNode;
    const bool on_pillar = s.pressed.under.kind == Item::Kind::kPillar;
    const survey::Pillar* pillar = s.pillar_at(s.pressed.under);
    if (s.copies && pillar != nullptr) {
      s.grabbed = {{pillar->id, pillar->nodes}};
      s.gesture = State::Gesture::kCopy;
    } else if ((on_node || s.tool == Tool::kMove) && s.grab(s.pressed)) {
      s.gesture = State::Gesture::kMoveItems;
    } else if (s.tool == Tool::kPick && !on_node && !on_pillar &&
               travel(s.pressed, pointer) > kStrokeTravel && pointer.time - s.pressed.time > kStrokeTime) {
      s.gesture = State::Gesture::kStroke;
      s.stroke = {s.pressed.place};
    }
  }
  if (s.gesture == State::Gesture::kMoveItems || s.gesture == State::Gesture::kCopy) {
    if (pointer.on_section && s.holds_what_is_there()) s.show_dragged(pointer);
  } else if (s.gesture == State::Gesture::kStroke && pointer.on_section &&
             pointer.section == s.pressed.section) {
    s.stroke.push_back(pointer.place);
    Q_EMIT stroke_changed();
  }
  s.say();
  return began != State::Gesture::kNone;
}

bool Picking::release(const Pointer& pointer) {
  State& s = *state_;
  s.at = pointer;
  if (pointer.button != Qt::LeftButton || s.gesture == State::Gesture::kNone) return false;
  const State::Gesture gesture = s.gesture;
  if (gesture == State::Gesture::kMoveItems || gesture == State::Gesture::kCopy) {
    if (pointer.on_section && s.holds_what_is_there()) {
      s.drop(pointer);
    } else {
      s.document.end_provisional();  // let go beside the section: as if it had not been taken up
    }
  } else if (gesture == State::Gesture::kStroke) {
    s.end_stroke();
  } else if (travel(s.pressed, pointer) <= kStill && s.tool == Tool::kPick) {
    s.click(s.pressed);
  } else if (travel(s.pressed, pointer) <= kStill) {
    s.selection.select(s.pressed.under, (pointer.modifiers & Qt::ControlModifier) != 0);
  }
  s.gesture = State::Gesture::kNone;
  s.grabbed.clear();
  s.say();
  return true;
}

bool Picking::double_click(const Pointer& pointer) {
  State& s = *state_;
  if (s.tool != Tool::kPick || pointer.button != Qt::LeftButton || !s.can_pick(pointer)) return false;
  s.abandon();
  s.end_pillar();
  s.say();
  return true;
}

bool Picking::key_press(int key, Qt::KeyboardModifiers modifiers) {
  State& s = *state_;
  s.at.modifiers = modifiers;
  bool taken = true;
  if (key == Qt::Key_Escape) {
    if (s.gesture != State::Gesture::kNone) {
      s.abandon();
    } else {
      taken = s.tool != Tool::kSelect;
      s.activate(0, s.active_section);
      set_tool(Tool::kSelect);
    }
  } else if ((key == Qt::Key_Return || key == Qt::Key_Enter) && s.tool == Tool::kPick && s.active != 0) {
    s.end_pillar();
  } else if (key == Qt::Key_Space) {
    s.navigates = true;
  } else if (key == Qt::Key_QuoteLeft) {
    s.copies = true;
  } else {
    taken = false;
  }
  s.say();
  return taken;
}

bool Picking::key_release(int key) {
  State& s = *state_;
  bool taken = true;
  if (key == Qt::Key_Space) {
    s.navigates = false;
  } else if (key == Qt::Key_QuoteLeft) {
    s.copies = false;
  } else {
    // What is said of the next click changes with them; the view may have use for them, too.
    if (key == Qt::Key_Control) s.at.modifiers.setFlag(Qt::ControlModifier, false);
    if (key == Qt::Key_Shift) s.at.modifiers.setFlag(Qt::ShiftModifier, false);
    taken = false;
  }
  s.say();
  return taken;
}

void Picking::leave() {
  state_->inside = false;
  state_->say();
}

void Picking::let_keys_go() {
  state_->navigates = state_->copies = false;
  state_->say();
}

QString Picking::hint() const {
  return state_->hint;
}
PointerShape Picking::shape() const {
  return state_->shape;
}
bool Picking::is_dragging() const {
  return state_->gesture != State::Gesture::kNone && state_->gesture != State::Gesture::kClick;
}
const std::vector<survey::IndexPoint>& Picking::stroke() const {
  return state_->stroke;
}

}  // namespace footwall::ui
