#include "engine/service/resident/jobs/box_reads.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <vector>

#include "engine/service/resident/jobs/deflated.h"
#include "engine/service/wire.h"
#include "storage/base/error.h"
#include "storage/base/hash.h"

namespace footwall::service {
namespace {

constexpr std::size_t kReaders = 8;
constexpr std::size_t kPiece = std::size_t{1} << 20;   // values
constexpr std::int64_t kSlab = std::int64_t{1} << 24;  // values that are read at once
constexpr std::int64_t kMostValues = std::int64_t{1} << 26;
static_assert(std::endian::native == std::endian::little, "values are sent as they stand in memory");

void check_box(const survey::Box& box, const survey::Index& dims) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (0 <= box.lo[axis] && box.lo[axis] < box.hi[axis] && box.hi[axis] <= dims[axis]) continue;
    throw Error(
        ErrorCode::kUsage,
        fmt::format(
            "the box from ({}, {}, {}) to ({}, {}, {}) is empty, or leaves the volume of {} x {} x {}",
            box.lo[0], box.lo[1], box.lo[2], box.hi[0], box.hi[1], box.hi[2], dims[0], dims[1], dims[2]),
        "ask for a box inside the volume; hi is one behind the last");
  }
  if (box.count() > kMostValues) {
    throw Error(
        ErrorCode::kMemory,
        fmt::format("the box has {} values, and {} are read at once at the most", box.count(), kMostValues),
        "ask for parts of it");
  }
}

// Parts of the box of at most kSlab values, in the order of the whole: cut along the first axis that has more
// than one place.
void for_each_slab(const survey::Box& box, const std::function<void(const survey::Box&)>& visit) {
  const std::int64_t count = box.count();
  if (count <= kSlab) {
    visit(box);
    return;
  }
  const std::size_t axis = box.size(0) > 1 ? 0 : (box.size(1) > 1 ? 1 : 2);
  const std::int64_t step = std::max<std::int64_t>(1, kSlab * box.size(static_cast<int>(axis)) / count);
  for (std::int64_t at = box.lo[axis]; at < box.hi[axis]; at += step) {
    survey::Box part = box;
    part.lo[axis] = at;
    part.hi[axis] = std::min(at + step, box.hi[axis]);
    for_each_slab(part, visit);
  }
}

}  // namespace

const volume::VolumeReader& BoxReads::reader_of(const std::string& checksum, const VolumePath& path_of) {
  const auto found =
      std::find_if(open_.begin(), open_.end(), [&](const Open& each) { return each.checksum == checksum; });
  if (found != open_.end()) {
    open_.splice(open_.begin(), open_, found);
    return open_.front().reader;
  }
  volume::VolumeReader reader(path_of(checksum));
  if (to_hex(reader.info().checksum) != checksum) {
    throw Error(ErrorCode::kInvalid,
                fmt::format("the volume {} has checksum {} by now, not {}", reader.path().string(),
                            to_hex(reader.info().checksum), checksum),
                "open it again");
  }
  if (open_.size() == kReaders) open_.pop_back();
  open_.push_front({checksum, std::move(reader)});
  return open_.front().reader;
}

void BoxReads::read(const v1::ReadBoxRequest& request, const VolumePath& path_of, const Send& send) {
  const volume::VolumeReader& reader = reader_of(request.volume(), path_of);
  const survey::Box box = box_from(request.box());
  check_box(box, reader.info().dims);
  std::vector<float> values;
  for_each_slab(box, [&](const survey::Box& slab) {
    values.resize(static_cast<std::size_t>(slab.count()));
    reader.read(slab, values);
    for (std::size_t first = 0; first < values.size(); first += kPiece) {
      const auto piece =
          std::as_bytes(std::span(values).subspan(first, std::min(kPiece, values.size() - first)));
      v1::ReadBoxReply reply;
      if (request.compress()) {
        reply.set_values(deflated(piece));
      } else {
        reply.set_values(piece.data(), piece.size());
      }
      send(reply);
    }
  });
}

}  // namespace footwall::service
