// The steps of the project's history as a list, oldest first, below a row for the state before all of them.
#pragma once
#include <QAbstractListModel>

#include "ui/model/document.h"

namespace footwall::ui {

class HistoryList final : public QAbstractListModel {
  Q_OBJECT

 public:
  // Besides the name: the step's number (0: before the first), whether it is undone, whether it is where the
  // project stands, and when it was made (local time, as text).
  enum Role { kStep = Qt::UserRole, kUndone, kCurrent, kWhen };

  explicit HistoryList(Document& document, QObject* parent = nullptr);

  // The row where the project stands.
  int current_row() const;

  int rowCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;

 Q_SIGNALS:
  // After each change of the history.
  void current_changed();

 private:
  void follow();

  Document& document_;
  std::vector<project::HistoryStep> steps_;
};

}  // namespace footwall::ui
