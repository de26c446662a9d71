#include <QApplication>
#include <QDockWidget>
#include <QInputDialog>
#include <optional>

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
  if (window.workbench()->line.is_active()) return window.workbench()->line.end();
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

Display& display(MainWindow& window) {
  return window.workbench()->display;
}

void set_step(MainWindow& window) {
  bool ok = false;
  const int lines = QInputDialog::getInt(
      &window, QCoreApplication::translate("Actions", "Step"),
      QCoreApplication::translate("Actions", "Lines that X and Z move by (0: 10 while picking, else 1):"),
      display(window).own_step().value_or(0), 0, 100000, 1, &ok);
  if (ok) display(window).set_own_step(lines == 0 ? std::nullopt : std::optional(lines));
}

// A row of the menu of mouse presets.
template <std::size_t kPreset>
ActionRow mouse_row(const char* id, const char* name, const char* key, const char* tip) {
  return {id,
          Menu::kEdit,
          name,
          key,
          "mouse",
          tip,
          kProject,
          [](MainWindow& window) {
            window.workbench()->mouse.choose(QLatin1String(mouse_presets()[kPreset].name));
          },
          [](MainWindow& window) { return &window.workbench()->mouse.preset() == &mouse_presets()[kPreset]; },
          false,
          QT_TRANSLATE_NOOP("Actions", "Mo&use")};
}

std::vector<ActionRow> tool_actions() {
  using M = Menu;
  constexpr unsigned kPicks = kProject | kSurvey;
  return {
      {"pick.snap-section", M::kEdit, QT_TRANSLATE_NOOP("Actions", "Snap to section"), "Shift+G",
       "snap-section",
       QT_TRANSLATE_NOOP("Actions", "A node that is moved comes to lie exactly on the section"), kPicks,
       [](MainWindow& window) {
         display(window).set_snapping(!display(window).snaps_to_section(),
                                      display(window).snaps_to_samples());
       },
       [](MainWindow& window) { return display(window).snaps_to_section(); }, true},
      {"pick.snap-samples", M::kEdit, QT_TRANSLATE_NOOP("Actions", "Snap to samples"), "G", "snap-samples",
       QT_TRANSLATE_NOOP("Actions", "Picked and moved nodes come to lie on samples"), kPicks,
       [](MainWindow& window) {
         display(window).set_snapping(display(window).snaps_to_section(),
                                      !display(window).snaps_to_samples());
       },
       [](MainWindow& window) { return display(window).snaps_to_samples(); }},
      {"pick.step-after", M::kEdit, QT_TRANSLATE_NOOP("Actions", "Step after each pillar"), "Alt+X",
       "step-after",
       QT_TRANSLATE_NOOP("Actions", "The section moves on by the step when a pillar on it is ended"), kPicks,
       [](MainWindow& window) {
         display(window).set_steps_after_pillar(!display(window).steps_after_pillar());
       },
       [](MainWindow& window) { return display(window).steps_after_pillar(); }},
      {"pick.step", M::kEdit, QT_TRANSLATE_NOOP("Actions", "Step…"), "Ctrl+Alt+X", "step",
       QT_TRANSLATE_NOOP("Actions", "How many lines X and Z move by"), kPicks, set_step},
      mouse_row<0>("mouse.footwall", QT_TRANSLATE_NOOP("Actions", "&Footwall"), "Ctrl+Alt+1",
                   QT_TRANSLATE_NOOP("Actions", "The middle button pans sections and turns the scene")),
      mouse_row<1>("mouse.opendtect", QT_TRANSLATE_NOOP("Actions", "&OpendTect"), "Ctrl+Alt+2",
                   QT_TRANSLATE_NOOP("Actions", "The middle button pans, the right one turns the scene")),
      mouse_row<2>("mouse.petrel", QT_TRANSLATE_NOOP("Actions", "&Petrel-like"), "Ctrl+Alt+3",
                   QT_TRANSLATE_NOOP("Actions",
                                     "Middle and right button pan sections, the right one turns the scene")),
      mouse_row<3>("mouse.landmark", QT_TRANSLATE_NOOP("Actions", "&Landmark"), "Ctrl+Alt+4",
                   QT_TRANSLATE_NOOP("Actions", "The wheel steps through lines, the right button zooms")),
  };
}

std::vector<ActionRow> first_actions() {
  using M = Menu;
  return {
      {"edit.undo", M::kEdit, QT_TRANSLATE_NOOP("Actions", "&Undo"), "Ctrl+Z", "undo",
       QT_TRANSLATE_NOOP("Actions", "Take back the last step of the history"), kUndo,
       [](MainWindow& window) { window.workbench()->document.undo(); }},
      {"edit.redo", M::kEdit, QT_TRANSLATE_NOOP("Actions", "&Redo"), "Ctrl+Shift+Z Ctrl+Y", "redo",
       QT_TRANSLATE_NOOP("Actions", "Do again what was taken back"), kRedo,
       [](MainWindow& window) { window.workbench()->document.redo(); }},
      {"edit.trim-history", M::kEdit, QT_TRANSLATE_NOOP("Actions", "Trim &history…"), "Ctrl+Alt+H",
       "history-trim",
       QT_TRANSLATE_NOOP("Actions",
                         "Drop the oldest steps of the history for good, to make the project smaller"),
       kProject | kWriting, open_trim_history_dialog},
      {"edit.rename", M::kEdit, QT_TRANSLATE_NOOP("Actions", "Re&name"), "F2", "rename",
       QT_TRANSLATE_NOOP("Actions", "Give the selected fault, volume, isosurface, run or view another name"),
       kProject | kWriting | kNameable, rename, nullptr, true},
      {"edit.delete", M::kEdit, QT_TRANSLATE_NOOP("Actions", "&Delete"), "Del", "delete",
       QT_TRANSLATE_NOOP("Actions", "Delete what is selected; undo, or a banner, brings it back"),
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

}  // namespace

std::vector<ActionRow> edit_actions() {
  std::vector<ActionRow> all = first_actions();
  for (const ActionRow& row : tool_actions()) all.push_back(row);
  return all;
}

}  // namespace footwall::ui
