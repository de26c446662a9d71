// The dark look, so that pictures of dialogs can be judged; FOOTWALL_PICTURES=FOLDER keeps them.
#pragma once
#include <QApplication>
#include <QPalette>
#include <QWidget>

namespace footwall::ui {

inline void put_on_dark() {
  QApplication::setStyle(QStringLiteral("Fusion"));
  QPalette dark;
  const QColor panel("#262a31"), text("#d6dae0");
  dark.setColor(QPalette::Window, QColor("#1e2126"));
  for (const auto role : {QPalette::Base, QPalette::Button, QPalette::AlternateBase})
    dark.setColor(role, panel);
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
    dark.setColor(role, text);
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText}) {
    dark.setColor(QPalette::Disabled, role, QColor("#5c6470"));
  }
  dark.setColor(QPalette::PlaceholderText, QColor("#8d95a1"));
  dark.setColor(QPalette::Mid, QColor("#3a404a"));
  dark.setColor(QPalette::Highlight, QColor("#4aa3df"));
  dark.setColor(QPalette::HighlightedText, QColor("#1e2126"));
  dark.setColor(QPalette::Link, QColor("#4aa3df"));
  dark.setColor(QPalette::LinkVisited, QColor("#e0a458"));
  dark.setColor(QPalette::BrightText, QColor("#e06c6c"));
  QApplication::setPalette(dark);
  QFont font = QApplication::font();
  font.setPixelSize(13);
  QApplication::setFont(font);
}

inline void keep_picture(QWidget& widget, const QString& name) {
  const QString folder = qEnvironmentVariable("FOOTWALL_PICTURES");
  if (!folder.isEmpty()) widget.grab().save(folder + QLatin1Char('/') + name + QStringLiteral(".png"));
}

}  // namespace footwall::ui
