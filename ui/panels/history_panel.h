// The steps of the project's history; a click goes to one.
#pragma once
#include <QListView>

#include "ui/model/history_list.h"
#include "ui/model/workbench.h"

namespace footwall::ui {

class HistoryPanel final : public QListView {
  Q_OBJECT

 public:
  explicit HistoryPanel(Workbench& workbench, QWidget* parent = nullptr);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void go_to(const QModelIndex& index);
  void show_current();

  Workbench& workbench_;
  HistoryList* list_ = nullptr;
};

}  // namespace footwall::ui
