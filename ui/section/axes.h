// Round numbers along a section, grid lines, and what tells the scale; all outside the data but the grid.
#pragma once
#include <QColor>
#include <QPainter>
#include <QString>
#include <vector>

#include "ui/model/sample_colours.h"
#include "ui/section/view_transform.h"

namespace footwall::ui {

// value = first + step * coordinate, along u or v.
struct AxisScale {
  QString name;  // "crossline"
  QString unit;  // "ms"; empty for line numbers
  double first = 0;
  double step = 1;
  bool whole = false;  // line numbers: no fractions
};
AxisScale u_axis(const Section& section, const survey::Geometry& survey);
AxisScale v_axis(const Section& section, const survey::Geometry& survey);

struct Tick {
  double coordinate = 0;  // u or v
  QString text;
};
// At 1, 2 or 5 x 10^n, at least `spacing` pixels apart; low and high in coordinates, either way round.
std::vector<Tick> round_ticks(const AxisScale& axis, double low, double high, double pixels_per_coordinate,
                              double spacing);
// The largest 1, 2 or 5 x 10^n that is not above.
double round_length(double at_most);

struct AxisColours {
  QColor text, dim, line, grid;
};

// Around view.area(); `bounds`: the whole widget.
void draw_axes(QPainter& painter, const QRectF& bounds, const ViewTransform& view, const AxisScale& u,
               const AxisScale& v, const AxisColours& colours);
// How positive values look: "+ = white", "+ = filled" with wiggles; empty for values without a sign.
QString polarity_of(const SampleColours& samples, bool wiggles);
// In the strip below the data: a bar of round length at the left, the samples' colours, their range and its
// polarity at the right.
void draw_scale(QPainter& painter, const QRectF& strip, const ViewTransform& view,
                const SampleColours* samples, const QString& polarity, const QString& volume,
                const AxisColours& colours);

}  // namespace footwall::ui
