// The statistics of a whole fault as JSON: in its part file, in result.json and so in the project's run.
#pragma once
#include <nlohmann/json.hpp>

#include "engine/extract/face.h"

namespace footwall::session {

// {count, nulls, outside, ..}: further the numbers of faults in face_numbers.h; null = undefined. Numbers
// read back as the same doubles.
nlohmann::json fault_summary(const extract::FaceStatistics& whole);
// Throws kFormat for anything else.
extract::FaceStatistics fault_from_summary(const nlohmann::json& json);

}  // namespace footwall::session
