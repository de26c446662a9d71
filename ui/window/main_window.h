// The one window: menu, tool bar, docks, tiled views, status line. With a project it shows that, without one
// the start page.
#pragma once
#include <QJsonObject>
#include <QMainWindow>
#include <memory>
#include <vector>

#include "ui/model/workbench.h"

class QFileSystemWatcher;
class QLabel;
class QTimer;
class QVBoxLayout;

namespace footwall::ui {

class Actions;
class BannerArea;
class Docks;
class StatusLine;
class ToolBar;
class ViewArea;

class MainWindow final : public QMainWindow {
  Q_OBJECT

 public:
  // Without a project it shows the start page.
  explicit MainWindow(const EngineLink::Options& engine, QWidget* parent = nullptr);
  ~MainWindow() override;

  // Opens a project in the place of the one shown; where that fails a banner says why.
  bool open_project(const QString& path);
  // Stores how the window looked, and shows the start page. Everything else is on disk already.
  void close_project();
  // Null on the start page.
  Workbench* workbench() const { return workbench_.get(); }
  // Of the window rather than of a project: making one.
  Jobs& start_jobs() { return *start_jobs_; }

  Actions& actions() { return *actions_; }
  BannerArea& banners() { return *banners_; }
  Docks& docks() { return *docks_; }
  ViewArea* views() const { return views_; }  // null on the start page
  ToolBar* tool_bar() const { return tool_bar_; }
  StatusLine& status_line() { return *status_; }

  // What came by drag and drop, from the Import dialog or the command line: told from its content.
  void take_file(const QString& path);
  // A synthetic project with three faults at this path, made by a job, then opened.
  void make_demo(const QString& path);
  // Where the file of a volume went, by a job; volume: empty for the one that the file turns out to be.
  void relink(const QString& volume, const QString& file);
  // One line of what went wrong; goes by itself.
  void tell_failure(const QString& message, const QString& hint);
  // Whether all that the window shows has arrived: sections read, surfaces made, no job running.
  bool is_settled() const;

 protected:
  bool event(QEvent* event) override;
  void closeEvent(QCloseEvent* event) override;
  void changeEvent(QEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  void show_start_page();
  void show_workbench();
  void put_in_middle(QWidget* widget);
  void connect_workbench();
  void show_lasting_banners(const QString& held);
  void show_engine_banner();
  void show_read_only_banner(const QString& held);
  void show_surface_banner();
  void show_engine_state();
  void relink_missing(const QString& volume);
  void follow_changes();
  void store_look();
  void show_title();

  EngineLink::Options engine_;
  std::unique_ptr<Workbench> workbench_;
  Jobs* start_jobs_ = nullptr;
  Actions* actions_ = nullptr;
  BannerArea* banners_ = nullptr;
  Docks* docks_ = nullptr;
  ToolBar* tool_bar_ = nullptr;
  StatusLine* status_ = nullptr;
  ViewArea* views_ = nullptr;
  QWidget* middle_ = nullptr;
  QVBoxLayout* column_ = nullptr;
  QLabel* project_name_ = nullptr;
  QLabel* engine_state_ = nullptr;
  QFileSystemWatcher* watcher_ = nullptr;
  QTimer* follow_ = nullptr;
  bool section_failed_ = false;
  QJsonObject look_stored_;
};

}  // namespace footwall::ui
