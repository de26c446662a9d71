// Pillars as they would be if some of their nodes stood elsewhere: what is shown while a hand is on them.
#pragma once
#include <map>
#include <vector>

#include "storage/survey/pillar.h"

namespace footwall::ui {

// moved: node id -> where it stands now. Interpolated pillars follow their parents by the parents'
// displacement at equal place along the pillar; the project makes them anew, along the fault's thin plate,
// when the gesture ends.
std::vector<survey::Pillar> moved_provisionally(std::vector<survey::Pillar> pillars,
                                                const std::map<std::int64_t, survey::WorldPoint>& moved);

}  // namespace footwall::ui
