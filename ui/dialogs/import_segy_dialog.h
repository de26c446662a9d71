// SEG-Y import: header findings, survey map and preview side by side; changing any field updates the other
// two.
#pragma once
#include <QDialog>
#include <QLabel>
#include <QListWidget>
#include <QProgressBar>
#include <QPushButton>
#include <QSlider>
#include <QTimer>

#include "ui/dialogs/segy_field_form.h"
#include "ui/dialogs/segy_line_view.h"
#include "ui/dialogs/segy_looker.h"
#include "ui/dialogs/segy_map_view.h"
#include "ui/model/workbench.h"

class QPlainTextEdit;

namespace footwall::ui {

class ImportSegyDialog final : public QDialog {
  Q_OBJECT

 public:
  // workbench: the open project, which outlives the dialog; null: the file makes a new project.
  ImportSegyDialog(const QString& file, Workbench* workbench, QWidget* parent = nullptr);
  // Cancels an import into a new project, and waits for it.
  ~ImportSegyDialog() override;

  // What the button would do now; for tests.
  bool can_import() const { return import_->isEnabled(); }
  QString button_text() const { return import_->text(); }
  // Why it cannot.
  QString message() const { return message_->text(); }
  std::shared_ptr<const SegyLook> look() const { return look_; }

 Q_SIGNALS:
  // Something new is shown.
  void looked();
  // The import into the open project runs as this job; the dialog is closed.
  void started(int job);
  // The new project is whole; the dialog is closed. Delete it later, not in a slot.
  void project_made(const QString& path);

 public Q_SLOTS:
  void import();
  void reject() override;

 private:
  QWidget* findings_pane(const QString& name);
  QWidget* map_pane();
  QWidget* preview_pane();
  QLayout* bottom_row();
  void fields_changed(bool changes_look);
  void ask();
  void show_look(std::shared_ptr<const SegyLook> look);
  void show_findings();
  void show_state();
  void choose_line(bool of_inline, std::int64_t index);
  void import_anew();
  QString unit() const;

  const QString file_;
  Workbench* workbench_;
  SegyLooker looker_;
  std::shared_ptr<const SegyLook> look_;
  std::uint64_t asked_ = 0;  // the newest look
  bool reading_ = true;      // the look shown is not of the fields shown
  QString refusal_;          // of the last look, where there is none
  bool of_inline_ = true;    // the preview
  Jobs jobs_;                // of an import into a new project
  int job_ = 0;
  QTimer pause_;  // after the last key

  SegyFieldForm* form_ = nullptr;
  QLineEdit* project_ = nullptr;
  QListWidget* candidates_ = nullptr;
  QLabel *evidence_ = nullptr, *warnings_ = nullptr, *map_text_ = nullptr, *line_text_ = nullptr,
         *message_ = nullptr;
  SegyMapView* map_ = nullptr;
  SegyLineView* line_ = nullptr;
  QPlainTextEdit* text_ = nullptr;
  QSlider* line_slider_ = nullptr;
  QPushButton *turn_ = nullptr, *import_ = nullptr, *cancel_ = nullptr;
  QProgressBar* progress_ = nullptr;
};

}  // namespace footwall::ui
