// The guide and the list of shortcuts, in a window of their own.
#pragma once
#include <QDialog>

class QTextBrowser;

namespace footwall::ui {

class Actions;

// docs/studio.md, installed with the program or in the source tree it was built from; empty where neither is.
QString guide_path();
// A table of every action, by menu, as Markdown.
QString shortcut_list(const Actions& actions);

class HelpWindow final : public QDialog {
  Q_OBJECT

 public:
  explicit HelpWindow(QWidget* parent = nullptr);
  void show_guide();
  void show_text(const QString& title, const QString& markdown);
  QTextBrowser& browser() const { return *browser_; }

 private:
  QTextBrowser* browser_ = nullptr;
};

}  // namespace footwall::ui
