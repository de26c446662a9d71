#include <QApplication>
#include <QDialog>
#include <QMessageBox>
#include <algorithm>

#include "ui/window/action_groups.h"
#include "ui/window/docks.h"
#include "ui/window/help_window.h"
#include "ui/window/main_window.h"
#include "ui/window/theme.h"
#include "ui/window/view_area.h"
#include "ui/window/view_tile.h"

namespace footwall::ui {
namespace {

QString translated(const char* text) {
  return QCoreApplication::translate("Actions", text);
}

template <Panel kPanel>
void step_to(MainWindow& window) {
  window.docks().step_to(kPanel);
}

template <Panel kPanel>
bool is_open(MainWindow& window) {
  return window.docks().is_open(kPanel);
}

void toggle_linked(MainWindow& window) {
  Display& display = window.workbench()->display;
  const auto& all = display.sections();
  const auto shown = std::ranges::find(all, window.views()->active_section(), &Display::ShownSection::id);
  if (shown == all.end()) return;
  Display::ShownSection changed = *shown;
  changed.linked = !changed.linked;
  display.change_section(changed);
}

bool is_linked(MainWindow& window) {
  const auto& all = window.workbench()->display.sections();
  const auto shown = std::ranges::find(all, window.views()->active_section(), &Display::ShownSection::id);
  return shown != all.end() && shown->linked;
}

HelpWindow& help_of(MainWindow& window) {
  auto* help = window.findChild<HelpWindow*>();
  return help != nullptr ? *help : *new HelpWindow(&window);
}

void about(MainWindow& window) {
  help_of(window).show_text(translated("About"),
                            translated("# Footwall Studio %1\n\nA fault interpretation workbench for 3D "
                                       "seismic data.\n\nFree software under "
                                       "the GNU General Public License, version 3 or later. Made with Qt %2.")
                                .arg(QStringLiteral(FOOTWALL_VERSION), QString::fromLatin1(qVersion())));
}

}  // namespace

std::vector<ActionRow> window_actions() {
  using M = Menu;
  return {
      {"window.docks", M::kWindow, QT_TRANSLATE_NOOP("Actions", "&Hide panels"), "F9", "docks",
       QT_TRANSLATE_NOOP("Actions", "Hide all panels, or show them again"), kProject,
       [](MainWindow& window) { window.docks().toggle_all(); },
       [](MainWindow& window) { return window.docks().all_hidden(); }},
      {"window.project", M::kWindow, QT_TRANSLATE_NOOP("Actions", "&Project"), "Alt+1", "dock-project",
       QT_TRANSLATE_NOOP("Actions", "Go to the project panel; from there, close it"), kProject,
       step_to<Panel::kProject>, is_open<Panel::kProject>},
      {"window.inspector", M::kWindow, QT_TRANSLATE_NOOP("Actions", "&Inspector"), "Alt+2", "dock-inspector",
       QT_TRANSLATE_NOOP("Actions", "Go to the inspector; from there, close it"), kProject,
       step_to<Panel::kInspector>, is_open<Panel::kInspector>},
      {"window.jobs", M::kWindow, QT_TRANSLATE_NOOP("Actions", "&Jobs"), "Alt+3", "dock-jobs",
       QT_TRANSLATE_NOOP("Actions", "Go to the list of jobs; from there, close it"), kProject,
       step_to<Panel::kJobs>, is_open<Panel::kJobs>},
      {"window.history", M::kWindow, QT_TRANSLATE_NOOP("Actions", "Histor&y"), "Alt+4", "dock-history",
       QT_TRANSLATE_NOOP("Actions", "Go to the history; from there, close it"), kProject,
       step_to<Panel::kHistory>, is_open<Panel::kHistory>},
      {"window.put-back", M::kWindow, QT_TRANSLATE_NOOP("Actions", "Put panels &back"), "Alt+0", "layout",
       QT_TRANSLATE_NOOP("Actions", "All panels where they are in a new project"), kProject,
       [](MainWindow& window) { window.docks().put_back(); }},
      {"window.maximise", M::kWindow, QT_TRANSLATE_NOOP("Actions", "&Maximise view"), "F10", "maximise",
       QT_TRANSLATE_NOOP("Actions", "The active view fills the middle of the window, or goes back"),
       kProject | kView, [](MainWindow& window) { window.views()->maximise(window.views()->active()); },
       [](MainWindow& window) { return window.views()->maximised() != nullptr; }, true},
      {"window.next-view", M::kWindow, QT_TRANSLATE_NOOP("Actions", "&Next view"), "Ctrl+Tab F6", "next-view",
       QT_TRANSLATE_NOOP("Actions", "Keys go to the next view"), kProject | kView,
       [](MainWindow& window) { window.views()->activate_next(1); }},
      {"window.previous-view", M::kWindow, QT_TRANSLATE_NOOP("Actions", "Pre&vious view"),
       "Ctrl+Shift+Tab Shift+F6", "next-view", QT_TRANSLATE_NOOP("Actions", "Keys go to the previous view"),
       kProject | kView, [](MainWindow& window) { window.views()->activate_next(-1); }},
      {"window.column", M::kWindow, QT_TRANSLATE_NOOP("Actions", "View in its own &column"),
       "Ctrl+Shift+Right", "layout",
       QT_TRANSLATE_NOOP("Actions", "The active view gets a column of its own, or joins the one at its left"),
       kProject | kView,
       [](MainWindow& window) { window.views()->move_to_own_column(window.views()->active()); }},
      {"window.close-view", M::kWindow, QT_TRANSLATE_NOOP("Actions", "C&lose view"), "Ctrl+Shift+W",
       "close-view", QT_TRANSLATE_NOOP("Actions", "Close the active view"), kProject | kView,
       [](MainWindow& window) { window.views()->close(window.views()->active()); }},
      {"window.linked", M::kWindow, QT_TRANSLATE_NOOP("Actions", "Lin&ked"), "L", "link",
       QT_TRANSLATE_NOOP("Actions",
                         "The active section shares cursor, zoom and place with the other linked ones"),
       kProject | kSection, toggle_linked, is_linked},
      {"window.theme", M::kWindow, QT_TRANSLATE_NOOP("Actions", "&Dark theme"), "Ctrl+Shift+L", "theme",
       QT_TRANSLATE_NOOP("Actions", "Dark or light"), kNothing,
       [](MainWindow&) { apply_theme(current_theme() == Theme::kDark ? Theme::kLight : Theme::kDark); },
       [](MainWindow&) { return current_theme() == Theme::kDark; }, true},
      {"window.full-screen", M::kWindow, QT_TRANSLATE_NOOP("Actions", "&Full screen"), "F11", "full-screen",
       QT_TRANSLATE_NOOP("Actions", "The window fills the screen, or goes back"), kNothing,
       [](MainWindow& window) { window.setWindowState(window.windowState() ^ Qt::WindowFullScreen); },
       [](MainWindow& window) { return window.isFullScreen(); }},
  };
}

std::vector<ActionRow> help_actions() {
  using M = Menu;
  return {
      {"help.guide", M::kHelp, QT_TRANSLATE_NOOP("Actions", "&Guide"), "F1", "help",
       QT_TRANSLATE_NOOP("Actions", "How to do what"), kNothing,
       [](MainWindow& window) { help_of(window).show_guide(); }},
      {"help.shortcuts", M::kHelp, QT_TRANSLATE_NOOP("Actions", "&Shortcuts"), "Ctrl+/", "keys",
       QT_TRANSLATE_NOOP("Actions", "A list of everything that the window can do, with its keys"), kNothing,
       [](MainWindow& window) {
         help_of(window).show_text(translated("Shortcuts"), shortcut_list(window.actions()));
       }},
      {"help.about", M::kHelp, QT_TRANSLATE_NOOP("Actions", "&About"), "Ctrl+F1", "about",
       QT_TRANSLATE_NOOP("Actions", "Version and licence"), kNothing, about},
  };
}

}  // namespace footwall::ui
