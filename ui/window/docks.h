// The panels around the views: movable, closable, remembered with the project.
#pragma once
#include <QJsonObject>
#include <QObject>
#include <array>
#include <vector>

class QDockWidget;

namespace footwall::ui {

class MainWindow;
struct Workbench;

enum class Panel { kProject, kInspector, kJobs, kHistory };

class Docks final : public QObject {
  Q_OBJECT

 public:
  explicit Docks(MainWindow& window);

  // Null takes the panels away.
  void show_workbench(Workbench* workbench);
  QDockWidget* dock(Panel panel) const { return docks_[static_cast<std::size_t>(panel)]; }
  bool is_open(Panel panel) const;
  void open(Panel panel, bool on);
  // Opens it and gives it the keys; closes it where it has them.
  void step_to(Panel panel);
  // Hides those that are open; the next time shows the same again.
  void toggle_all();
  bool all_hidden() const;
  void put_back();  // where they are in a new project

  QJsonObject look() const;
  void restore(const QJsonObject& look);

 private:
  MainWindow& window_;
  std::array<QDockWidget*, 4> docks_{};
  std::vector<Panel> hidden_;  // by toggle_all()
};

}  // namespace footwall::ui
