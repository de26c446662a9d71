#include "engine/service/resident/jobs/deflated.h"

#include <zlib.h>

#include "storage/base/error.h"

namespace footwall::service {

std::string deflated(std::span<const std::byte> bytes) {
  uLongf size = compressBound(bytes.size());
  std::string stream(size, '\0');
  const int code = compress2(reinterpret_cast<Bytef*>(stream.data()), &size,
                             reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), 1);
  if (code != Z_OK) throw Error(ErrorCode::kMemory, "there is no memory to compress what is sent");
  stream.resize(size);
  return stream;
}

}  // namespace footwall::service
