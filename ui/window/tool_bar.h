// The row under the menu: tools, views, what sections and faces show, and the one large button.
#pragma once
#include <QToolBar>
#include <QToolButton>

#include "ui/model/workbench.h"

namespace footwall::ui {

class Actions;

// An action as a button of the tool bar.
class ActionButton final : public QToolButton {
  Q_OBJECT

 public:
  // The icon; with the name; with its key in dim letters, too; or the name of the one button that stands out.
  enum class Shows { kIcon, kName, kKey, kProminent };
  ActionButton(QAction* action, Shows shows, QWidget* parent = nullptr);
  // In a narrow window: 1 leaves names out, 2 also those with their keys. The prominent one keeps its name.
  void set_narrowness(int narrowness);
  QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QString words() const;
  QString key() const;
  bool is_prominent() const { return shows_ == Shows::kProminent; }
  bool is_icon_alone() const;
  Shows shows_;
  int narrowness_ = 0;
};

class ToolBar final : public QToolBar {
  Q_OBJECT

 public:
  ToolBar(const Actions& actions, QWidget* parent = nullptr);
  // Null: no project.
  void show_workbench(Workbench* workbench);
  // Opens a choice's menu, for the keyboard.
  enum class Choice { kColours, kClip, kStatistic };
  void open(Choice choice);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void fit_into_width();
  QToolButton* add_choice(const QString& tip, const std::function<void(QMenu&)>& fill);
  void fill_colour_maps(QMenu& menu);
  void fill_statistics(QMenu& menu);
  void refresh();

  Workbench* workbench_ = nullptr;
  QToolButton* colours_ = nullptr;
  QToolButton* clip_ = nullptr;
  QToolButton* step_ = nullptr;
  QToolButton* statistic_ = nullptr;
};

}  // namespace footwall::ui
