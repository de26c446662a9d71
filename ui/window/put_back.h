// What was deleted and is outside of the history can be put back as long as a banner says so.
#pragma once

namespace footwall::ui {

class MainWindow;
class ProjectTree;

// Shows the banner, or takes it away where nothing can be put back. The tree outlives the banner.
void show_what_was_removed(MainWindow& window, ProjectTree& tree);

}  // namespace footwall::ui
