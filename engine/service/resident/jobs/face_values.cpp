#include "engine/service/resident/jobs/face_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "engine/extract/face_rows.h"
#include "engine/extract/registry.h"
#include "engine/voxelize/registry.h"
#include "storage/base/error.h"
#include "storage/survey/moved_lattice.h"

namespace footwall::service {
namespace {

constexpr std::size_t kPlaces = std::size_t{1} << 18;  // of a piece
constexpr std::size_t kBytes = std::size_t{1} << 22;   // of a piece

extract::Options options_of(const v1::FaceVoxelsRequest& request, int threads) {
  extract::Options options;
  const std::string code = request.code().empty() ? "voxels" : request.code();
  if (code != "voxels" && code != "lot") {
    throw Error(ErrorCode::kUsage, fmt::format("there is no code '{}'", code), "choose one of: voxels, lot");
  }
  options.compute = {code};
  options.exchange = "push";
  options.balance = "none";
  options.threads = threads;
  if (!request.voxelizer().empty()) options.voxelizer = request.voxelizer();
  if (code == "lot") {
    options.snr = request.snr();
    if (!(options.snr > 0)) {
      throw Error(ErrorCode::kUsage, "code lot needs a signal-to-noise ratio", "give snr in dB, as 30");
    }
  }
  extract::validate(options);
  return options;
}

extract::Face face_of(const v1::FaceVoxelsRequest& request, const survey::Index& origin) {
  if (request.corners_size() != 9) {
    throw Error(ErrorCode::kInvalid,
                fmt::format("a triangle has nine numbers, not {}", request.corners_size()));
  }
  extract::Face face{1, 0, 0, {}};
  for (int corner = 0; corner < 3; ++corner) {
    face.triangle[static_cast<std::size_t>(corner)] = {
        request.corners(3 * corner), request.corners(3 * corner + 1), request.corners(3 * corner + 2)};
  }
  face.triangle = survey::in_volume(face.triangle, origin);
  return face;
}

}  // namespace

void send_face_values(const comm::Communicator& world, extract::LoadedSurvey& survey,
                      const volume::VolumeInfo& info, const v1::FaceVoxelsRequest& request, int threads,
                      const Send& send, const JobContext& job) {
  extract::Options options;
  const extract::Face face = world.collectively([&] {
    options = options_of(request, threads);
    return face_of(request, info.origin);
  });
  const extract::Input input{info.dims, info.statistics.max_abs, std::span(&face, 1)};
  const extract::Result result = survey.extract(input, options, job.part(0, 0.9));
  world.collectively([&] {
    if (world.rank() != 0) return;
    extract::FaceRows rows;
    voxelize::make_voxelizer(options.voxelizer)->rows(face.triangle, {{0, 0, 0}, info.dims}, rows);
    const std::span<const std::byte> bytes = result.blobs.at(0).of(0);
    const bool coded = options.compute[0] == "lot";
    require(coded || bytes.size() == static_cast<std::size_t>(rows.voxels()) * sizeof(float),
            "a value for every voxel");
    v1::FaceVoxelsReply reply;
    std::size_t n = 0;
    const auto flush = [&] {
      if (reply.places_size() == 0) return;
      job.report(0.95, "send");
      send(reply);
      reply.Clear();
    };
    rows.for_each([&](const survey::Index& voxel) {
      for (std::size_t axis = 0; axis < voxel.size(); ++axis)
        reply.add_places(static_cast<std::int32_t>(voxel[axis] + info.origin[axis]));
      if (!coded) {
        float value = 0;
        std::memcpy(&value, bytes.data() + n * sizeof value, sizeof value);
        reply.add_values(value);
      }
      if (++n % kPlaces == 0) flush();
    });
    flush();
    for (std::size_t first = 0; coded && first < bytes.size(); first += kBytes) {
      const auto piece = bytes.subspan(first, std::min(kBytes, bytes.size() - first));
      reply.set_coded(piece.data(), piece.size());
      send(reply);
    }
  });
}

}  // namespace footwall::service
