// What the middle of the window shows while all views are closed: how to get one.
#pragma once
#include <QWidget>

#include "ui/model/workbench.h"

class QPushButton;

namespace footwall::ui {

class EmptyViews final : public QWidget {
  Q_OBJECT

 public:
  explicit EmptyViews(Workbench& workbench, QWidget* parent = nullptr);

 Q_SIGNALS:
  // action: of the window's table.
  void action_asked(const QString& action);

 private:
  QPushButton* add_button(const QString& text, const char* icon_name, const char* action);
  // Sections need a survey.
  void follow_survey();

  Workbench& workbench_;
  QPushButton* inline_ = nullptr;
  QPushButton* crossline_ = nullptr;
  QPushButton* import_ = nullptr;
};

}  // namespace footwall::ui
