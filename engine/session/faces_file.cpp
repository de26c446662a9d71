#include "engine/session/faces_file.h"

#include <bit>
#include <cstring>

#include "storage/base/error.h"
#include "storage/base/hash.h"

namespace footwall::session {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::string_view kMagic = "FWFACES1";
constexpr std::size_t kFaceBytes = 2 * sizeof(std::int64_t) + 10 * sizeof(std::int32_t);
constexpr std::size_t kHeader = 16;
constexpr std::size_t kTrailer = 8;

template <typename T>
void put(T value, std::string& out) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <typename T>
T take(std::string_view& in) {
  T value;
  std::memcpy(&value, in.data(), sizeof value);
  in.remove_prefix(sizeof value);
  return value;
}

}  // namespace

std::string faces_to_bytes(std::span<const extract::Face> faces) {
  std::string bytes;
  bytes.reserve(kHeader + faces.size() * kFaceBytes + kTrailer);
  bytes += kMagic;
  put(static_cast<std::uint64_t>(faces.size()), bytes);
  for (const extract::Face& face : faces) {
    put(face.fault, bytes);
    put(face.owner, bytes);
    put(face.n, bytes);
    for (const survey::LatticePoint& p : face.triangle) {
      for (const std::int32_t component : {p.i, p.j, p.k}) put(component, bytes);
    }
  }
  put(hash64(std::as_bytes(std::span(bytes))), bytes);
  return bytes;
}

std::vector<extract::Face> faces_from_bytes(std::string_view bytes) {
  const std::string mend = "write the job again";
  if (!bytes.starts_with(kMagic))
    throw Error(ErrorCode::kFormat, "the job's faces are not a faces file", mend);
  if (bytes.size() < kHeader + kTrailer)
    throw Error(ErrorCode::kCorrupt, "the job's faces file is cut off", mend);
  std::string_view tail = bytes.substr(bytes.size() - kTrailer);
  if (take<std::uint64_t>(tail) != hash64(std::as_bytes(std::span(bytes.data(), bytes.size() - kTrailer)))) {
    throw Error(ErrorCode::kCorrupt, "the job's faces file was cut off or altered: its checksum differs",
                mend);
  }
  std::string_view rest = bytes.substr(kMagic.size());
  const auto count = take<std::uint64_t>(rest);
  const std::size_t body = bytes.size() - kHeader - kTrailer;
  if (body % kFaceBytes != 0 || count != body / kFaceBytes) {
    throw Error(ErrorCode::kFormat, "the job's faces file does not hold the number of faces that it states",
                mend);
  }
  std::vector<extract::Face> faces(count);
  for (extract::Face& face : faces) {
    face.fault = take<std::int64_t>(rest);
    face.owner = take<std::int64_t>(rest);
    face.n = take<std::int32_t>(rest);
    for (survey::LatticePoint& p : face.triangle) {
      p.i = take<std::int32_t>(rest);
      p.j = take<std::int32_t>(rest);
      p.k = take<std::int32_t>(rest);
    }
  }
  return faces;
}

}  // namespace footwall::session
