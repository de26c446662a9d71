// The middle of the window: views in columns, all sizes free. There is a tile for each section of Display,
// and one for the scene, which can be closed.
#pragma once
#include <QJsonObject>
#include <QList>
#include <QWidget>
#include <map>
#include <vector>

#include "ui/window/views.h"

class QSplitter;

namespace footwall::ui {

class EmptyViews;
class ViewTile;

class ViewArea final : public QWidget {
  Q_OBJECT

 public:
  // layout: of an earlier layout(); what it does not know, or names wrongly, gets its usual place.
  ViewArea(Workbench& workbench, ViewFactories factories, const QJsonObject& layout,
           QWidget* parent = nullptr);
  ~ViewArea() override;

  // The tile that keys go to: the one that had the focus last. Null where there are none.
  ViewTile* active() const { return active_; }
  Id active_section() const;             // 0: none, or the scene
  std::vector<ViewTile*> tiles() const;  // column by column
  ViewTile* maximised() const { return maximised_; }

  void activate(ViewTile* tile);
  void activate_next(int by);
  // Puts it back where it was where it is maximised already.
  void maximise(ViewTile* tile);
  void close(ViewTile* tile);
  // The tile leaves its column for one of its own at the right; one that is alone joins the column at its
  // left.
  void move_to_own_column(ViewTile* tile);
  bool has_scene() const { return scene() != nullptr; }
  ViewTile* scene() const;  // null where it is closed
  const ViewFactories& factories() const { return factories_; }
  void show_scene(bool on);

  QJsonObject layout() const;

 Q_SIGNALS:
  void active_changed();
  // A button of an empty view; action: of the window's table.
  void action_asked(const QString& action);

 private:
  void sync_sections();
  void build(const QJsonObject& layout);
  ViewTile* make_tile(Id section);
  QSplitter* add_column(int place = -1);
  QSplitter* column_of(const ViewTile* tile) const;
  QSplitter* column_for_sections();
  void drop_empty_columns();
  // Tiles, or what to do where there are none.
  void show_what_there_is();
  QJsonObject look_of(const ViewTile& tile) const;
  void set_look(const ViewTile& tile, const QJsonObject& look);
  void remove(ViewTile* tile);
  void focus_moved(QWidget* now);

  Workbench& workbench_;
  ViewFactories factories_;
  QSplitter* columns_ = nullptr;
  EmptyViews* empty_ = nullptr;
  ViewTile* active_ = nullptr;
  ViewTile* maximised_ = nullptr;
  bool is_built_ = false;
  // While a view is maximised: the sizes before, which hidden views do not have.
  QList<int> widths_before_;
  std::map<const QSplitter*, QList<int>> heights_before_;
};

}  // namespace footwall::ui
