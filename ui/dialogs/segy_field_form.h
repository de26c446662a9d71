// The fields of the SEG-Y import dialog.
#pragma once
#include <QComboBox>
#include <QLineEdit>
#include <QWidget>

#include "ui/dialogs/segy_fields.h"

namespace footwall::ui {

class SegyFieldForm final : public QWidget {
  Q_OBJECT

 public:
  explicit SegyFieldForm(const QString& name, QWidget* parent = nullptr);

  SegyFields fields() const;
  // Takes the candidate's words into the byte fields: one change.
  void take(const formats::segy::LineCandidate& candidate);
  // Shows as placeholders what the file says where nothing is given.
  void show_found(const formats::segy::Report& report, const std::optional<survey::Geometry>& geometry);

 Q_SIGNALS:
  // changes_look: of the map and the preview, not only of what is told about them.
  void changed(bool changes_look);

 private:
  QLineEdit* line(const QString& placeholder, const char* name);

  QLineEdit *name_, *inline_byte_, *crossline_byte_, *x_byte_, *y_byte_, *scalar_, *interval_, *crs_;
  QComboBox *domain_, *unit_, *format_, *endian_;
};

}  // namespace footwall::ui
