#include "engine/service/client/detail/inflate.h"

#include <zlib.h>

#include <array>

#include "storage/base/error.h"

namespace footwall::service {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 16;

struct Stream {
  z_stream z{};
  Stream() {
    if (inflateInit(&z) != Z_OK) throw Error(ErrorCode::kMemory, "no memory to unpack what the engine sent");
  }
  ~Stream() { inflateEnd(&z); }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
};

}  // namespace

void inflate(std::string_view packed, std::size_t most, std::string& to) {
  Stream stream;
  std::array<char, kBlock> block;
  stream.z.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(packed.data()));
  stream.z.avail_in = static_cast<uInt>(packed.size());
  std::size_t made = 0;
  int state = Z_OK;
  while (state == Z_OK) {
    stream.z.next_out = reinterpret_cast<Bytef*>(block.data());
    stream.z.avail_out = static_cast<uInt>(block.size());
    state = ::inflate(&stream.z, Z_NO_FLUSH);
    const std::size_t got = block.size() - stream.z.avail_out;
    made += got;
    if (made > most) state = Z_DATA_ERROR;
    if (state == Z_OK || state == Z_STREAM_END) to.append(block.data(), got);
  }
  if (state != Z_STREAM_END || stream.z.avail_in != 0)
    throw Error(ErrorCode::kEngine, "the engine sent packed values that cannot be unpacked");
}

}  // namespace footwall::service
