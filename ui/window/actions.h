// Everything that the window can do, as one table: menus, tool bar, shortcuts, the list in Help and the tests
// come from it.
#pragma once
#include <QAction>
#include <QObject>
#include <map>
#include <span>
#include <vector>

class QMenuBar;

namespace footwall::ui {

class MainWindow;

enum class Menu { kFile, kEdit, kView, kSurvey, kFault, kCompute, kWindow, kHelp };

// What must be there for an action to make sense; they add up.
enum Needs : unsigned {
  kNothing = 0,
  kProject = 1,     // one is open
  kWriting = 2,     // for writing
  kSurvey = 4,      // with a survey
  kVolume = 8,      // and a volume
  kFault = 16,      // a fault is selected or active
  kTwoFaults = 32,  // several are selected
  kPillars = 64,    // pillars are selected, or are those of the selected faults
  kAnything = 128,  // something is selected that can be deleted
  kUndo = 256,      // there is a step to undo
  kRedo = 512,
  kView = 1024,        // a view is active
  kSection = 2048,     // it is a section
  kJob = 4096,         // a job runs
  kScene = 16384,      // the scene is open and built
  kPicked = 8192,      // pillars themselves are selected
  kNameable = 65536,   // what is selected belongs to something that can have another name
  kFaults = 131072,    // there are faults, selected or not
  kActive = 262144,    // picks go to a fault
  kShiftable = 32768,  // with the Select tool a face or pillars: what a suggested shift is of
  kLine = 1 << 20,     // the active view is a section along a line
  kRun = 1 << 21,      // a run is selected, or the faces show one
};

struct ActionRow {
  const char* id;  // "file.open"
  Menu menu;
  const char* name;       // as the menu has it, to be translated; & before the mnemonic
  const char* shortcuts;  // portable, several are parted by a blank; the first is shown
  const char* icon;       // of resources/icons
  const char* tip;        // what it does, one sentence, to be translated
  unsigned needs;
  void (*run)(MainWindow& window);
  bool (*checked)(MainWindow& window) =
      nullptr;                    // of a switch: whether it is on; asked only where `needs` are met
  bool starts_group = false;      // a line above it in the menu
  const char* submenu = nullptr;  // of the menu, to be translated; rows of the same one stand together
};

// In the order of the menus.
std::vector<ActionRow> action_table();

QString title_of(Menu menu);

class Actions final : public QObject {
  Q_OBJECT

 public:
  explicit Actions(MainWindow& window);

  const std::vector<ActionRow>& table() const { return table_; }
  // Null where there is no such row.
  QAction* action(const QString& id) const;
  void fill(QMenuBar& bar) const;
  // Enables and checks what the moment allows.
  void refresh();

 private:
  unsigned met() const;

  MainWindow& window_;
  std::vector<ActionRow> table_;
  std::map<QString, QAction*> actions_;
};

}  // namespace footwall::ui
