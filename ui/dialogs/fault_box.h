// The choice of a fault, as dialogs have it.
#pragma once
#include <QComboBox>

#include "ui/model/workbench.h"

namespace footwall::ui {

// "all faults" first where `with_all`; the active fault is chosen where `at_active`. Data: the fault's name,
// none for all.
QComboBox* fault_box(const Workbench& workbench, bool with_all, bool at_active, QWidget* parent);

}  // namespace footwall::ui
