// Small images that lie flat on the scene: colour bar and north arrow.
#pragma once
#include <QFont>
#include <QImage>
#include <QString>
#include <QStringList>
#include <array>

#include "engine/render/colour_map.h"
#include "ui/model/surfaces.h"
#include "ui/scene3d/survey_box.h"

namespace footwall::ui {

struct ColourBar {
  QString title;                        // "variance"
  QString unit;                         // may be empty
  Freshness state = Freshness::kFresh;  // the oldest of what is shown; kPlain: there is nothing to scale
  int not_computed = 0;                 // faults that are shown without it
  QString missing = {};                 // what has to be there first; may be empty
  QStringList run = {};                 // whose numbers these are, a line each; empty: those known now
  const render::ColourMap* colours = nullptr;
  std::array<double, 2> range{0, 1};
  bool has_undefined = false;  // adds a swatch "no value"
  friend bool operator==(const ColourBar&, const ColourBar&) = default;
};

// Between title and scale: what the colours are worth, or which run they are of; with the unit.
QStringList lines_above(const ColourBar& bar);
// What is not there; may be empty.
QString line_below(const ColourBar& bar);
QImage colour_bar_image(const ColourBar& bar, const SceneColours& colours, const QFont& font, double pixel);
// degrees: clockwise from upwards in the picture; length 0 to 1, as much of the arrow as is not
// foreshortened.
QImage north_arrow_image(double degrees, double length, const SceneColours& colours, const QFont& font,
                         double pixel);

}  // namespace footwall::ui
