// What is in the project, as a tree: volumes, faults, isosurfaces, runs, views. Check boxes show and hide,
// names are edited in place; a rename or removal of a fault is one edit, volumes and runs are outside of the
// history.
#pragma once
#include <QAbstractItemModel>
#include <QColor>
#include <array>
#include <vector>

#include "ui/model/display.h"
#include "ui/model/document.h"
#include "ui/model/selection.h"

namespace footwall::ui {

// The setting in which the editor keeps what a saved view shows besides its camera.
std::string setting_of_view(const QString& name);

class ProjectTree final : public QAbstractItemModel {
  Q_OBJECT

 public:
  // Besides Qt's: the colour swatch (QColor, invalid where a row has none), and what stands at the right in
  // dim letters.
  enum Role { kColour = Qt::UserRole, kDetail };

  ProjectTree(Document& document, Display& display, QObject* parent = nullptr);

  // Nothing for a heading.
  Item item_of(const QModelIndex& index) const;
  QModelIndex index_of(const Item& item) const;
  // What is outside of the history and left by remove().
  struct Removed {
    std::vector<IsosurfaceLook> isosurfaces = {};
    std::vector<project::ViewRecord> views = {};
    bool empty() const { return isosurfaces.empty() && views.empty(); }
  };

  // Faults leave by one edit; isosurfaces, views and volumes at once, a volume with its isosurfaces and
  // without its file. Runs stay, since a large one takes its time: Project::delete_run. Whether any item
  // left.
  bool remove(const std::vector<Item>& items);
  // By the last remove() of such items, until put_back(); not what went with a volume.
  const Removed& removed() const { return removed_; }
  void put_back();

  QModelIndex index(int row, int column, const QModelIndex& parent = {}) const override;
  QModelIndex parent(const QModelIndex& child) const override;
  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  bool setData(const QModelIndex& index, const QVariant& value, int role) override;
  Qt::ItemFlags flags(const QModelIndex& index) const override;

 Q_SIGNALS:
  void removed_changed();

 private:
  enum Group : std::size_t { kVolumes, kFaults, kIsosurfaces, kRuns, kViews, kGroups };
  struct Row {
    Item item;
    QString name;
    QString detail;
    QColor colour;
    bool checked = false;
    friend bool operator==(const Row&, const Row&) = default;
  };
  static bool has_check(Group group) { return group != kViews; }

  std::vector<Row> rows_now(Group group) const;
  // Makes the rows of a group equal to those now, telling what came, went and changed.
  void sync(Group group);
  bool rename(const Row& row, const QString& name);
  bool rename_isosurface(Id isosurface, const QString& name);
  bool rename_volume(Id volume, const QString& name);
  bool rename_run(Id run, const QString& name);
  bool rename_view(const QString& former, const QString& name);
  bool remove_isosurface(Id isosurface, Removed& removed);
  bool remove_view(const QString& name, Removed& removed);
  bool remove_volume(Id volume);
  bool show(const Row& row, bool on);
  void tell(const Error& error);
  QModelIndex heading(Group group) const;

  Document& document_;
  Display& display_;
  Removed removed_;
  std::array<std::vector<Row>, kGroups> groups_;
};

}  // namespace footwall::ui
