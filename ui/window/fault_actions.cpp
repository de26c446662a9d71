#include <QColorDialog>
#include <QCoreApplication>
#include <QInputDialog>
#include <algorithm>
#include <functional>

#include "engine/tasks/triangulate.h"
#include "ui/model/fault_commands.h"
#include "ui/model/project_job.h"
#include "ui/window/action_groups.h"
#include "ui/window/dialogs.h"
#include "ui/window/main_window.h"

namespace footwall::ui {
namespace {

QString translated(const char* text) {
  return QCoreApplication::translate("Actions", text);
}

Document& document(MainWindow& window) {
  return window.workbench()->document;
}

// The selected faults, else the active one.
std::set<Id> chosen_faults(MainWindow& window) {
  const Selection& selection = window.workbench()->selection;
  if (!selection.faults().empty()) return selection.faults();
  if (selection.active_fault() != 0) return {selection.active_fault()};
  return {};
}

// The selected pillars, else all of the selected faults.
std::set<Id> chosen_pillars(MainWindow& window) {
  const Selection& selection = window.workbench()->selection;
  if (!selection.pillars().empty()) return selection.pillars();
  std::set<Id> pillars;
  for (const Id fault : selection.faults()) {
    const Fault* one = document(window).fault(fault);
    if (one == nullptr) continue;
    for (const survey::Pillar& pillar : one->pillars) pillars.insert(pillar.id);
  }
  return pillars;
}

void make_fault(MainWindow& window) {
  const Id made = new_fault(document(window));
  if (made != 0) window.workbench()->selection.select({.kind = Item::Kind::kFault, .id = made});
}

// The pillar under way ends as by Esc, but the tool stays: the next pick starts an unassigned one.
void leave_fault(MainWindow& window) {
  Workbench& bench = *window.workbench();
  const Tool tool = bench.picking.tool();
  bench.picking.set_tool(tool);  // puts back what the hand is doing
  bench.picking.key_press(Qt::Key_Escape, {});
  bench.picking.set_tool(tool);
  bench.selection.clear();
  bench.selection.set_active_fault(0);
}

void choose_colour(MainWindow& window) {
  const std::set<Id> faults = chosen_faults(window);
  const Fault* first = document(window).fault(*faults.begin());
  const QColor now(first == nullptr ? QString() : QString::fromStdString(first->record.colour));
  const QColor colour = QColorDialog::getColor(now, &window, translated("Colour of the fault"));
  if (colour.isValid()) set_fault_colour(document(window), faults, colour.name());
}

bool all_locked(MainWindow& window) {
  const std::set<Id> faults = chosen_faults(window);
  return !faults.empty() && std::ranges::all_of(faults, [&](Id id) {
    const Fault* fault = document(window).fault(id);
    return fault != nullptr && fault->record.locked;
  });
}

void merge(MainWindow& window) {
  std::set<Id> others = window.workbench()->selection.faults();
  const Id active = window.workbench()->selection.active_fault();
  const Id into = others.contains(active) ? active : *others.begin();
  others.erase(into);
  merge_faults(document(window), into, others);
}

void split(MainWindow& window) {
  const Id made = split_fault(document(window), window.workbench()->selection.pillars());
  if (made != 0) window.workbench()->selection.select({.kind = Item::Kind::kFault, .id = made});
}

void assign(MainWindow& window) {
  QStringList names;
  for (const Fault& fault : document(window).faults())
    names.append(QString::fromStdString(fault.record.name));
  names.append(translated("A new fault"));
  bool ok = false;
  const QString name = QInputDialog::getItem(&window, translated("Assign pillars"),
                                             translated("The selected pillars go to:"), names, 0, false, &ok);
  if (!ok) return;
  const qsizetype place = names.indexOf(name);
  if (place == names.size() - 1) return split(window);
  assign_pillars(document(window), window.workbench()->selection.pillars(),
                 document(window).faults()[static_cast<std::size_t>(place)].record.id);
}

void resample(MainWindow& window) {
  bool ok = false;
  const int nodes =
      QInputDialog::getInt(&window, translated("Resample pillars"),
                           translated("Nodes along each pillar, evenly spaced:"), 8, 2, 1000, 1, &ok);
  if (ok) resample_pillars(document(window), chosen_pillars(window), nodes);
}

void resample_to_spacing(MainWindow& window) {
  bool ok = false;
  const double metres = QInputDialog::getDouble(&window, translated("Resample to spacing"),
                                                translated("Metres between nodes along each pillar:"), 100,
                                                0.1, 100000, 1, &ok);
  if (ok) resample_by_spacing(document(window), chosen_pillars(window), metres);
}

using FaultTask = std::function<void(project::Project&, const project::FaultRecord&, const JobContext&)>;

// A task of the engine's that edits the project itself, for each chosen fault, as a job.
void for_faults(MainWindow& window, const QString& title, const FaultTask& task) {
  std::vector<Id> faults;
  for (const Id id : chosen_faults(window)) {
    const Fault* fault = document(window).fault(id);
    if (fault != nullptr && !is_unassigned(*fault)) faults.push_back(id);
  }
  try {
    start_on_project(*window.workbench(), title,
                     [faults, task](project::Project& project, const JobContext& job) {
                       const auto share = [&](std::size_t n) {
                         return static_cast<double>(n) / static_cast<double>(faults.size());
                       };
                       for (std::size_t n = 0; n < faults.size(); ++n)
                         task(project, project.fault(faults[n]), job.part(share(n), share(n + 1)));
                     });
  } catch (const Error& error) {
    window.tell_failure(QString::fromStdString(error.message()), QString::fromStdString(error.hint()));
  }
}

void interpolate(MainWindow& window) {
  bool ok = false;
  const double every = QInputDialog::getDouble(&window, translated("Interpolate pillars"),
                                               translated("Lines between pillars:"), 10, 1, 10000, 0, &ok);
  if (!ok) return;
  for_faults(window, translated("Interpolate pillars"),
             [every](project::Project& project, const project::FaultRecord& fault, const JobContext& job) {
               tasks::interpolate_fault(project, fault, {.every = every, .tolerance = {}}, job);
             });
}

void drop_interpolated(MainWindow& window) {
  for_faults(window, translated("Drop interpolated pillars"),
             [](project::Project& project, const project::FaultRecord& fault, const JobContext&) {
               tasks::remove_interpolated(project, fault);
             });
}

}  // namespace

std::vector<ActionRow> fault_actions() {
  using M = Menu;
  constexpr unsigned kEdit = kProject | kWriting;
  return {
      {"fault.new", M::kFault, QT_TRANSLATE_NOOP("Actions", "&New fault"), "Shift+N", "fault-new",
       QT_TRANSLATE_NOOP("Actions", "Make a fault; picks go to it from now on"), kEdit, make_fault},
      {"fault.none", M::kFault, QT_TRANSLATE_NOOP("Actions", "No active fault"), "Shift+Esc", "fault-none",
       QT_TRANSLATE_NOOP("Actions", "Select nothing; picks go to unassigned pillars from now on"),
       kEdit | kActive, leave_fault},
      {"fault.colour", M::kFault, QT_TRANSLATE_NOOP("Actions", "&Colour…"), "Ctrl+Shift+C", "palette",
       QT_TRANSLATE_NOOP("Actions", "Another colour for the selected faults"), kEdit | kFault, choose_colour},
      {"fault.lock", M::kFault, QT_TRANSLATE_NOOP("Actions", "&Lock"), "Ctrl+L", "lock",
       QT_TRANSLATE_NOOP("Actions", "Locked faults cannot be edited"), kEdit | kFault,
       [](MainWindow& window) { lock_faults(document(window), chosen_faults(window), !all_locked(window)); },
       all_locked},
      {"fault.merge", M::kFault, QT_TRANSLATE_NOOP("Actions", "&Merge"), "Ctrl+M", "merge",
       QT_TRANSLATE_NOOP("Actions", "The selected faults become one"), kEdit | kTwoFaults, merge, nullptr,
       true},
      {"fault.split", M::kFault, QT_TRANSLATE_NOOP("Actions", "&Split"), "Ctrl+Shift+M", "split",
       QT_TRANSLATE_NOOP("Actions", "The selected pillars become a fault of their own"), kEdit | kPicked,
       split},
      {"fault.assign", M::kFault, QT_TRANSLATE_NOOP("Actions", "&Assign pillars…"), "Ctrl+Shift+F", "assign",
       QT_TRANSLATE_NOOP("Actions", "The selected pillars go to another fault"), kEdit | kPicked, assign},
      {"fault.reverse", M::kFault, QT_TRANSLATE_NOOP("Actions", "Re&verse pillars"), "Ctrl+R", "reverse",
       QT_TRANSLATE_NOOP("Actions", "The last node becomes the first"), kEdit | kPillars,
       [](MainWindow& window) { reverse_pillars(document(window), chosen_pillars(window)); }, nullptr, true},
      {"fault.reorder", M::kFault, QT_TRANSLATE_NOOP("Actions", "Re&order nodes"), "Alt+R", "reorder",
       QT_TRANSLATE_NOOP("Actions", "The nodes of each pillar follow one another from end to end"),
       kEdit | kSurvey | kPillars,
       [](MainWindow& window) { reorder_pillars(document(window), chosen_pillars(window)); }},
      {"fault.smooth", M::kFault, QT_TRANSLATE_NOOP("Actions", "Smoo&th pillars"), "Ctrl+Shift+S", "smooth",
       QT_TRANSLATE_NOOP("Actions", "Inner nodes move towards the middle of their neighbours"),
       kEdit | kPillars,
       [](MainWindow& window) { smooth_pillars(document(window), chosen_pillars(window)); }},
      {"fault.resample", M::kFault, QT_TRANSLATE_NOOP("Actions", "&Resample pillars…"), "Ctrl+Shift+R",
       "resample", QT_TRANSLATE_NOOP("Actions", "Another number of nodes, evenly spaced"), kEdit | kPillars,
       resample},
      {"fault.resample-spacing", M::kFault, QT_TRANSLATE_NOOP("Actions", "Resample to spacing…"),
       "Alt+Shift+R", "resample-spacing",
       QT_TRANSLATE_NOOP("Actions", "Nodes evenly spaced, as many metres apart as you say"),
       kEdit | kSurvey | kPillars, resample_to_spacing},
      {"fault.transform", M::kFault, QT_TRANSLATE_NOOP("Actions", "&Transform…"), "Ctrl+T", "transform",
       QT_TRANSLATE_NOOP("Actions", "Move, turn and scale the selected nodes, pillars or faults by numbers"),
       kEdit | kSurvey | kAnything, open_transform_dialog},
      {"fault.interpolate", M::kFault, QT_TRANSLATE_NOOP("Actions", "&Interpolate pillars…"), "Ctrl+Shift+I",
       "pillars", QT_TRANSLATE_NOOP("Actions", "Pillars between picked ones, which follow them"),
       kEdit | kSurvey | kFault, interpolate, nullptr, true},
      {"fault.drop-interpolated", M::kFault, QT_TRANSLATE_NOOP("Actions", "&Drop interpolated"), "Ctrl+Alt+I",
       "pillars-drop", QT_TRANSLATE_NOOP("Actions", "Take the interpolated pillars away"),
       kEdit | kSurvey | kFault, drop_interpolated},
      {"fault.accept", M::kFault, QT_TRANSLATE_NOOP("Actions", "Acc&ept pillars"), "Ctrl+Return", "accept",
       QT_TRANSLATE_NOOP("Actions", "Interpolated pillars become picked ones, as they stand"),
       kEdit | kPillars,
       [](MainWindow& window) { accept_pillars(document(window), chosen_pillars(window)); }},
  };
}

}  // namespace footwall::ui
