#include "ui/random_hand.h"

#include <algorithm>
#include <cmath>

#include "ui/model/fault_commands.h"

namespace footwall::ui {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kPicks = 11;
constexpr std::size_t kCommands = 14;

std::size_t steps_done(const Document& document) {
  return static_cast<std::size_t>(
      std::ranges::count_if(document.history(), [](const auto& step) { return !step.undone; }));
}

std::size_t pillars_of(const Document& document) {
  std::size_t count = 0;
  for (const Fault& fault : document.faults()) count += fault.pillars.size();
  return count;
}

Item node_item(const survey::PillarNode& node) {
  return {.kind = Item::Kind::kNode, .id = node.id};
}

}  // namespace

RandomHand::RandomHand(Document& document, Selection& selection, Picking& picking, unsigned seed)
    : document_(document),
      selection_(selection),
      picking_(picking),
      random_(seed),
      first_steps_(steps_done(document)),
      first_faults_(document.faults().size()),
      first_pillars_(pillars_of(document)) {}

double RandomHand::between(double low, double high) {
  return low + (high - low) * static_cast<double>(random_() % 100003) / 100002;
}

const Fault* RandomHand::some_fault(bool with_pillars) {
  std::vector<const Fault*> faults;
  for (const Fault& fault : document_.faults()) {
    if (!with_pillars || !fault.pillars.empty()) faults.push_back(&fault);
  }
  return faults.empty() ? nullptr : faults[below(faults.size())];
}

std::set<Id> RandomHand::some_pillars(const Fault& fault, std::size_t most) {
  std::set<Id> pillars;
  for (std::size_t n = 1 + below(most); n > 0; --n)
    pillars.insert(fault.pillars[below(fault.pillars.size())].id);
  return pillars;
}

Section RandomHand::some_section() {
  Section section;
  section.kind = static_cast<Section::Kind>(below(3));
  section.index = static_cast<std::int64_t>(
      below(static_cast<std::size_t>(last_index(section, *document_.survey()) + 1)));
  return section;
}

Section RandomHand::section_through(const survey::PillarNode& node) {
  const survey::IndexPoint p = document_.survey()->index_of(node.position);
  const std::array places{p.i, p.j, p.k};
  Section section;
  section.kind = static_cast<Section::Kind>(below(3));
  section.index = std::llround(places[static_cast<std::size_t>(section.kind)]);
  return stepped(section, 0, *document_.survey());
}

PlanePoint RandomHand::some_place(const Section& section) {
  const PlaneSize size = size_of(section, *document_.survey());
  return {between(0, size.width - 1), between(0, size.height - 1)};
}

Pointer RandomHand::at(const Section& section, const PlanePoint& place, const Item& under,
                       Qt::KeyboardModifiers modifiers) {
  Pointer p;
  p.x = place.u * 10;
  p.y = place.v * 10;
  p.place = index_of(section, place);
  p.section = section;
  p.on_section = true;
  p.under = under;
  p.modifiers = modifiers;
  p.button = Qt::LeftButton;
  p.time = clock_ += 10ms;
  return p;
}

void RandomHand::click(const Pointer& pointer) {
  picking_.move(pointer);
  picking_.press(pointer);
  picking_.release(pointer);
}

void RandomHand::drag(const Pointer& from, const PlanePoint& to, bool gives_up,
                      std::chrono::milliseconds pace) {
  const PlanePoint begin = plane_of(from.section, from.place);
  picking_.move(from);
  picking_.press(from);
  constexpr int kMoves = 6;
  for (int n = 1; n <= kMoves; ++n) {
    const double part = static_cast<double>(n) / kMoves;
    const double aside = std::sin(part * 3) * 2;
    const Pointer p =
        at(from.section, {begin.u + part * (to.u - begin.u) + aside, begin.v + part * (to.v - begin.v)});
    clock_ += pace;
    picking_.move(p);
  }
  if (gives_up) picking_.key_press(Qt::Key_Escape, {});
  picking_.release(at(from.section, to));
}

QString RandomHand::pick(std::size_t what) {
  picking_.set_tool(Tool::kPick);
  const Fault* fault = some_fault(true);
  if (what < 4 || fault == nullptr) {
    if (below(6) == 0) {
      selection_.clear();
      selection_.set_active_fault(0);
    } else if (const Fault* target = some_fault(false)) {
      selection_.select({.kind = Item::Kind::kFault, .id = target->record.id});
    }
    const Section section = some_section();
    if (what == 0) {
      drag(at(section, some_place(section)), some_place(section), below(8) == 0, 60ms);
      return QStringLiteral("free-hand stroke");
    }
    for (std::size_t n = 1 + below(3); n > 0; --n) click(at(section, some_place(section)));
    if (below(2) == 0) {
      const Pointer again = at(section, some_place(section));
      click(again);
      picking_.double_click(again);
    } else {
      picking_.key_press(Qt::Key_Return, {});
    }
    return QStringLiteral("clicks on empty ground");
  }
  const survey::Pillar& pillar = fault->pillars[below(fault->pillars.size())];
  const std::size_t place = below(pillar.nodes.size());
  const survey::PillarNode node = pillar.nodes[place];
  const Section section = section_through(node);
  const PlanePoint here = plane_of(section, document_.survey()->index_of(node.position));
  const PlanePoint there{here.u + between(-4, 4), here.v + between(-4, 4)};
  const Item of_pillar{.kind = Item::Kind::kPillar, .id = pillar.id};
  switch (what) {
    case 4:
    case 5:
    case 6:
      drag(at(section, here, node_item(node)), there, below(8) == 0, 5ms);
      return QStringLiteral("drag of a node");
    case 7:
      click(at(section, here, node_item(node), Qt::ControlModifier));
      return QStringLiteral("Ctrl+click on a node");
    case 8: {
      selection_.select(of_pillar);
      Pointer p = at(section, there, of_pillar);
      p.segment = static_cast<int>(place);
      click(p);
      return QStringLiteral("click on a pillar");
    }
    case 9:
      picking_.key_press(Qt::Key_QuoteLeft, {});
      drag(at(section, here, of_pillar), there, false, 5ms);
      picking_.key_release(Qt::Key_QuoteLeft);
      return QStringLiteral("copy of a pillar");
    default:
      picking_.set_tool(Tool::kMove);
      drag(at(section, here, of_pillar), there, below(8) == 0, 5ms);
      return QStringLiteral("drag of a pillar");
  }
}

