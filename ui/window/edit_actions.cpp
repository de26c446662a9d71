#include <QApplication>
#include <QDockWidget>

#include "ui/panels/project_panel.h"
#include "ui/window/action_groups.h"
#include "ui/window/dialogs.h"
#include "ui/window/docks.h"
#include "ui/window/main_window.h"

namespace footwall::ui {
namespace {

ProjectPanel* project_panel(MainWindow& window) {
  return qobject_cast<ProjectPanel*>(window.docks().dock(Panel::kProject)->widget());
}

void rename(MainWindow& window) {
  window.docks().open(Panel::kProject, true);
  if (ProjectPanel* panel = project_panel(window)) panel->rename_current();
}

void select_all(MainWindow& window) {
  std::set<Id> faults;
  for (const Fault& fault : window.workbench()->document.faults()) faults.insert(fault.record.id);
  window.workbench()->selection.select_all(faults, {}, {});
}

void leave(MainWindow& window) {
  Picking& picking = window.workbench()->picking;
  picking.key_press(Qt::Key_Escape, {});
  picking.set_tool(Tool::kSelect);
}

template <Tool kTool>
void choose(MainWindow& window) {
  window.workbench()->picking.set_tool(kTool);
}

template <Tool kTool>
bool is_chosen(MainWindow& window) {
  return window.workbench()->picking.tool() == kTool;
}

}  // namespace

std::vector<ActionRow> edit_actions() {
  using M = Menu;
  return {
      {"edit.undo", M::kEdit, QT_TRANSLATE_NOOP("Actions", "&Undo"), "Ctrl+Z", "undo",
       QT_TRANSLATE_NOOP("Actions", "Take back the last step of the history"), kUndo,
       [](MainWindow& window) { window.workbench()->document.undo(); }},
      {"edit.redo", M::kEdit, QT_TRANSLATE_NOOP("Actions", "&Redo"), "Ctrl+Shift+Z Ctrl+Y", "redo",
       QT_TRANSLATE_NOOP("Actions", "Do again what was taken back"), kRedo,
       [](MainWindow& window) { window.workbench()->document.redo(); }},
      {"edit.trim-history", M::kEdit, QT_TRANSLATE_NOOP("Actions", "Trim &history…"), "Ctrl+Alt+H", "history-trim",
       QT_TRANSLATE_NOOP("Actions", "Drop the oldest steps of the history for good, to make the project smaller"),
       kProject | kWriting, open_trim_history_dialog},
      {"edit.rename", M::kEdit, QT_TRANSLATE_NOOP("Actions", "Re&name"), "F2", "rename",
       QT_TRANSLATE_NOOP("Actions", "Give what is selected in the project panel another name"),
       kProject | kWriting, rename, nullptr, true},
      {"edit.delete", M::kEdit, QT_TRANSLATE_NOOP("Actions", "&Delete"), "Del", "delete",
       QT_TRANSLATE_NOOP("Actions", "Delete the selected faults, pillars or nodes; undo brings them back"),
       kProject | kWriting | kAnything,
       [](MainWindow& window) {
         if (ProjectPanel* panel = project_panel(window)) panel->delete_selected();
       }},
      {"edit.select-all", M::kEdit, QT_TRANSLATE_NOOP("Actions", "Select &all faults"), "Ctrl+A",
       "select-all", QT_TRANSLATE_NOOP("Actions", "Select every fault"), kProject, select_all},
      {"edit.select-none", M::kEdit, QT_TRANSLATE_NOOP("Actions", "Select n&othing"), "Ctrl+Shift+A",
       "select-none", QT_TRANSLATE_NOOP("Actions", "Select nothing"), kProject,
       [](MainWindow& window) { window.workbench()->selection.clear(); }},
      {"tool.select", M::kEdit, QT_TRANSLATE_NOOP("Actions", "&Select"), "S", "select",
       QT_TRANSLATE_NOOP("Actions", "Clicks select; a drag selects with a box or lasso"), kProject,
       choose<Tool::kSelect>, is_chosen<Tool::kSelect>, true},
      {"tool.pick", M::kEdit, QT_TRANSLATE_NOOP("Actions", "&Pick"), "P", "pick",
       QT_TRANSLATE_NOOP("Actions", "Clicks add nodes to pillars"), kProject | kWriting | kSurvey,
       choose<Tool::kPick>, is_chosen<Tool::kPick>},
      {"tool.move", M::kEdit, QT_TRANSLATE_NOOP("Actions", "&Move"), "M", "move",
       QT_TRANSLATE_NOOP("Actions", "Drags move nodes, pillars or all that is selected"),
       kProject | kWriting | kSurvey, choose<Tool::kMove>, is_chosen<Tool::kMove>},
      {"tool.leave", M::kEdit, QT_TRANSLATE_NOOP("Actions", "&Leave"), "Esc", "leave",
       QT_TRANSLATE_NOOP("Actions", "Leave what is under way with nothing changed, and select again"),
       kProject, leave},
  };
}

}  // namespace footwall::ui
