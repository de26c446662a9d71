// Views under a name: the camera of the scene, and what is shown and how. Kept with the project, outside
// undo.
#pragma once
#include <QString>

namespace footwall::ui {

class MainWindow;

// Asks for a name. Needs a scene.
void save_view(MainWindow& window);
// The same under this name; false where it could not be kept (a banner says why).
bool save_view_as(MainWindow& window, const QString& name);
// Shows what the view shows, in the sections and tiles that there are.
void restore_view(MainWindow& window, const QString& name);

}  // namespace footwall::ui
