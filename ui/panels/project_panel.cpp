#include "ui/panels/project_panel.h"

#include <QAction>
#include <QContextMenuEvent>
#include <QItemSelectionModel>
#include <QMenu>
#include <QMessageBox>
#include <QMouseEvent>
#include <QPainter>
#include <QPushButton>
#include <algorithm>
#include <utility>

#include "ui/model/fault_commands.h"
#include "ui/model/project_job.h"
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
  const QModelIndex index = tree_->index_of(workbench_.selection.owner());
  if (!index.isValid() || (index.flags() & Qt::ItemIsEditable) == 0) return;
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
  std::vector<Item> at_once, for_good;
  for (const QModelIndex& index : selectionModel()->selectedIndexes()) {
    const Item item = tree_->item_of(index);
    const bool lasts = item.kind == Item::Kind::kVolume || item.kind == Item::Kind::kRun;
    (lasts ? for_good : at_once).push_back(item);
  }
  tree_->remove(at_once);
  if (!for_good.empty()) ask_to_delete(for_good);
}

void ProjectPanel::ask_to_delete(const std::vector<Item>& items) {
  QStringList words{tr("This cannot be undone: volumes and runs are outside of the history.")};
  for (const Item& item : items) {
    if (items.size() > 1) words.append(tree_->index_of(item).data().toString());
    const auto& volumes = workbench_.document.volumes();
    const auto volume = std::ranges::find(volumes, item.id, &project::VolumeRecord::id);
    if (item.kind != Item::Kind::kVolume || volume == volumes.end()) continue;
    words.append(
        tr("Its isosurfaces go, too; its file stays on the disk: %1")
            .arg(QString::fromStdString(workbench_.document.project().volume_path(*volume).string())));
  }
  auto* box =
      new QMessageBox(QMessageBox::Warning, tr("Delete"),
                      items.size() > 1 ? tr("Delete these %1?").arg(items.size())
                                       : tr("Delete %1?").arg(tree_->index_of(items[0]).data().toString()),
                      QMessageBox::Cancel, this);
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->setTextFormat(Qt::PlainText);
  box->setInformativeText(words.join(QLatin1Char('\n')));
  QPushButton* yes = box->addButton(tr("Delete"), QMessageBox::DestructiveRole);
  yes->setObjectName(QStringLiteral("delete"));
  connect(yes, &QPushButton::clicked, this, [this, items] { delete_for_good(items); });
  box->setDefaultButton(QMessageBox::Cancel);
  box->open();
}

// Runs by a job: the faces of a large one fill hundreds of megabytes.
void ProjectPanel::delete_for_good(const std::vector<Item>& items) {
  std::vector<Item> volumes;
  std::vector<Id> runs;
  for (const Item& item : items) {
    if (item.kind == Item::Kind::kVolume) volumes.push_back(item);
    if (item.kind == Item::Kind::kRun) runs.push_back(item.id);
  }
  const bool was_shown = std::ranges::find(items, workbench_.selection.current()) != items.end();
  tree_->remove(volumes);
  if (was_shown) workbench_.selection.clear();
  if (runs.empty()) return;
  Document& document = workbench_.document;
  try {
    start_on_project(workbench_, runs.size() > 1 ? tr("Delete %1 runs").arg(runs.size()) : tr("Delete a run"),
                     [runs, &document](project::Project& project, const JobContext& job) {
                       for (const Id run : runs) {
                         job.check();
                         project.delete_run(run);
                         QMetaObject::invokeMethod(
                             &document, [&document] { Q_EMIT document.runs_changed(); },
                             Qt::QueuedConnection);
                       }
                     });
  } catch (const Error& error) {
    Q_EMIT document.failed(QString::fromStdString(error.message()), QString::fromStdString(error.hint()));
  }
}

// A click on nothing: nothing is selected, and picks go to no fault.
void ProjectPanel::mousePressEvent(QMouseEvent* event) {
  QTreeView::mousePressEvent(event);
  if (event->button() != Qt::LeftButton || event->modifiers() != Qt::NoModifier ||
      indexAt(event->position().toPoint()).isValid())
    return;
  workbench_.selection.clear();
  workbench_.selection.set_active_fault(0);
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
  } else if (item.kind == Item::Kind::kRun) {
    add("edit.rename");
    add("view.run");
  } else if (item) {
    add("edit.rename");
  }
  if (item) {
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
  if (const QModelIndex index = add(selection.owner()); index.isValid()) current = index;
  showing_ = true;
  selectionModel()->select(rows, QItemSelectionModel::ClearAndSelect);
  if (current.isValid()) selectionModel()->setCurrentIndex(current, QItemSelectionModel::NoUpdate);
  if (current.isValid()) scrollTo(current);
  showing_ = false;
}

}  // namespace footwall::ui
