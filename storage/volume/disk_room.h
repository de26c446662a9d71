// Takes the room that a volume file will need before hours of import, not after them.
#pragma once
#include <cstdint>
#include <filesystem>

#include "storage/volume/chunk_grid.h"

namespace footwall::volume {

// What the file will need: voxels and tables, and 4 MiB for the attributes. Throws kInvalid for more than a
// file can hold.
std::int64_t expected_bytes(const ChunkGrid& grid);

// Takes the room on the disk at once: a full disk shows at once, and before HDF5 holds tables that it could
// not write any more. File systems that cannot reserve still check the limit on file sizes. The file must
// exist. Throws kIo.
void reserve(const std::filesystem::path& path, std::int64_t bytes);

}  // namespace footwall::volume