QString RandomHand::command(std::size_t what) {
  const std::size_t faults = document_.faults().size();
  if (what == 0 && faults > first_faults_ + first_faults_ / 4 + 2) what = 4;
  if (what == 4 && faults < first_faults_ - first_faults_ / 4) what = 0;
  if (what == 0) {
    new_fault(document_);
    return QStringLiteral("new fault");
  }
  const Fault* fault = some_fault(what != 1 && what != 2);
  const Fault* other = some_fault(false);
  if (fault == nullptr || other == nullptr) return QStringLiteral("nothing");
  const Id id = fault->record.id;
  switch (what) {
    case 1:
      rename_fault(document_, id, QStringLiteral("R%1").arg(random_()));
      return QStringLiteral("rename");
    case 2:
      set_fault_colour(document_, {id, other->record.id},
                       QStringLiteral("#%1").arg(random_() & 0xffffffU, 6, 16, QLatin1Char('0')));
      return QStringLiteral("colour");
    case 3: {
      std::set<Id> locked;
      for (const Fault& one : document_.faults()) {
        if (one.record.locked) locked.insert(one.record.id);
      }
      if (locked.size() > 2) {
        lock_faults(document_, locked, false);
      } else {
        lock_faults(document_, {id}, true);
      }
      return QStringLiteral("lock");
    }
    case 4:
      merge_faults(document_, id, {other->record.id});
      return QStringLiteral("merge");
    case 5:
      split_fault(document_, some_pillars(*fault, 5));
      return QStringLiteral("split");
    case 6:
      assign_pillars(document_, some_pillars(*fault, 5), other->record.id);
      return QStringLiteral("assign");
    case 7:
      if (below(2) == 0) {
        reverse_pillars(document_, some_pillars(*fault, 3));
        return QStringLiteral("reverse");
      }
      reorder_pillars(document_, some_pillars(*fault, 3));
      return QStringLiteral("reorder");
    case 8:
      smooth_pillars(document_, some_pillars(*fault, 3));
      return QStringLiteral("smooth");
    case 9:
      resample_pillars(document_, some_pillars(*fault, 2), 2 + static_cast<int>(below(20)));
      return QStringLiteral("resample");
    case 10: {
      Transform transform;
      transform.move = {between(-20, 20), between(-20, 20), between(-8, 8)};
      transform.rotate_degrees = below(2) == 0 ? 0 : between(-10, 10);
      if (below(3) == 0) transform.scale = {between(0.9, 1.1), between(0.9, 1.1), 1};
      if (below(4) == 0) {
        transform_items(document_, {id}, {}, {}, transform);
      } else {
        transform_items(document_, {}, some_pillars(*fault, 2), {}, transform);
      }
      return QStringLiteral("transform");
    }
    case 11:
      accept_pillars(document_, some_pillars(*fault, 4));
      return QStringLiteral("accept");
    case 12: {
      const survey::Pillar& pillar = fault->pillars[below(fault->pillars.size())];
      std::set<Id> nodes;
      for (int n = 0; n < 3; ++n) nodes.insert(pillar.nodes[below(pillar.nodes.size())].id);
      delete_items(document_, {}, {}, nodes);
      return QStringLiteral("delete nodes");
    }
    default:
      if (faults > first_faults_ && below(6) == 0) {
        delete_items(document_, {id}, {}, {});
        return QStringLiteral("delete a fault");
      }
      if (pillars_of(document_) >= first_pillars_) delete_items(document_, {}, some_pillars(*fault, 3), {});
      return QStringLiteral("delete pillars");
  }
}

QString RandomHand::step_in_history() {
  if (document_.can_redo() && below(2) == 0) {
    document_.redo();
    return QStringLiteral("redo");
  }
  if (steps_done(document_) > first_steps_) document_.undo();
  return QStringLiteral("undo");
}

QString RandomHand::act() {
  const std::size_t what = below(kPicks + kCommands + 1);
  if (what < kPicks) return pick(what);
  if (what < kPicks + kCommands) return command(what - kPicks);
  return step_in_history();
}

bool RandomHand::move_a_node() {
  const Fault* fault = some_fault(true);
  if (fault == nullptr) return false;
  const survey::Pillar& pillar = fault->pillars[below(fault->pillars.size())];
  const survey::PillarNode node = pillar.nodes[below(pillar.nodes.size())];
  return document_.edit(QStringLiteral("Move node"), [&](project::Interpretation& now) {
    now.move_node(node.id, {node.position.x + between(1, 5), node.position.y, node.position.z});
  });
}

}  // namespace footwall::ui
