#include "ui/model/selection.h"

#include <utility>

#include "ui/model/fault_commands.h"

namespace footwall::ui {
namespace {

void toggle(std::set<Id>& ids, Id id) {
  if (ids.erase(id) == 0) ids.insert(id);
}

}  // namespace

Selection::Selection(Document& document, QObject* parent) : QObject(parent), document_(document) {
  connect(&document_, &Document::shapes_changed, this, &Selection::drop_what_is_gone);
  connect(&document_, &Document::faults_changed, this, &Selection::drop_what_is_gone);
}

void Selection::select(const Item& item, bool extend) {
  if (!extend) {
    faults_.clear();
    pillars_.clear();
    nodes_.clear();
  }
  if (item.kind == Item::Kind::kFault || item.kind == Item::Kind::kFace) toggle(faults_, item.id);
  if (item.kind == Item::Kind::kPillar) toggle(pillars_, item.id);
  if (item.kind == Item::Kind::kNode) toggle(nodes_, item.id);
  current_ = item;
  Id active = active_fault_;
  if (item.kind == Item::Kind::kFault || item.kind == Item::Kind::kFace) active = item.id;
  const Fault* owner = item.kind == Item::Kind::kPillar ? document_.fault_of_pillar(item.id)
                       : item.kind == Item::Kind::kNode ? document_.fault_of_node(item.id)
                                                        : nullptr;
  if (owner != nullptr) active = owner->record.id;
  announce(active);
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
  current_ = {};
  if (faults_.size() == 1) current_ = {.kind = Item::Kind::kFault, .id = *faults_.begin()};
  if (pillars_.size() == 1) current_ = {.kind = Item::Kind::kPillar, .id = *pillars_.begin()};
  if (nodes_.size() == 1) current_ = {.kind = Item::Kind::kNode, .id = *nodes_.begin()};
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
