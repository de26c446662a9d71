// Runs one job on all ranks: read the job, open the volume, EXTRACT-ALL, write part files and result.json.
//
// result.json: {job, ranks, threads, exchange, balance, voxelizer, faces, voxels, bytes_sent, messages,
// load_max_over_mean, checksum (16 hex digits), seconds{read,voxelize,exchange,compute,total}, volume{path,
// checksum}, parts[{fault, name, file, faces, reused}]}. Faults whose whole part matches the job are not
// computed again; amounts, bytes and seconds are of what was computed, faces, voxels and checksum of
// everything.
#pragma once
#include <filesystem>

#include "engine/comm/communicator.h"
#include "storage/base/job_context.h"

namespace footwall::session {

// Collective; the same Error on every rank. Part files are removed or whole, never half.
void run_batch(const comm::Communicator& world, const std::filesystem::path& job_path, const JobContext& job);

}  // namespace footwall::session
