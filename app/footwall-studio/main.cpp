#include <QApplication>

#include "ui/window/main_window.h"

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  footwall::ui::MainWindow window({});
  const QStringList words = QApplication::arguments();
  if (words.size() > 1) window.open_project(words[1]);
  window.resize(1600, 1000);
  window.show();
  return QApplication::exec();
}
