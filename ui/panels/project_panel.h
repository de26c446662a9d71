// The project as a tree: what there is, what is shown, what is selected.
#pragma once
#include <QTreeView>
#include <functional>

#include "ui/model/project_tree.h"
#include "ui/model/workbench.h"

class QAction;

namespace footwall::ui {

// The window's actions by id; null where it has none of that id.
using FindAction = std::function<QAction*(const QString& id)>;

class ProjectPanel final : public QTreeView {
  Q_OBJECT

 public:
  ProjectPanel(Workbench& workbench, FindAction action, QWidget* parent = nullptr);

  ProjectTree& tree() { return *tree_; }
  // The selected row's name becomes a field.
  void rename_current();
  // What is selected here or in a view: faults, pillars and nodes by one edit. Volumes and runs, which
  // nothing brings back, after a question.
  void delete_selected();

 Q_SIGNALS:
  // A saved view was activated: by a double-click, or Enter.
  void view_asked(const QString& name);
  // An isosurface, likewise.
  void isosurface_asked(footwall::ui::Id isosurface);

 protected:
  void mousePressEvent(QMouseEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void drawBranches(QPainter* painter, const QRect& rect, const QModelIndex& index) const override;
  bool viewportEvent(QEvent* event) override;
  void selectionChanged(const QItemSelection& selected, const QItemSelection& deselected) override;

 private:
  void show_selection();
  void ask_to_delete(const std::vector<Item>& items);
  void delete_for_good(const std::vector<Item>& items);

  Workbench& workbench_;
  FindAction action_;
  ProjectTree* tree_ = nullptr;
  bool showing_ = false;  // the selection comes from elsewhere
};

}  // namespace footwall::ui
