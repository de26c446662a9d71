#include "ui/model/selection.h"

#include <algorithm>
#include <utility>

#include "ui/model/fault_commands.h"

namespace footwall::ui {
namespace {

// Whether it is among them now.
bool toggle(std::set<Id>& ids, Id id) {
  return ids.erase(id) == 0 && ids.insert(id).second;
}

}  // namespace

Selection::Selection(Document& document, QObject* parent) : QObject(parent), document_(document) {
  connect(&document_, &Document::shapes_changed, this, &Selection::drop_what_is_gone);
  connect(&document_, &Document::faults_changed, this, &Selection::drop_what_is_gone);
  connect(&document_, &Document::volumes_changed, this, &Selection::drop_what_is_gone);
}

void Selection::select(const Item& item, bool extend) {
  if (!extend) {
    faults_.clear();
    pillars_.clear();
    nodes_.clear();
  }
  bool stays = true;
  if (item.kind == Item::Kind::kFault || item.kind == Item::Kind::kFace) stays = toggle(faults_, item.id);
  if (item.kind == Item::Kind::kPillar) stays = toggle(pillars_, item.id);
  if (item.kind == Item::Kind::kNode) stays = toggle(nodes_, item.id);
  current_ = stays ? item : only_one();
  Id active = active_fault_;
  if (item.kind == Item::Kind::kFault || item.kind == Item::Kind::kFace) active = item.id;
  const Fault* owner = item.kind == Item::Kind::kPillar ? document_.fault_of_pillar(item.id)
                       : item.kind == Item::Kind::kNode ? document_.fault_of_node(item.id)
                                                        : nullptr;
  if (owner != nullptr) active = owner->record.id;
  announce(active);
}

void Selection::add(const Item& item) {
  const std::set<Id>* of_kind = item.kind == Item::Kind::kFault    ? &faults_
                                : item.kind == Item::Kind::kPillar ? &pillars_
                                : item.kind == Item::Kind::kNode   ? &nodes_
                                                                   : nullptr;
  if (of_kind == nullptr || !of_kind->contains(item.id)) return select(item, true);
  current_ = item;
  announce(active_fault_);
}

void Selection::select_all(std::set<Id> faults, std::set<Id> pillars, std::set<Id> nodes, bool extend) {
  if (!extend) {
    faults_.clear();
    pillars_.clear();
    nodes_.clear();
  }
  faults_.merge(faults);
  pillars_.merge(pillars);
  nodes_.merge(nodes);
  current_ = only_one();
  announce(faults_.size() == 1 ? *faults_.begin() : active_fault_);
}

void Selection::select_by_lasso(std::set<Id> faults, std::set<Id> pillars, std::set<Id> nodes) {
  std::set<Id> unassigned = pillars;
  std::erase_if(unassigned, [this](Id pillar) {
    const Fault* fault = document_.fault_of_pillar(pillar);
    return fault == nullptr || !is_unassigned(*fault);
  });
  select_all(std::move(faults), std::move(pillars), std::move(nodes));
  if (!unassigned.empty() && !document_.read_only()) Q_EMIT unassigned_caught(unassigned);
}

Item Selection::only_one() const {
  if (faults_.size() + pillars_.size() + nodes_.size() != 1) return {};
  if (!faults_.empty()) return {.kind = Item::Kind::kFault, .id = *faults_.begin()};
  if (!pillars_.empty()) return {.kind = Item::Kind::kPillar, .id = *pillars_.begin()};
  return {.kind = Item::Kind::kNode, .id = *nodes_.begin()};
}

Item Selection::owner() const {
  Id fault = 0;
  const auto is_another = [&fault](const Fault* of) {
    if (of != nullptr && fault == 0) fault = of->record.id;
    return of != nullptr && of->record.id != fault;
  };
  if (std::ranges::any_of(faults_, [&](Id id) { return is_another(document_.fault(id)); }) ||
      std::ranges::any_of(pillars_, [&](Id id) { return is_another(document_.fault_of_pillar(id)); }) ||
      std::ranges::any_of(nodes_, [&](Id id) { return is_another(document_.fault_of_node(id)); })) {
    return {};
  }
  return fault != 0 ? Item{.kind = Item::Kind::kFault, .id = fault} : current_;
}

void Selection::set_active_fault(Id fault) {
  if (fault == active_fault_) return;
  active_fault_ = fault;
  Q_EMIT active_fault_changed(fault);
}

void Selection::clear() {
  select({});
}

void Selection::hover(const Item& item) {
  if (item == hovered_) return;
  hovered_ = item;
  Q_EMIT hover_changed();
}

void Selection::drop_what_is_gone() {
  const auto is_gone = [this](const Item& item) {
    switch (item.kind) {
      case Item::Kind::kFault:
      case Item::Kind::kFace:
        return document_.fault(item.id) == nullptr;
      case Item::Kind::kPillar:
        return document_.fault_of_pillar(item.id) == nullptr;
      case Item::Kind::kNode:
        return document_.fault_of_node(item.id) == nullptr;
      case Item::Kind::kVolume:
        return std::ranges::find(document_.volumes(), item.id, &project::VolumeRecord::id) ==
               document_.volumes().end();
      default:
        return false;
    }
  };
  std::size_t dropped = std::erase_if(faults_, [this](Id id) { return document_.fault(id) == nullptr; });
  dropped += std::erase_if(pillars_, [this](Id id) { return document_.fault_of_pillar(id) == nullptr; });
  dropped += std::erase_if(nodes_, [this](Id id) { return document_.fault_of_node(id) == nullptr; });
  if (is_gone(current_)) {
    current_ = {};
    ++dropped;
  }
  if (is_gone(hovered_)) hover({});
  if (document_.fault(active_fault_) == nullptr) set_active_fault(0);
  if (dropped != 0) Q_EMIT changed();
}

void Selection::announce(Id active) {
  set_active_fault(active);
  Q_EMIT changed();
}

}  // namespace footwall::ui
