// What the inspector says where several things are selected: how many of what, and of which faults.
#pragma once
#include "ui/panels/properties.h"

namespace footwall::ui {

// Of one thing its properties.
Properties selected_properties(const Workbench& workbench);

}  // namespace footwall::ui
