// The small words above a pane.
#pragma once
#include <QLabel>

namespace footwall::ui {

inline QLabel* caption(const QString& text, QWidget* parent) {
  auto* label = new QLabel(text.toUpper(), parent);
  QFont font = label->font();
  font.setBold(true);
  font.setPixelSize(11);
  font.setLetterSpacing(QFont::AbsoluteSpacing, 0.8);
  label->setFont(font);
  label->setForegroundRole(QPalette::PlaceholderText);
  return label;
}

}  // namespace footwall::ui
