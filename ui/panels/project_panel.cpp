#include "ui/panels/project_panel.h"

#include <QAction>
#include <QContextMenuEvent>
#include <QItemSelectionModel>
#include <QMenu>
#include <QPainter>
#include <utility>

#include "ui/model/fault_commands.h"
#include "ui/panels/project_row.h"

namespace footwall::ui {

ProjectPanel::ProjectPanel(Workbench& workbench, FindAction action, QWidget* parent)
    : QTreeView(parent), workbench_(workbench), action_(std::move(action)) {
  tree_ = new ProjectTree(workbench_.document, workbench_.display, this);
  setModel(tree_);
  setItemDelegate(new ProjectRow(this));
  setHeaderHidden(true);
  setFrameShape(QFrame::NoFrame);
  setUniformRowHeights(true);
  setIndentation(14);
  setSelectionMode(QAbstractItemView::ExtendedSelection);
  setEditTriggers(QAbstractItemView::SelectedClicked);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  expandAll();
  connect(&workbench_.selection, &Selection::changed, this, &ProjectPanel::show_selection);
  connect(this, &QTreeView::activated, this, [this](const QModelIndex& index) {
    const Item item = tree_->item_of(index);
    if (item.kind == Item::Kind::kView) Q_EMIT view_asked(item.name);
    if (item.kind == Item::Kind::kIsosurface) Q_EMIT isosurface_asked(item.id);
  });
  connect(tree_, &ProjectTree::rowsInserted, this, [this](const QModelIndex& top) {
    expand(top);
    show_selection();
  });
  show_selection();
  // What the mouse is over here is highlighted in the views.
  setMouseTracking(true);
  connect(this, &QTreeView::entered, this,
          [this](const QModelIndex& index) { workbench_.selection.hover(tree_->item_of(index)); });
  connect(this, &QTreeView::viewportEntered, this, [this] { workbench_.selection.hover({}); });
}

void ProjectPanel::rename_current() {
  const QModelIndex index = tree_->index_of(workbench_.selection.current());
  if (!index.isValid()) return;
  setFocus();
  setCurrentIndex(index);
  edit(index);
}

void ProjectPanel::delete_selected() {
  const Selection& selection = workbench_.selection;
  if (!selection.faults().empty() || !selection.pillars().empty() || !selection.nodes().empty()) {
    delete_items(workbench_.document, selection.faults(), selection.pillars(), selection.nodes());
    return;
  }
  tree_->remove({selection.current()});
}

void ProjectPanel::contextMenuEvent(QContextMenuEvent* event) {
  const Item item = tree_->item_of(indexAt(event->pos()));
  QMenu menu(this);
  const auto add = [&](const char* id) {
    if (QAction* action = action_(QString::fromLatin1(id))) menu.addAction(action);
  };
  if (item.kind == Item::Kind::kFault) {
    for (const char* id : {"edit.rename", "fault.colour", "fault.lock", "fault.merge", "fault.interpolate"})
      add(id);
    menu.addSeparator();
  } else if (item.kind == Item::Kind::kView) {
    add("edit.rename");
  }
  if (item.kind == Item::Kind::kFault || item.kind == Item::Kind::kView ||
      item.kind == Item::Kind::kIsosurface) {
    add("edit.delete");
  } else {
    for (const char* id : {"fault.new", "file.import"}) add(id);
  }
  menu.exec(event->globalPos());
}

// A small triangle at the headings, nothing at rows.
void ProjectPanel::drawBranches(QPainter* painter, const QRect& rect, const QModelIndex& index) const {
  if (index.parent().isValid()) {
    if (!selectionModel()->isSelected(index)) return;
    QColor tint = palette().color(QPalette::Link);
    tint.setAlphaF(ProjectRow::kSelectedTint);
    return painter->fillRect(rect, tint);
  }
  painter->save();
  painter->setRenderHint(QPainter::Antialiasing);
  painter->setPen(Qt::NoPen);
  painter->setBrush(palette().color(QPalette::PlaceholderText));
  painter->translate(QRectF(rect).center() + QPointF(1, 0.5));
  if (!isExpanded(index)) painter->rotate(-90);
  painter->drawPolygon(QPolygonF{{-3.5, -2}, {3.5, -2}, {0, 2.5}});
  painter->restore();
}

bool ProjectPanel::viewportEvent(QEvent* event) {
  if (event->type() == QEvent::Leave) workbench_.selection.hover({});
  return QTreeView::viewportEvent(event);
}

void ProjectPanel::selectionChanged(const QItemSelection& selected, const QItemSelection& deselected) {
  QTreeView::selectionChanged(selected, deselected);
  if (showing_) return;
  std::set<Id> faults;
  for (const QModelIndex& index : selectionModel()->selectedIndexes()) {
    const Item item = tree_->item_of(index);
    if (item.kind == Item::Kind::kFault) faults.insert(item.id);
  }
  showing_ = true;
  const Item current = tree_->item_of(currentIndex());
  if (faults.size() > 1) {
    workbench_.selection.select_all(faults, {}, {});
  } else {
    workbench_.selection.select(selectionModel()->hasSelection() ? current : Item{});
  }
  showing_ = false;
}

// What was selected in a view; of pillars and nodes, their fault.
void ProjectPanel::show_selection() {
  if (showing_) return;
  const Selection& selection = workbench_.selection;
  QItemSelection rows;
  const auto add = [&](const Item& item) {
    const QModelIndex index = tree_->index_of(item);
    if (index.isValid()) rows.select(index, index);
    return index;
  };
  QModelIndex current;
  for (const Id fault : selection.faults()) current = add({.kind = Item::Kind::kFault, .id = fault});
  Item one = selection.current();
  const Fault* owner = one.kind == Item::Kind::kPillar ? workbench_.document.fault_of_pillar(one.id)
                       : one.kind == Item::Kind::kNode ? workbench_.document.fault_of_node(one.id)
                                                       : nullptr;
  if (owner != nullptr) one = {.kind = Item::Kind::kFault, .id = owner->record.id};
  if (one.kind == Item::Kind::kFace) one = {.kind = Item::Kind::kFault, .id = one.id};
  if (const QModelIndex index = add(one); index.isValid()) current = index;
  showing_ = true;
  selectionModel()->select(rows, QItemSelectionModel::ClearAndSelect);
  if (current.isValid()) selectionModel()->setCurrentIndex(current, QItemSelectionModel::NoUpdate);
  if (current.isValid()) scrollTo(current);
  showing_ = false;
}

}  // namespace footwall::ui
