// The table of actions.h, menu by menu.
#pragma once
#include <QtGlobal>
#include <vector>

#include "ui/window/actions.h"

namespace footwall::ui {

std::vector<ActionRow> file_actions();
std::vector<ActionRow> edit_actions();
std::vector<ActionRow> walk_actions();  // in the menu of edits
std::vector<ActionRow> view_actions();
std::vector<ActionRow> choice_actions();  // in the menu of views
std::vector<ActionRow> survey_actions();
std::vector<ActionRow> fault_actions();
std::vector<ActionRow> tour_actions();  // in the menu of faults
std::vector<ActionRow> compute_actions();
std::vector<ActionRow> window_actions();
std::vector<ActionRow> help_actions();

}  // namespace footwall::ui
