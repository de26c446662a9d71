// The survey's box: edges, ticks and labelled axes with round numbers, as the camera sees it.
#pragma once
#include <QFont>
#include <QSizeF>

#include "engine/render/scene_frame.h"
#include "ui/scene3d/marks.h"

namespace footwall::ui {

// Images of texts, made once.
class TextImages {
 public:
  void set_style(const QFont& font, const QColor& halo, double pixel);
  const QImage& of(const QString& text, const QColor& colour, bool bold = false);
  QSizeF size_of(const QString& text, bool bold = false) const;

 private:
  QFont font_of(bool bold) const;
  QHash<QString, QImage> images_;
  QFont font_;
  QColor halo_;
  double pixel_ = 1;
};

struct SceneColours {
  QColor top, bottom;  // of the background
  QColor text, dim, line, accent, panel;
};

struct BoxMarks {
  std::vector<Line> lines;
  std::vector<Sprite> labels;
};
// view: pixels. Lines and labels stand at exaggerated heights.
BoxMarks box_marks(const render::SceneFrame& frame, const render::Camera& camera, const QSizeF& view,
                   const SceneColours& colours, TextImages& texts);

}  // namespace footwall::ui
