// What an extraction did as JSON: a part of result.json, and what the resident engine tells of an extraction.
#pragma once
#include <nlohmann/json.hpp>

#include "engine/extract/face.h"

namespace footwall::session {

// One object: {ranks, threads, exchange, balance, voxelizer, faces, voxels, bytes_sent, messages,
// load_max_over_mean, load_deviation, pillars, cache_hits, cache_voxels, reason,
// predicted{balance, voxelize, exchange, compute, total}, seconds{read, balance, voxelize, exchange, compute,
// total}, quickest_seconds{}, as seconds without the total}.
nlohmann::json report_json(const extract::Report& report, const extract::Options& options);

}  // namespace footwall::session
