// The dialogs as the window opens them: above it, with what they made shown in it.
#pragma once
#include <QString>

#include "ui/model/document.h"

namespace footwall::ui {

class MainWindow;

// Into the open project, or where none is open (or `anew`) into a new one, which is opened then.
void import_volume(MainWindow& window, const QString& path, bool anew);
void open_run_dialog(MainWindow& window);
void open_export_dialog(MainWindow& window);
// Of what is selected; says why where that cannot be moved.
void open_transform_dialog(MainWindow& window);
void open_compare_dialog(MainWindow& window);
void open_trim_history_dialog(MainWindow& window);
// A banner where the history is large, or older than the user wants it; it offers the dialog above.
void warn_of_history(MainWindow& window);
// isosurface: of Display; 0: a new one.
void open_isosurface_dialog(MainWindow& window, Id isosurface);

}  // namespace footwall::ui
