// Which fault pillars go to that a lasso caught and that belong to none yet.
#pragma once
#include <set>

#include "ui/model/workbench.h"

class QMenu;
class QWidget;

namespace footwall::ui {

// A new fault, the active one, the others that are not locked, or none: the pillars stay selected. What is
// chosen is one step of the history. The parent owns the menu, which goes when it closes.
QMenu* make_assign_menu(Workbench& workbench, const std::set<Id>& pillars, QWidget* parent);

}  // namespace footwall::ui
