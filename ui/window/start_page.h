// What the window shows without a project: the ways to one.
#pragma once
#include <QStringList>
#include <QWidget>

class QListWidget;
class QProgressBar;
class QLabel;

namespace footwall::ui {

class Actions;
class Jobs;

// Projects opened lately, newest first; kept among the user's settings.
QStringList recent_projects();
void remember_project(const QString& path);
void forget_project(const QString& path);

class StartPage final : public QWidget {
  Q_OBJECT

 public:
  // jobs: those of the window, whose newest running one is shown.
  StartPage(const Actions& actions, Jobs& jobs, QWidget* parent = nullptr);

 Q_SIGNALS:
  void open_asked(const QString& path);

 private:
  void list_recent();
  void show_job();

  Jobs& jobs_;
  QListWidget* recent_ = nullptr;
  QLabel* recent_title_ = nullptr;
  QWidget* job_ = nullptr;
  QLabel* job_text_ = nullptr;
  QProgressBar* job_bar_ = nullptr;
};

}  // namespace footwall::ui
