#include "ui/window/view_area.h"

#include <QApplication>
#include <QJsonArray>
#include <QSplitter>
#include <QVBoxLayout>
#include <algorithm>
#include <set>
#include <utility>

#include "ui/window/empty_views.h"
#include "ui/window/view_tile.h"

namespace footwall::ui {
namespace {

constexpr int kMaxPixels = 100000;

QJsonArray json_of(const QList<int>& sizes) {
  QJsonArray json;
  for (const int size : sizes) json.append(size);
  return json;
}

// Sizes as stored; none where they are not for `count` widgets.
QList<int> sizes_from(const QJsonValue& json, int count) {
  QList<int> sizes;
  for (const QJsonValue& size : json.toArray()) sizes.append(std::clamp(size.toInt(), 0, kMaxPixels));
  return sizes.size() == count && std::ranges::any_of(sizes, [](int size) { return size > 0; })
             ? sizes
             : QList<int>();
}

std::vector<ViewTile*> tiles_of(const QSplitter& column) {
  std::vector<ViewTile*> tiles;
  for (int n = 0; n < column.count(); ++n) {
    if (auto* tile = qobject_cast<ViewTile*>(column.widget(n))) tiles.push_back(tile);
  }
  return tiles;
}

}  // namespace

ViewArea::ViewArea(Workbench& workbench, ViewFactories factories, const QJsonObject& layout, QWidget* parent)
    : QWidget(parent), workbench_(workbench), factories_(std::move(factories)) {
  auto* whole = new QVBoxLayout(this);
  whole->setContentsMargins(0, 0, 0, 0);
  columns_ = new QSplitter(Qt::Horizontal, this);
  columns_->setHandleWidth(1);
  columns_->setChildrenCollapsible(false);
  whole->addWidget(columns_);
  empty_ = new EmptyViews(workbench_, this);
  connect(empty_, &EmptyViews::action_asked, this, &ViewArea::action_asked);
  whole->addWidget(empty_);
  build(layout);
  is_built_ = true;
  connect(&workbench_.display, &Display::sections_changed, this, &ViewArea::sync_sections);
  connect(qApp, &QApplication::focusChanged, this, [this](QWidget*, QWidget* now) { focus_moved(now); });
}

// The views go after the members here, and the one with the keys tells that it has lost them.
ViewArea::~ViewArea() {
  qApp->disconnect(this);
}

Id ViewArea::active_section() const {
  return active_ == nullptr ? 0 : active_->section();
}

std::vector<ViewTile*> ViewArea::tiles() const {
  std::vector<ViewTile*> all;
  for (int n = 0; n < columns_->count(); ++n) {
    const auto* column = qobject_cast<QSplitter*>(columns_->widget(n));
    if (column == nullptr) continue;
    const auto tiles = tiles_of(*column);
    all.insert(all.end(), tiles.begin(), tiles.end());
  }
  return all;
}

void ViewArea::activate(ViewTile* tile) {
  if (tile == active_) return;
  if (active_ != nullptr) active_->set_active(false);
  active_ = tile;
  if (active_ != nullptr) active_->set_active(true);
  Q_EMIT active_changed();
}

void ViewArea::activate_next(int by) {
  const auto all = tiles();
  if (all.empty()) return;
  const auto count = static_cast<std::ptrdiff_t>(all.size());
  const auto here = std::ranges::find(all, active_) - all.begin();
  ViewTile* next = all[static_cast<std::size_t>((here % count + by + count) % count)];
  if (maximised_ != nullptr) maximise(next);
  activate(next);
  next->view()->setFocus(Qt::ShortcutFocusReason);
}

void ViewArea::maximise(ViewTile* tile) {
  if (maximised_ == nullptr) {
    widths_before_ = columns_->sizes();
    heights_before_.clear();
    for (int n = 0; n < columns_->count(); ++n) {
      if (const auto* column = qobject_cast<QSplitter*>(columns_->widget(n)))
        heights_before_[column] = column->sizes();
    }
  }
  maximised_ = tile == maximised_ ? nullptr : tile;
  for (int n = 0; n < columns_->count(); ++n) {
    auto* column = qobject_cast<QSplitter*>(columns_->widget(n));
    if (column == nullptr) continue;
    column->setVisible(maximised_ == nullptr || column == column_of(maximised_));
    for (ViewTile* one : tiles_of(*column)) one->setVisible(maximised_ == nullptr || one == maximised_);
  }
}

void ViewArea::close(ViewTile* tile) {
  if (tile->section() != 0) {
    workbench_.display.remove_section(tile->section());
  } else {
    remove(tile);
  }
}

void ViewArea::move_to_own_column(ViewTile* tile) {
  if (maximised_ != nullptr) maximise(maximised_);
  QSplitter* from = column_of(tile);
  const int place = columns_->indexOf(from);
  if (tiles_of(*from).size() > 1) {
    add_column(place + 1)->addWidget(tile);
  } else if (place > 0) {
    qobject_cast<QSplitter*>(columns_->widget(place - 1))->addWidget(tile);
  }
  drop_empty_columns();
  tile->view()->setFocus(Qt::OtherFocusReason);
}

ViewTile* ViewArea::scene() const {
  const auto all = tiles();
  const auto found = std::ranges::find(all, 0, &ViewTile::section);
  return found == all.end() ? nullptr : *found;
}

void ViewArea::show_scene(bool on) {
  if (on == has_scene()) return;
  if (on) {
    const bool was_empty = tiles().empty();
    ViewTile* tile = make_tile(0);
    add_column(0)->addWidget(tile);
    show_what_there_is();
    if (was_empty) activate(tile);
    return;
  }
  for (ViewTile* tile : tiles()) {
    if (tile->section() == 0) remove(tile);
  }
}

void ViewArea::show_what_there_is() {
  const bool empty = tiles().empty();
  columns_->setVisible(!empty);
  empty_->setVisible(empty);
}

// Empty for what every view shows at first.
QJsonObject ViewArea::look_of(const ViewTile& tile) const {
  if (!tile.is_built()) return {};
  if (tile.section() != 0)
    return factories_.section_look ? factories_.section_look(*tile.view()) : QJsonObject();
  const QString camera = factories_.camera ? factories_.camera(*tile.view()) : QString();
  return camera.isEmpty() ? QJsonObject() : QJsonObject{{"camera", camera}};
}

void ViewArea::set_look(const ViewTile& tile, const QJsonObject& look) {
  if (!tile.is_built() || look.isEmpty()) return;
  if (tile.section() != 0) {
    if (factories_.set_section_look) factories_.set_section_look(*tile.view(), look);
  } else if (factories_.set_camera) {
    factories_.set_camera(*tile.view(), look["camera"].toString());
  }
}

// A section is named by its place in Display's list: its id is another one after opening.
QJsonObject ViewArea::layout() const {
  const auto sizes_of = [this](const QSplitter& splitter, const QList<int>& before) {
    return json_of(maximised_ != nullptr && before.size() == splitter.count() ? before : splitter.sizes());
  };
  QJsonArray columns;
  const auto& sections = workbench_.display.sections();
  for (int n = 0; n < columns_->count(); ++n) {
    const auto* column = qobject_cast<QSplitter*>(columns_->widget(n));
    if (column == nullptr) continue;
    QJsonArray tiles, looks;
    for (const ViewTile* tile : tiles_of(*column)) {
      looks.append(look_of(*tile));
      const auto found = std::ranges::find(sections, tile->section(), &Display::ShownSection::id);
      tiles.append(tile->section() == 0 ? -1 : static_cast<int>(found - sections.begin()));
    }
    const auto before = heights_before_.find(column);
    columns.append(QJsonObject{
        {"tiles", tiles},
        {"looks", looks},
        {"heights", sizes_of(*column, before != heights_before_.end() ? before->second : QList<int>())}});
  }
  return {{"columns", columns}, {"widths", sizes_of(*columns_, widths_before_)}};
}

void ViewArea::build(const QJsonObject& layout) {
  const auto& sections = workbench_.display.sections();
  std::set<int> placed;
  const QJsonArray columns = layout["columns"].toArray();
  for (const QJsonValue& stored : columns) {
    QSplitter* column = add_column();
    const QJsonArray tiles = stored.toObject()["tiles"].toArray();
    const QJsonArray looks = stored.toObject()["looks"].toArray();
    for (qsizetype n = 0; n < tiles.size(); ++n) {
      const int number = tiles[n].toInt(-2);
      if (number < -1 || number >= static_cast<int>(sections.size()) || !placed.insert(number).second)
        continue;
      ViewTile* tile = make_tile(number < 0 ? 0 : sections[static_cast<std::size_t>(number)].id);
      column->addWidget(tile);
      set_look(*tile, looks.at(n).toObject());
    }
    const QList<int> heights = sizes_from(stored.toObject()["heights"], column->count());
    if (!heights.isEmpty()) column->setSizes(heights);
  }
  if (columns.isEmpty()) add_column()->addWidget(make_tile(0));
  drop_empty_columns();
  sync_sections();
  const QList<int> widths = sizes_from(layout["widths"], columns_->count());
  columns_->setSizes(widths.isEmpty() ? QList<int>{550, 450} : widths);
  const auto all = tiles();
  if (!all.empty()) activate(all.front());
}

ViewTile* ViewArea::make_tile(Id section) {
  auto* tile = new ViewTile(workbench_, factories_, section);
  connect(tile, &ViewTile::action_asked, this, &ViewArea::action_asked);
  connect(tile, &ViewTile::maximise_asked, this, [this, tile] { maximise(tile); });
  // Later: the tile is still handling the click that asked.
  connect(
      tile, &ViewTile::close_asked, this, [this, tile] { close(tile); }, Qt::QueuedConnection);
  return tile;
}

QSplitter* ViewArea::add_column(int place) {
  auto* column = new QSplitter(Qt::Vertical);
  column->setHandleWidth(1);
  column->setChildrenCollapsible(false);
  columns_->insertWidget(place < 0 ? columns_->count() : place, column);
  return column;
}

QSplitter* ViewArea::column_of(const ViewTile* tile) const {
  return qobject_cast<QSplitter*>(tile->parentWidget());
}

// Where the active section stands, else the last column that holds no scene, else a new one.
QSplitter* ViewArea::column_for_sections() {
  if (active_section() != 0) return column_of(active_);
  for (int n = columns_->count() - 1; n >= 0; --n) {
    auto* column = qobject_cast<QSplitter*>(columns_->widget(n));
    const auto tiles = tiles_of(*column);
    if (std::ranges::none_of(tiles, [](const ViewTile* tile) { return tile->section() == 0; })) return column;
  }
  return add_column();
}

void ViewArea::drop_empty_columns() {
  for (int n = columns_->count() - 1; n >= 0; --n) {
    auto* column = qobject_cast<QSplitter*>(columns_->widget(n));
    if (column != nullptr && tiles_of(*column).empty()) {
      column->hide();
      column->setParent(this);
      column->deleteLater();
    }
  }
}

void ViewArea::sync_sections() {
  std::set<Id> missing;
  for (const Display::ShownSection& one : workbench_.display.sections()) missing.insert(one.id);
  for (ViewTile* tile : tiles()) {
    if (tile->section() != 0 && missing.erase(tile->section()) == 0) remove(tile);
  }
  for (const Id id : missing) {
    if (maximised_ != nullptr) maximise(maximised_);
    ViewTile* tile = make_tile(id);
    column_for_sections()->addWidget(tile);
    if (!is_built_) continue;  // all are new
    activate(tile);
    tile->view()->setFocus(Qt::OtherFocusReason);
  }
  show_what_there_is();
}

void ViewArea::remove(ViewTile* tile) {
  if (maximised_ == tile) maximise(tile);
  const bool was_active = tile == active_;
  if (was_active) active_ = nullptr;
  tile->hide();
  tile->setParent(this);  // so that it never outlives what it shows
  tile->deleteLater();
  drop_empty_columns();
  const auto left = tiles();
  show_what_there_is();
  if (was_active) activate(left.empty() ? nullptr : left.front());
  if (was_active && active_ == nullptr) Q_EMIT active_changed();
}

void ViewArea::focus_moved(QWidget* now) {
  for (QWidget* widget = now; widget != nullptr; widget = widget->parentWidget()) {
    auto* tile = qobject_cast<ViewTile*>(widget);
    if (tile != nullptr && isAncestorOf(tile)) return activate(tile);
  }
}

}  // namespace footwall::ui
