// What the inspector says about a thing: names and values with their units.
#pragma once
#include <QString>
#include <utility>
#include <vector>

#include "ui/model/workbench.h"

namespace footwall::ui {

struct Properties {
  QString title;  // "Fault F2 listric"; empty where nothing is selected
  std::vector<std::pair<QString, QString>> rows;
};

Properties properties_of(const Item& item, const Workbench& workbench);

// Area and dips of a surface. velocity: m/s, of a time survey; without it area is in voxels squared and there
// are no dips.
struct ShapeFacts {
  double area_voxels = 0;
  std::optional<double> area;                         // m^2
  std::optional<double> dip_low, dip_high, dip_mean;  // degrees; the mean is weighted by area
};
ShapeFacts shape_facts(const FaultSurface& surface, const survey::Geometry& survey,
                       std::optional<double> velocity);
// The project's setting; nothing where it has none.
std::optional<double> velocity_of(const project::Project& project);

}  // namespace footwall::ui
