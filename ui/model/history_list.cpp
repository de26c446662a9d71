#include "ui/model/history_list.h"

#include <QDateTime>
#include <algorithm>

namespace footwall::ui {

HistoryList::HistoryList(Document& document, QObject* parent)
    : QAbstractListModel(parent), document_(document), steps_(document.history()) {
  connect(&document_, &Document::history_changed, this, [this] {
    beginResetModel();
    steps_ = document_.history();
    endResetModel();
  });
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
