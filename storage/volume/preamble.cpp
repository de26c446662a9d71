#include "storage/volume/preamble.h"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>

#include "storage/base/error.h"
#include "storage/volume/description.h"

namespace footwall::volume {
namespace {

using nlohmann::json;

constexpr std::int64_t kMostOnAxis = std::int64_t{1} << 23;
constexpr std::int64_t kMostChunkVoxels = std::int64_t{1} << 28;  // 1 GiB: what a reader must hold at once

Preamble decoded(const std::string& text, const std::filesystem::path& path) {
  const Error damaged(ErrorCode::kCorrupt,
                      fmt::format("{} is damaged in its first {} bytes", path.string(), Preamble::kSize),
                      "restore it from a copy, or import it again");
  const json j = json::parse(text.substr(0, text.find('\0')), nullptr, false);
  if (!j.is_object()) throw damaged;
  Preamble p;
  try {
    const int version = j.at("version").get<int>();
    if (version > kFormatVersion) {
      throw Error(ErrorCode::kUnsupported,
                  fmt::format("{} has volume format {}; this program knows {}", path.string(), version,
                              kFormatVersion),
                  "open it with a newer Footwall");
    }
    p.bytes = j.at("bytes").get<std::int64_t>();
    p.voxels_at = j.at("voxels_at").get<std::int64_t>();
    p.grid.dims = j.at("dims").get<survey::Index>();
    p.grid.chunk = j.at("chunk").get<survey::Index>();
  } catch (const json::exception&) {
    throw damaged;
  }
  double whole = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t n = p.grid.dims[axis];
    const std::int64_t c = p.grid.chunk[axis];
    if (n < 1 || n > kMostOnAxis || c < 1 || c > n) throw damaged;
    const std::int64_t chunks = (n + c - 1) / c;
    whole *= static_cast<double>(chunks);
  }
  // In this order nothing overflows: each chunk side is at most 2^23, and the first product at most 2^46.
  if (p.grid.chunk[0] * p.grid.chunk[1] > kMostChunkVoxels || p.grid.voxels() > kMostChunkVoxels)
    throw damaged;
  whole *= static_cast<double>(p.grid.voxels()) * sizeof(float);
  if (p.voxels_at < Preamble::kSize || p.bytes < p.voxels_at ||
      whole > static_cast<double>(p.bytes - p.voxels_at)) {
    throw damaged;
  }
  return p;
}

}  // namespace

std::string encoded(const Preamble& p) {
  const json j{{"version", kFormatVersion},
               {"bytes", p.bytes},
               {"voxels_at", p.voxels_at},
               {"dims", p.grid.dims},
               {"chunk", p.grid.chunk}};
  std::string text = fmt::format("{}\n{}\n", kFormatName, j.dump());
  require(text.size() < static_cast<std::size_t>(Preamble::kSize), "the preamble fits");
  text.resize(static_cast<std::size_t>(Preamble::kSize), '\0');
  return text;
}

Preamble read_preamble(const std::filesystem::path& path) {
  std::error_code failure;
  const std::filesystem::file_status status = std::filesystem::status(path, failure);
  if (!std::filesystem::exists(status)) {
    throw Error(ErrorCode::kNotFound, fmt::format("there is no volume {}", path.string()),
                "if it was moved, say where with `footwall relink`");
  }
  if (!std::filesystem::is_regular_file(status)) {
    throw Error(ErrorCode::kFormat, fmt::format("{} is not a file", path.string()));
  }
  const auto size = static_cast<std::int64_t>(std::filesystem::file_size(path, failure));
  std::ifstream in(path, std::ios::binary);
  if (failure || !in) throw io_error("read", path, errno);
  std::string text(static_cast<std::size_t>(Preamble::kSize), '\0');
  in.read(text.data(), Preamble::kSize);
  const std::string first_line = fmt::format("{}\n", kFormatName);
  if (!text.starts_with(first_line)) {
    throw Error(ErrorCode::kFormat, fmt::format("{} is not a Footwall volume", path.string()),
                "import it with `footwall import volume`");
  }
  const Preamble p = decoded(text.substr(first_line.size()), path);
  if (size < p.bytes) {
    const std::int64_t chunk_bytes = p.grid.voxels() * static_cast<std::int64_t>(sizeof(float));
    const std::int64_t whole_chunks = std::max<std::int64_t>(0, size - p.voxels_at) / chunk_bytes;
    const std::string lost =
        whole_chunks < p.grid.count()
            ? fmt::format("the voxels end before {} of {}", place_text(p.grid, whole_chunks), p.grid.count())
            : std::string("the voxels are there, the tables behind them are not");
    throw Error(ErrorCode::kCorrupt,
                fmt::format("{} is truncated: {} of {} bytes; {}", path.string(), size, p.bytes, lost),
                "restore it from a copy, or import it again");
  }
  if (size > p.bytes) {
    throw Error(ErrorCode::kCorrupt,
                fmt::format("{} has {} bytes after its end", path.string(), size - p.bytes),
                "restore it from a copy, or import it again");
  }
  return p;
}

std::string place_text(const ChunkGrid& grid, std::int64_t number) {
  const survey::Box box = grid.box_of(grid.place_of(number));
  return fmt::format("chunk {} (inlines {} to {}, crosslines {} to {}, samples {} to {}, counted from 0)",
                     number, box.lo[0], box.hi[0] - 1, box.lo[1], box.hi[1] - 1, box.lo[2], box.hi[2] - 1);
}

}  // namespace footwall::volume
