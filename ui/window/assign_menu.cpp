#include "ui/window/assign_menu.h"

#include <QCoreApplication>
#include <QMenu>
#include <algorithm>

#include "ui/model/fault_commands.h"

namespace footwall::ui {
namespace {

constexpr std::size_t kFewFaults = 8;  // more get a menu of their own

QString translated(const char* text) {
  return QCoreApplication::translate("AssignMenu", text);
}

QString name_of(const Fault& fault) {
  return QString::fromStdString(fault.record.name);
}

QPixmap swatch_of(const Fault& fault) {
  QPixmap swatch(12, 12);
  swatch.fill(QColor(QString::fromStdString(fault.record.colour)));
  return swatch;
}

// Those that take pillars, the active one first.
std::vector<const Fault*> takers(const Workbench& workbench) {
  std::vector<const Fault*> faults;
  for (const Fault& fault : workbench.document.faults()) {
    if (!fault.record.locked && !is_unassigned(fault)) faults.push_back(&fault);
  }
  std::ranges::stable_partition(
      faults, [&](const Fault* fault) { return fault->record.id == workbench.selection.active_fault(); });
  return faults;
}

void add_fault(QMenu* menu, Workbench& workbench, const std::set<Id>& pillars, const Fault& fault) {
  menu->addAction(swatch_of(fault), name_of(fault), menu, [&workbench, pillars, id = fault.record.id] {
    if (assign_pillars(workbench.document, pillars, id))
      workbench.selection.select({.kind = Item::Kind::kFault, .id = id});
  });
}

}  // namespace

QMenu* make_assign_menu(Workbench& workbench, const std::set<Id>& pillars, QWidget* parent) {
  auto* menu = new QMenu(parent);
  menu->setAttribute(Qt::WA_DeleteOnClose);
  menu->setObjectName(QStringLiteral("assign"));
  menu->addSection(pillars.size() == 1 ? translated("The pillar goes to")
                                       : translated("%1 pillars go to").arg(pillars.size()));
  menu->addAction(translated("New fault"), menu, [&workbench, pillars] {
    const Id made = split_fault(workbench.document, pillars);
    if (made != 0) workbench.selection.select({.kind = Item::Kind::kFault, .id = made});
  });
  const std::vector<const Fault*> faults = takers(workbench);
  QMenu* others = menu;
  for (std::size_t n = 0; n < faults.size(); ++n) {
    if (n == 1 && faults.size() > kFewFaults) others = menu->addMenu(translated("Another fault"));
    add_fault(others, workbench, pillars, *faults[n]);
  }
  menu->addSeparator();
  menu->addAction(translated("Select only"));
  return menu;
}

}  // namespace footwall::ui
