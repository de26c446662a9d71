// Fault sticks and surfaces from a file into the open project, as one step of its history.
#pragma once
#include <QString>

namespace footwall::ui {

class MainWindow;

// A banner says what came in, what was skipped, or why nothing did.
void import_interpretation(MainWindow& window, const QString& path);

}  // namespace footwall::ui
