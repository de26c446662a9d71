#include "ui/model/line_drawing.h"

#include <algorithm>
#include <cmath>

namespace footwall::ui {

LineDrawing::LineDrawing(Document& document, Display& display, Picking& picking, QObject* parent)
    : QObject(parent), document_(document), display_(display) {
  connect(&picking, &Picking::tool_changed, this, &LineDrawing::end);
  connect(&document, &Document::survey_changed, this, &LineDrawing::end);
}

void LineDrawing::begin() {
  active_ = true;
  first_.reset();
  Q_EMIT changed();
}

void LineDrawing::end() {
  if (!active_) return;
  active_ = false;
  first_.reset();
  Q_EMIT changed();
}

void LineDrawing::put(const survey::IndexPoint& place) {
  if (!active_ || !document_.survey()) return;
  const survey::Index dims = document_.survey()->dims();
  const auto nearest = [](double index, std::int64_t count) {
    return std::clamp(std::round(index), 0.0, static_cast<double>(count - 1));
  };
  const survey::IndexPoint end_of_line{nearest(place.i, dims[0]), nearest(place.j, dims[1]), 0};
  if (first_ == end_of_line) return;
  if (!first_) {
    first_ = end_of_line;
    Q_EMIT changed();
    return;
  }
  const Section line{.kind = Section::Kind::kLine, .from = *first_, .to = end_of_line};
  end();
  display_.add_section(line);
}

QString LineDrawing::hint() const {
  if (!active_) return {};
  return first_ ? tr("click the other end of the line; Esc leaves")
                : tr("click the first end of the line on a slice, or drag it; Esc leaves");
}

}  // namespace footwall::ui
