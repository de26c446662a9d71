// The two looks of the window, on Qt's Fusion style. Widgets take their colours from the palette alone, whose
// roles mean:
//
//   Window        behind everything          WindowText, Text, ButtonText   text
//   Base, Button  panels, fields, buttons    PlaceholderText                dim text
//   Mid           lines                      Highlight, Link                accent
//   LinkVisited   warning                    BrightText                     error
#pragma once
#include <QColor>
#include <QIcon>
#include <QString>

namespace footwall::ui {

enum class Theme { kDark, kLight };

struct ThemeColours {
  QColor window, panel, line, text, dim, accent, warning, error;
};
const ThemeColours& colours_of(Theme theme);

// Style, palette, font and style sheet of the whole application, at any time; remembered for the next start.
void apply_theme(Theme theme);
Theme remembered_theme();  // dark where none is
Theme current_theme();     // by the palette in use

// A line drawing of resources/icons by name, in the palette's text colour of the moment it is painted; dim
// where disabled. Null where there is no such drawing.
QIcon icon(const QString& name);

}  // namespace footwall::ui
