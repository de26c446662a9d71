// One view with its slim title: what it shows, linked or not, maximise (double-click, too), close.
#pragma once
#include <QFrame>

#include "ui/window/views.h"

class QHBoxLayout;
class QLabel;
class QToolButton;

namespace footwall::ui {

class ViewTile final : public QFrame {
  Q_OBJECT

 public:
  // section: of Display, or 0 for the scene.
  ViewTile(Workbench& workbench, const ViewFactories& factories, Id section, QWidget* parent = nullptr);

  Id section() const { return section_; }
  QWidget* view() const { return view_; }
  QString title() const;
  // Whether a program part draws it, or a label says that there is none.
  bool is_built() const { return built_; }
  void set_active(bool active);

 Q_SIGNALS:
  void maximise_asked();
  void close_asked();
  // A button of an empty view; action: of the window's table.
  void action_asked(const QString& action);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void add_section_controls(QHBoxLayout& bar);
  void add_scene_controls(QHBoxLayout& bar);
  // Beside the scene: nothing can lie over its window.
  QWidget* make_import_strip();
  void change_section(void (*change)(Display::ShownSection& shown, bool on), bool on);
  void update_title();
  void show_run();

  Workbench& workbench_;
  Id section_ = 0;
  bool built_ = false;
  QWidget* bar_ = nullptr;
  QLabel* title_ = nullptr;
  QToolButton* volume_ = nullptr;
  QToolButton* linked_ = nullptr;
  QToolButton* in_scene_ = nullptr;
  QToolButton* ends_ = nullptr;
  QToolButton* perspective_ = nullptr;
  QToolButton* exaggeration_ = nullptr;
  QToolButton* run_ = nullptr;
  QWidget* view_ = nullptr;
  QWidget* import_ = nullptr;
};

}  // namespace footwall::ui
