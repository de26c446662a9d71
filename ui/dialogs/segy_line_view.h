// One line of a SEG-Y file in grey, clipped at the 99th percentile of |amplitude|.
#pragma once
#include <QImage>
#include <QWidget>
#include <memory>

#include "ui/dialogs/segy_looker.h"

namespace footwall::ui {

// Grey, black at -clip, white at +clip, transparent where NaN; columns are traces.
QImage grey_of(const formats::segy::LinePreview& line, double clip);
// The percentile (0 to 100, nearest) of |value| over what is finite; 0 where nothing is.
double clip_of(const std::vector<float>& values, double percentile);

class SegyLineView final : public QWidget {
  Q_OBJECT

 public:
  explicit SegyLineView(QWidget* parent = nullptr);

  // Null: nothing is known. unit: of z, empty where the user has not said it.
  void show_look(std::shared_ptr<const SegyLook> look, const QString& unit);

  QSize sizeHint() const override { return {420, 320}; }
  QSize minimumSizeHint() const override { return {200, 160}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  std::shared_ptr<const SegyLook> look_;
  QString unit_;
  QImage image_;
};

}  // namespace footwall::ui
