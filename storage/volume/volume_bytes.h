// A volume's file as plain bytes from front to back, for copying it: every chunk is checked against its hash
// before it is handed on, so that a copy is never made of a damaged volume, and the file is read once.
#pragma once
#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>

#include "storage/base/job_context.h"

namespace footwall::volume {

// Calls `take` with consecutive pieces (at most a chunk or 1 MiB each) whose sum is the whole file. Cancel is
// looked at between pieces. Throws as VolumeReader does; kCorrupt for an altered chunk, with its place; kIo
// for a file that shrinks meanwhile. What `take` throws passes through.
void each_verified_piece(const std::filesystem::path& path, const JobContext& job,
                         const std::function<void(std::span<const std::byte>)>& take);

}  // namespace footwall::volume
