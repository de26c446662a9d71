#include "ui/window/actions.h"

#include <QCoreApplication>
#include <QMenuBar>
#include <algorithm>
#include <string>
#include <utility>

#include "ui/window/action_groups.h"
#include "ui/window/main_window.h"
#include "ui/window/theme.h"
#include "ui/window/view_area.h"
#include "ui/window/view_tile.h"

namespace footwall::ui {
namespace {

QString translated(const char* text) {
  return QCoreApplication::translate("Actions", text);
}

QList<QKeySequence> keys_of(const ActionRow& row) {
  QList<QKeySequence> keys;
  for (const QString& word : QString::fromLatin1(row.shortcuts).split(QLatin1Char(' '), Qt::SkipEmptyParts)) {
    keys.append(QKeySequence(word, QKeySequence::PortableText));
  }
  return keys;
}

}  // namespace

std::vector<ActionRow> action_table() {
  std::vector<ActionRow> table;
  for (const auto& group :
       {file_actions(), edit_actions(), walk_actions(), view_actions(), choice_actions(), survey_actions(),
        fault_actions(), tour_actions(), compute_actions(), window_actions(), help_actions()}) {
    table.insert(table.end(), group.begin(), group.end());
  }
  return table;
}

QString title_of(Menu menu) {
  switch (menu) {
    case Menu::kFile:
      return QCoreApplication::translate("Actions", "&File");
    case Menu::kEdit:
      return QCoreApplication::translate("Actions", "&Edit");
    case Menu::kView:
      return QCoreApplication::translate("Actions", "&View");
    case Menu::kSurvey:
      return QCoreApplication::translate("Actions", "&Survey");
    case Menu::kFault:
      return QCoreApplication::translate("Actions", "F&ault");
    case Menu::kCompute:
      return QCoreApplication::translate("Actions", "&Compute");
    case Menu::kWindow:
      return QCoreApplication::translate("Actions", "&Window");
    case Menu::kHelp:
      break;
  }
  return QCoreApplication::translate("Actions", "&Help");
}

Actions::Actions(MainWindow& window) : QObject(&window), window_(window), table_(action_table()) {
  for (const ActionRow& row : table_) {
    auto* action = new QAction(icon(QString::fromLatin1(row.icon)), translated(row.name), this);
    action->setObjectName(QString::fromLatin1(row.id));
    action->setShortcuts(keys_of(row));
    const QString tip = translated(row.tip);
    const QString key = action->shortcut().toString(QKeySequence::NativeText);
    action->setToolTip(key.isEmpty() ? tip : QStringLiteral("%1 (%2)").arg(tip, key));
    action->setStatusTip(tip);
    action->setCheckable(row.checked != nullptr);
    connect(action, &QAction::triggered, this, [this, run = row.run] {
      run(window_);
      refresh();
    });
    window_.addAction(action);
    actions_[action->objectName()] = action;
  }
}

QAction* Actions::action(const QString& id) const {
  const auto found = actions_.find(id);
  return found == actions_.end() ? nullptr : found->second;
}

void Actions::fill(QMenuBar& bar) const {
  std::map<Menu, QMenu*> menus;
  std::map<std::pair<Menu, std::string>, QMenu*> submenus;
  for (const ActionRow& row : table_) {
    QMenu*& menu = menus[row.menu];
    if (menu == nullptr) menu = bar.addMenu(title_of(row.menu));
    if (row.starts_group) menu->addSeparator();
    QMenu* into = menu;
    if (row.submenu != nullptr) {
      QMenu*& sub = submenus[{row.menu, row.submenu}];
      if (sub == nullptr) sub = menu->addMenu(translated(row.submenu));
      into = sub;
    }
    into->addAction(action(QString::fromLatin1(row.id)));
  }
}

unsigned Actions::met() const {
  const Workbench* bench = window_.workbench();
  if (bench == nullptr) return window_.start_jobs().running() > 0 ? kJob : kNothing;
  unsigned met = kProject;
  const auto add = [&met](bool there, Needs need) {
    if (there) met |= need;
  };
  const Selection& selection = bench->selection;
  const bool has_fault =
      bench->document.fault(selection.active_fault()) != nullptr || !selection.faults().empty();
  add(!bench->document.read_only(), kWriting);
  add(bench->document.survey().has_value(), kSurvey);
  add(!bench->document.volumes().empty(), kVolume);
  add(has_fault, kFault);
  add(selection.faults().size() > 1, kTwoFaults);
  add(!selection.pillars().empty(), kPicked);
  add(!selection.pillars().empty() || !selection.faults().empty(), kPillars);
  const Item::Kind kind = selection.current().kind;
  add(!selection.faults().empty() || !selection.pillars().empty() || !selection.nodes().empty() ||
          kind == Item::Kind::kIsosurface || kind == Item::Kind::kView || kind == Item::Kind::kVolume ||
          kind == Item::Kind::kRun,
      kAnything);
  add(kind == Item::Kind::kRun || bench->display.faces().run != 0, kRun);
  const Item::Kind named = selection.owner().kind;
  add(named == Item::Kind::kFault || named == Item::Kind::kVolume || named == Item::Kind::kIsosurface ||
          named == Item::Kind::kRun || named == Item::Kind::kView,
      kNameable);
  add(!bench->document.faults().empty(), kFaults);
  add(bench->document.fault(selection.active_fault()) != nullptr, kActive);
  add(bench->picking.tool() == Tool::kSelect && (kind == Item::Kind::kFace || !selection.pillars().empty()),
      kShiftable);
  add(bench->document.can_undo(), kUndo);
  add(bench->document.can_redo(), kRedo);
  const ViewArea* views = window_.views();
  add(views != nullptr && views->active() != nullptr, kView);
  add(views != nullptr && views->active_section() != 0, kSection);
  const Id active = views == nullptr ? 0 : views->active_section();
  add(std::ranges::any_of(bench->display.sections(),
                          [active](const Display::ShownSection& shown) {
                            return shown.id == active && shown.section.kind == Section::Kind::kLine;
                          }),
      kLine);
  const ViewTile* scene = views == nullptr ? nullptr : views->scene();
  add(scene != nullptr && scene->is_built(), kScene);
  add(bench->jobs.running() > 0 || window_.start_jobs().running() > 0, kJob);
  return met;
}

void Actions::refresh() {
  const unsigned there = met();
  for (const ActionRow& row : table_) {
    QAction* one = action(QString::fromLatin1(row.id));
    const bool enabled = (row.needs & ~there) == 0;
    one->setEnabled(enabled);
    if (row.checked != nullptr) one->setChecked(enabled && row.checked(window_));
  }
}

}  // namespace footwall::ui
