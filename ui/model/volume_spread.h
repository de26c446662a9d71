// How a volume's values are spread: the bars of a histogram, and the clip that belongs to a range of colours.
#pragma once
#include <vector>

#include "storage/volume/volume_info.h"
#include "ui/model/display.h"
#include "ui/model/section_reader.h"

namespace footwall::ui {

// Heights 0 to 1 of `bars` bars; the square root of the counts, so that rare values are seen, too.
std::vector<double> bar_heights(const volume::Histogram& histogram, int bars);

// The look whose colours begin (`is_low`) or end at the value: its clip is the value's percentile, of |value|
// where the volume has both signs, and its gain is 1. At least the middle half of the values is within.
SampleLook clipped_at(SampleLook look, const SectionReader::VolumeFacts& facts, double value, bool is_low);

}  // namespace footwall::ui
