// What an extraction did, as `footwall extract --json` tells it.
#pragma once
#include <string>

#include "engine/extract/face.h"

namespace footwall::service {

// One object: {ranks, threads, exchange, balance, voxelizer, faces, voxels, bytes_sent, messages,
// load_max_over_mean, load_deviation, cache_hits, cache_voxels, reason, predicted{}, seconds{},
// quickest_seconds{}}.
std::string report_json(const extract::Report& report, const extract::Options& options);

}  // namespace footwall::service
