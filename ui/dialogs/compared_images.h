// A comparison of two runs with its pictures: one pixel a cell.
#pragma once
#include <QImage>
#include <array>
#include <string>

#include "engine/render/colour_map.h"
#include "engine/tasks/compare_runs.h"

namespace footwall::ui {

struct ComparedImages {
  tasks::RunComparison comparison;
  struct Panel {
    QImage image;  // ARGB; blank cells are transparent
    render::Range range;
    std::string colour_map;
  };
  std::array<Panel, 3> panels;  // A, B, B - A

  const std::vector<double>& values(std::size_t panel) const;
};

// A and B share one range (2nd to 98th percentile of both) and the statistic's own colour map; the difference
// is symmetric about zero, red and blue.
ComparedImages pictured(tasks::RunComparison comparison, const std::string& colour_map);

}  // namespace footwall::ui
