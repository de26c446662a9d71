#include "ui/window/main_window.h"

namespace footwall::ui {
MainWindow::MainWindow(const EngineLink::Options& engine, QWidget* parent) : QMainWindow(parent), engine_(engine) {}
MainWindow::~MainWindow() = default;
bool MainWindow::open_project(const QString& path) {
  QString held;
  workbench_ = open_workbench(path.toStdString(), engine_, &held);
  return true;
}
}  // namespace footwall::ui
