#include "ui/model/project_tree.h"

#include <QDateTime>
#include <QLocale>
#include <algorithm>
#include <set>
#include <utility>

#include "storage/base/log.h"
#include "ui/model/fault_commands.h"
#include "ui/model/shown_numbers.h"

namespace footwall::ui {
namespace {

QString dims_text(const std::array<std::int64_t, 3>& dims) {
  if (dims[0] == dims[1] && dims[1] == dims[2]) return QString::number(dims[0]) + QChar(0x00b3);
  return QStringLiteral("%1 × %2 × %3").arg(dims[0]).arg(dims[1]).arg(dims[2]);
}

// "14:02" of today, else the day.
QString time_text(const std::string& utc) {
  const QDateTime when = QDateTime::fromString(QString::fromStdString(utc), Qt::ISODate).toLocalTime();
  if (!when.isValid()) return {};
  const bool today = when.date() == QDate::currentDate();
  return today ? when.toString(QStringLiteral("HH:mm"))
               : QLocale().toString(when.date(), QLocale::ShortFormat);
}

bool same(const Item& a, const Item& b) {
  return a.kind == b.kind && a.id == b.id && a.name == b.name;
}

}  // namespace

std::string setting_of_view(const QString& name) {
  return "studio.view." + name.toStdString();
}

ProjectTree::ProjectTree(Document& document, Display& display, QObject* parent)
    : QAbstractItemModel(parent), document_(document), display_(display) {
  for (std::size_t group = 0; group < kGroups; ++group) groups_[group] = rows_now(static_cast<Group>(group));
  connect(&document_, &Document::volumes_changed, this, [this] { sync(kVolumes); });
  connect(&display_, &Display::samples_changed, this, [this] { sync(kVolumes); });
  connect(&document_, &Document::faults_changed, this, [this] { sync(kFaults); });
  connect(&document_, &Document::shapes_changed, this, [this](const std::set<Id>& faults) {
    // While a gesture is under way nothing stored has changed.
    if (std::ranges::any_of(faults, [this](Id fault) { return !document_.is_provisional(fault); }))
      sync(kFaults);
  });
  connect(&display_, &Display::visibility_changed, this, [this] { sync(kFaults); });
  connect(&display_, &Display::isosurfaces_changed, this, [this] { sync(kIsosurfaces); });
  connect(&document_, &Document::volumes_changed, this, [this] { sync(kIsosurfaces); });
  connect(&document_, &Document::runs_changed, this, [this] { sync(kRuns); });
  connect(&display_, &Display::faces_changed, this, [this] { sync(kRuns); });
  connect(&document_, &Document::views_changed, this, [this] { sync(kViews); });
}

std::vector<ProjectTree::Row> ProjectTree::rows_now(Group group) const {
  std::vector<Row> rows;
  const auto volume_name = [this](Id id) {
    const auto& volumes = document_.volumes();
    const auto found = std::ranges::find(volumes, id, &project::VolumeRecord::id);
    return found == volumes.end() ? tr("no volume") : QString::fromStdString(found->name);
  };
  try {
    switch (group) {
      case kVolumes:
        for (const project::VolumeRecord& volume : document_.volumes()) {
          rows.push_back({.item = {.kind = Item::Kind::kVolume, .id = volume.id},
                          .name = QString::fromStdString(volume.name),
                          .detail = dims_text(volume.dims),
                          .colour = {},
                          .checked = volume.id == display_.volume()});
        }
        break;
      case kFaults:
        for (const Fault& fault : document_.faults()) {
          const Item item{.kind = Item::Kind::kFault, .id = fault.record.id};
          const QString count = QString::number(fault.pillars.size());
          rows.push_back({.item = item,
                          .name = QString::fromStdString(fault.record.name),
                          .detail = fault.record.locked ? tr("locked  %1").arg(count) : count,
                          .colour = QColor(QString::fromStdString(fault.record.colour)),
                          .checked = display_.is_visible(item)});
        }
        break;
      case kIsosurfaces:
        for (const IsosurfaceLook& look : display_.isosurfaces()) {
          rows.push_back(
              {.item = {.kind = Item::Kind::kIsosurface, .id = look.id},
               .name =
                   !look.name.isEmpty()
                       ? look.name
                       : QStringLiteral("%1 = %2").arg(volume_name(look.volume)).arg(look.value, 0, 'g', 4),
               .detail = look.as_picture ? QString() : tr("mesh"),
               .colour = QColor(look.colour),
               .checked = look.visible});
        }
        break;
      case kRuns:
        for (const project::RunRecord& run : document_.project().runs()) {
          rows.push_back({.item = {.kind = Item::Kind::kRun, .id = run.id},
                          .name = name_of(run),
                          .detail = time_text(run.when),
                          .colour = {},
                          .checked = run.id == display_.faces().run});
        }
        break;
      case kViews:
        for (const project::ViewRecord& view : document_.project().views()) {
          const QString name = QString::fromStdString(view.name);
          rows.push_back(
              {.item = {.kind = Item::Kind::kView, .name = name}, .name = name, .detail = {}, .colour = {}});
        }
        break;
      case kGroups:
        break;
    }
  } catch (const Error& error) {
    log::warn("the list of the project is not whole: " + error.message());
  }
  return rows;
}

void ProjectTree::sync(Group group) {
  std::vector<Row>& shown = groups_[group];
  const std::vector<Row> now = rows_now(group);
  const QModelIndex top = heading(group);
  for (std::size_t n = shown.size(); n-- > 0;) {
    if (std::ranges::any_of(now, [&](const Row& row) { return same(row.item, shown[n].item); })) continue;
    beginRemoveRows(top, static_cast<int>(n), static_cast<int>(n));
    shown.erase(shown.begin() + static_cast<std::ptrdiff_t>(n));
    endRemoveRows();
  }
  for (std::size_t n = 0; n < now.size(); ++n) {
    const auto place = shown.begin() + static_cast<std::ptrdiff_t>(n);
    const auto found =
        std::find_if(place, shown.end(), [&](const Row& row) { return same(row.item, now[n].item); });
    if (found == shown.end()) {
      beginInsertRows(top, static_cast<int>(n), static_cast<int>(n));
      shown.insert(place, now[n]);
      endInsertRows();
      continue;
    }
    const auto from = static_cast<int>(found - shown.begin());
    if (from != static_cast<int>(n)) {
      beginMoveRows(top, from, from, top, static_cast<int>(n));
      std::rotate(place, found, found + 1);
      endMoveRows();
    }
    if (shown[n] == now[n]) continue;
    shown[n] = now[n];
    const QModelIndex changed = index(static_cast<int>(n), 0, top);
    Q_EMIT dataChanged(changed, changed);
  }
}

Item ProjectTree::item_of(const QModelIndex& index) const {
  if (!index.isValid() || index.internalId() == 0) return {};
  const std::vector<Row>& rows = groups_[index.internalId() - 1];
  const auto row = static_cast<std::size_t>(index.row());
  return row < rows.size() ? rows[row].item : Item{};
}

QModelIndex ProjectTree::index_of(const Item& item) const {
  for (std::size_t group = 0; group < kGroups; ++group) {
    const std::vector<Row>& rows = groups_[group];
    const auto found = std::ranges::find_if(rows, [&](const Row& row) { return same(row.item, item); });
    if (found != rows.end()) {
      return createIndex(static_cast<int>(found - rows.begin()), 0, static_cast<quintptr>(group + 1));
    }
  }
  return {};
}

bool ProjectTree::remove(const std::vector<Item>& items) {
  Removed removed;
  std::set<Id> faults;
  bool any = false;
  for (const Item& item : items) {
    if (item.kind == Item::Kind::kFault) faults.insert(item.id);
    if (item.kind == Item::Kind::kIsosurface) any = remove_isosurface(item.id, removed) || any;
    if (item.kind == Item::Kind::kVolume) any = remove_volume(item.id) || any;
    if (item.kind == Item::Kind::kView) any = remove_view(item.name, removed) || any;
  }
  if (!removed.empty()) {
    removed_ = std::move(removed);
    Q_EMIT removed_changed();
  }
  return (!faults.empty() && delete_items(document_, faults, {}, {})) || any;
}

bool ProjectTree::remove_isosurface(Id isosurface, Removed& removed) {
  const auto& all = display_.isosurfaces();
  const auto found = std::ranges::find(all, isosurface, &IsosurfaceLook::id);
  if (found == all.end()) return false;
  removed.isosurfaces.push_back(*found);
  display_.remove_isosurface(isosurface);
  return true;
}

// What it shows stays in its setting, which only a view of the same name reads.
bool ProjectTree::remove_view(const QString& name, Removed& removed) {
  try {
    const project::ViewRecord view = document_.project().view(name.toStdString());
    document_.store().delete_view(view.name);
    removed.views.push_back(view);
  } catch (const Error& error) {
    tell(error);
    return false;
  }
  Q_EMIT document_.views_changed();
  return true;
}

void ProjectTree::put_back() {
  const Removed removed = std::exchange(removed_, {});
  for (const IsosurfaceLook& look : removed.isosurfaces) display_.put_back_isosurface(look);
  try {
    const std::vector<project::ViewRecord> now = document_.project().views();
    for (const project::ViewRecord& view : removed.views) {
      // A newer one of the same name is what the user wants by now.
      if (std::ranges::find(now, view.name, &project::ViewRecord::name) == now.end())
        document_.store().save_view(view);
    }
  } catch (const Error& error) {
    tell(error);
  }
  if (!removed.views.empty()) Q_EMIT document_.views_changed();
  Q_EMIT removed_changed();
}

bool ProjectTree::remove_volume(Id volume) {
  try {
    document_.store().delete_volume(volume);
  } catch (const Error& error) {
    tell(error);
    return false;
  }
  document_.reload_volumes();  // what shows it turns to another one
  for (const IsosurfaceLook& look : std::vector<IsosurfaceLook>(display_.isosurfaces())) {
    if (look.volume == volume) display_.remove_isosurface(look.id);
  }
  return true;
}

void ProjectTree::tell(const Error& error) {
  Q_EMIT document_.failed(QString::fromStdString(error.message()), QString::fromStdString(error.hint()));
}

QModelIndex ProjectTree::heading(Group group) const {
  return createIndex(static_cast<int>(group), 0, static_cast<quintptr>(0));
}

// internalId: 0 for a heading, else 1 + its group.
QModelIndex ProjectTree::index(int row, int column, const QModelIndex& parent) const {
  if (!hasIndex(row, column, parent)) return {};
  if (!parent.isValid()) return createIndex(row, column, static_cast<quintptr>(0));
  return createIndex(row, column, static_cast<quintptr>(parent.row()) + 1);
}

QModelIndex ProjectTree::parent(const QModelIndex& child) const {
  if (!child.isValid() || child.internalId() == 0) return {};
  return heading(static_cast<Group>(child.internalId() - 1));
}

int ProjectTree::rowCount(const QModelIndex& parent) const {
  if (!parent.isValid()) return static_cast<int>(kGroups);
  if (parent.internalId() != 0 || parent.column() != 0) return 0;
  return static_cast<int>(groups_[static_cast<std::size_t>(parent.row())].size());
}

int ProjectTree::columnCount(const QModelIndex&) const {
  return 1;
}

QVariant ProjectTree::data(const QModelIndex& index, int role) const {
  if (!checkIndex(index, CheckIndexOption::IndexIsValid)) return {};
  if (index.internalId() == 0) {
    const std::array names{tr("Volumes"), tr("Faults"), tr("Isosurfaces"), tr("Runs"), tr("Views")};
    if (role == Qt::DisplayRole) return names[static_cast<std::size_t>(index.row())];
    return {};
  }
  const auto group = static_cast<Group>(index.internalId() - 1);
  const Row& row = groups_[group][static_cast<std::size_t>(index.row())];
  switch (role) {
    case Qt::DisplayRole:
    case Qt::EditRole:
      return row.name;
    case Qt::CheckStateRole:
      if (!has_check(group)) return {};
      return static_cast<int>(row.checked ? Qt::Checked : Qt::Unchecked);
    case kColour:
      return row.colour.isValid() ? QVariant(row.colour) : QVariant();
    case kDetail:
      return row.detail;
    default:
      return {};
  }
}

Qt::ItemFlags ProjectTree::flags(const QModelIndex& index) const {
  if (!index.isValid()) return Qt::NoItemFlags;
  if (index.internalId() == 0) return Qt::ItemIsEnabled;
  const auto group = static_cast<Group>(index.internalId() - 1);
  Qt::ItemFlags flags = Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemNeverHasChildren;
  if (has_check(group)) flags |= Qt::ItemIsUserCheckable;
  if (!document_.read_only()) flags |= Qt::ItemIsEditable;
  return flags;
}

bool ProjectTree::setData(const QModelIndex& index, const QVariant& value, int role) {
  if (!checkIndex(index, CheckIndexOption::IndexIsValid) || index.internalId() == 0) return false;
  // A copy: what is told meanwhile changes the rows.
  const Row row = groups_[index.internalId() - 1][static_cast<std::size_t>(index.row())];
  if (role == Qt::CheckStateRole) return show(row, value.toInt() == Qt::Checked);
  if (role == Qt::EditRole) return rename(row, value.toString().trimmed());
  return false;
}

bool ProjectTree::rename(const Row& row, const QString& name) {
  if (name == row.name) return false;
  switch (row.item.kind) {
    case Item::Kind::kFault:
      return rename_fault(document_, row.item.id, name);
    case Item::Kind::kVolume:
      return rename_volume(row.item.id, name);
    case Item::Kind::kIsosurface:
      return rename_isosurface(row.item.id, name);
    case Item::Kind::kRun:
      return rename_run(row.item.id, name);
    case Item::Kind::kView:
      return rename_view(row.name, name);
    default:
      return false;
  }
}

// Without a name it is called after its volume and value again.
bool ProjectTree::rename_isosurface(Id isosurface, const QString& name) {
  const auto& all = display_.isosurfaces();
  const auto found = std::ranges::find(all, isosurface, &IsosurfaceLook::id);
  if (found == all.end()) return false;
  IsosurfaceLook look = *found;
  look.name = name;
  display_.change_isosurface(look);
  return true;
}

bool ProjectTree::rename_volume(Id volume, const QString& name) {
  const auto& volumes = document_.volumes();
  const auto found = std::ranges::find(volumes, volume, &project::VolumeRecord::id);
  if (found == volumes.end()) return false;
  project::VolumeRecord record = *found;
  record.name = name.toStdString();
  try {
    document_.store().update_volume(record);
  } catch (const Error& error) {
    tell(error);
    return false;
  }
  document_.reload_volumes();
  return true;
}

bool ProjectTree::rename_run(Id run, const QString& name) {
  try {
    document_.store().rename_run(run, name.toStdString());
  } catch (const Error& error) {
    tell(error);
    return false;
  }
  Q_EMIT document_.runs_changed();
  return true;
}

bool ProjectTree::rename_view(const QString& former, const QString& name) {
  try {
    project::Project& project = document_.store();
    for (const project::ViewRecord& other : project.views()) {
      if (QString::fromStdString(other.name) != name) continue;
      Q_EMIT document_.failed(tr("there is a view %1 already").arg(name), tr("choose another name"));
      return false;
    }
    project::ViewRecord view = project.view(former.toStdString());
    view.name = name.toStdString();
    project.save_view(view);
    const auto shown = project.setting(setting_of_view(former));
    if (shown) project.set_setting(setting_of_view(name), *shown);
    project.delete_view(former.toStdString());
  } catch (const Error& error) {
    tell(error);
    return false;
  }
  Q_EMIT document_.views_changed();
  return true;
}

// Of volumes one is shown: a check mark moves, and none can be taken away. Of runs one or none.
bool ProjectTree::show(const Row& row, bool on) {
  if (row.item.kind == Item::Kind::kVolume) {
    if (on) display_.set_volume(row.item.id);
    return on;
  }
  if (row.item.kind == Item::Kind::kRun) {
    display_.show_run(on ? row.item.id : 0);
    return true;
  }
  if (row.item.kind == Item::Kind::kFault) {
    display_.set_visible(row.item, on);
    return true;
  }
  const auto& all = display_.isosurfaces();
  const auto found = std::ranges::find(all, row.item.id, &IsosurfaceLook::id);
  if (found == all.end()) return false;
  IsosurfaceLook look = *found;
  look.visible = on;
  display_.change_isosurface(look);
  return true;
}

}  // namespace footwall::ui
