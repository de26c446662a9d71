// The one window: menu, tool bar, docks, tiled views, status bar.
#pragma once
#include <QMainWindow>
#include <memory>

#include "ui/model/workbench.h"

namespace footwall::ui {

class MainWindow final : public QMainWindow {
  Q_OBJECT

 public:
  // Without a project it shows the start page.
  explicit MainWindow(const EngineLink::Options& engine, QWidget* parent = nullptr);
  ~MainWindow() override;

  // Opens a project in the place of the one shown; where that fails a banner says why.
  bool open_project(const QString& path);
  // Null on the start page.
  Workbench* workbench() const { return workbench_.get(); }

 private:
  EngineLink::Options engine_;
  std::unique_ptr<Workbench> workbench_;
};

}  // namespace footwall::ui
