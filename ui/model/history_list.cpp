#include "ui/model/history_list.h"

#include <QDateTime>
#include <algorithm>
#include <iterator>

namespace footwall::ui {

HistoryList::HistoryList(Document& document, QObject* parent)
    : QAbstractListModel(parent), document_(document), steps_(document.history()) {
  connect(&document_, &Document::history_changed, this, &HistoryList::follow);
}

// Tells what differs: a view that lays out thousands of rows anew at every edit would be felt.
void HistoryList::follow() {
  const std::vector<project::HistoryStep>& now = document_.history();
  const auto same_step = [](const project::HistoryStep& a, const project::HistoryStep& b) {
    return a.id == b.id;
  };
  const auto kept = std::ranges::mismatch(steps_, now, same_step).in1 - steps_.begin();
  const int first = static_cast<int>(kept) + 1;  // below the row for the state before all steps
  if (kept < std::ssize(steps_)) {
    beginRemoveRows({}, first, rowCount() - 1);
    steps_.erase(steps_.begin() + kept, steps_.end());
    endRemoveRows();
  }
  std::vector<int> turned{current_row()};
  for (std::size_t n = 0; n < steps_.size(); ++n) {
    if (steps_[n].undone == now[n].undone) continue;
    steps_[n].undone = now[n].undone;
    turned.push_back(static_cast<int>(n) + 1);
  }
  if (kept < std::ssize(now)) {
    beginInsertRows({}, first, static_cast<int>(now.size()));
    steps_.insert(steps_.end(), now.begin() + kept, now.end());
    endInsertRows();
  }
  turned.push_back(current_row());
  const auto [low, high] = std::ranges::minmax(turned);
  Q_EMIT dataChanged(index(low), index(high));
  Q_EMIT current_changed();
}

int HistoryList::current_row() const {
  const auto first_undone = std::ranges::find(steps_, true, &project::HistoryStep::undone);
  return static_cast<int>(first_undone - steps_.begin());
}

int HistoryList::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(steps_.size()) + 1;
}

QVariant HistoryList::data(const QModelIndex& index, int role) const {
  if (!checkIndex(index, CheckIndexOption::IndexIsValid)) return {};
  const project::HistoryStep* step =
      index.row() == 0 ? nullptr : &steps_[static_cast<std::size_t>(index.row()) - 1];
  switch (role) {
    case Qt::DisplayRole:
      return step == nullptr ? tr("before the first edit") : QString::fromStdString(step->name);
    case kStep:
      return QVariant::fromValue<qlonglong>(step == nullptr ? 0 : step->id);
    case kUndone:
      return step != nullptr && step->undone;
    case kCurrent:
      return index.row() == current_row();
    case kWhen:
      if (step == nullptr) return QString();
      return QDateTime::fromString(QString::fromStdString(step->when), Qt::ISODate)
          .toLocalTime()
          .toString(QStringLiteral("yyyy-MM-dd HH:mm"));
    default:
      return {};
  }
}

}  // namespace footwall::ui
