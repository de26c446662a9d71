// The 4096 bytes in front of the HDF5 data (its "user block"). They say how long the file must be and where
// its chunks lie, so that a truncated file, which HDF5 refuses to open, can still be told chunk by chunk.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include "storage/volume/chunk_grid.h"

namespace footwall::volume {

struct Preamble {
  static constexpr std::int64_t kSize = 4096;
  std::int64_t bytes = 0;      // of the whole file
  std::int64_t voxels_at = 0;  // offset of the first chunk; the others follow without gaps, in their order
  ChunkGrid grid;
};

// Exactly kSize bytes: one line of text, one of JSON, zeros.
std::string encoded(const Preamble& preamble);

// Reads it from a file and compares the file's length: kNotFound, kIo; kFormat for a file of another kind;
// kUnsupported for a newer version; kCorrupt for a wrong length, naming the first chunk that is not whole.
Preamble read_preamble(const std::filesystem::path& path);

// "chunk 17 (inlines 64 to 127, crosslines 0 to 63, samples 0 to 63, counted from 0)".
std::string place_text(const ChunkGrid& grid, std::int64_t number);

}  // namespace footwall::volume
