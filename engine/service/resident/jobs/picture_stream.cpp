#include "engine/service/resident/jobs/picture_stream.h"

#include <omp.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/service/resident/jobs/deflated.h"
#include "storage/base/error.h"

namespace footwall::service {
namespace {

constexpr int kTileRows = 256;
constexpr int kMostIsosurfaces = 64;

template <std::size_t N>
std::array<double, N> numbers(const google::protobuf::RepeatedField<double>& from, const char* what) {
  std::array<double, N> to{};
  bool sound = from.size() == static_cast<int>(N);
  for (int n = 0; sound && n < from.size(); ++n) {
    to[static_cast<std::size_t>(n)] = from.Get(n);
    sound = std::isfinite(from.Get(n));
  }
  if (!sound) {
    throw Error(ErrorCode::kInvalid, std::string(what) + " needs " + std::to_string(N) + " finite numbers");
  }
  return to;
}

render::Camera camera_of(const v1::Camera& from) {
  render::Camera camera;
  camera.view_projection = {numbers<16>(from.view_projection(), "view_projection of a camera")};
  const auto vector = [](const auto& field, const char* what) {
    const auto v = numbers<3>(field, what);
    return render::Vec3{v[0], v[1], v[2]};
  };
  camera.eye = vector(from.eye(), "the eye of a camera");
  camera.right = vector(from.right(), "right of a camera");
  camera.up = vector(from.up(), "up of a camera");
  camera.forward = vector(from.forward(), "forward of a camera");
  camera.perspective = from.perspective();
  return camera;
}

session::VisibleChoice choice_of(const v1::VisibleChoice& from) {
  session::VisibleChoice choice;
  if (!from.mode().empty()) choice.mode = session::visible_mode_from(from.mode());
  if (!(from.budget_ms() >= 0) || !std::isfinite(from.budget_ms()) || from.passes() < 0) {
    throw Error(ErrorCode::kUsage, "budget_ms and passes are 0 or more");
  }
  if (from.budget_ms() > 0) choice.budget_seconds = from.budget_ms() / 1000;
  choice.passes = from.passes();
  return choice;
}

// The rows of a picture as tiles, compressed by all threads of rank 0 together.
class Tiles {
 public:
  Tiles(const render::SurfaceLayer& layer, int threads) : width_(static_cast<std::size_t>(layer.width())) {
    depths_.resize(width_ * static_cast<std::size_t>(layer.height()));
    colours_.resize(depths_.size());
    int first = -1;
    for (int y = 0; y < layer.height(); ++y) {
      const bool shows = take_row(layer, y);
      if (shows && first < 0) first = y;
      if (first >= 0 && (!shows || y - first == kTileRows)) {
        add(first, y);
        first = shows ? y : -1;
      }
    }
    if (first >= 0) add(first, layer.height());
    compress(threads);
  }

  std::int64_t empty_pixels() const { return empty_pixels_; }
  void send(const Send& send) const {
    for (const v1::RenderReply& each : replies_) send(each);
  }

 private:
  std::size_t at(int y) const { return static_cast<std::size_t>(y) * width_; }

  bool take_row(const render::SurfaceLayer& layer, int y) {
    const std::span<float> depths = std::span(depths_).subspan(at(y), width_);
    layer.row(y, depths, std::span(colours_).subspan(at(y), width_));
    const auto empty = std::count(depths.begin(), depths.end(), 1.0F);
    empty_pixels_ += empty;
    return empty < static_cast<std::int64_t>(width_);
  }
  void add(int first, int end) {
    v1::Tile& tile = *replies_.emplace_back().mutable_tile();
    tile.set_first_row(first);
    tile.set_rows(end - first);
  }
  void compress(int threads) {
    const int halves = static_cast<int>(2 * replies_.size());
    std::optional<Error> failure;
#pragma omp parallel for num_threads(threads) schedule(dynamic)
    for (int n = 0; n < halves; ++n) {
      v1::Tile& tile = *replies_[static_cast<std::size_t>(n / 2)].mutable_tile();
      const std::size_t first = at(tile.first_row());
      const std::size_t count = static_cast<std::size_t>(tile.rows()) * width_;
      try {
        if (n % 2 == 0) {
          *tile.mutable_colours() = deflated(std::as_bytes(std::span(colours_).subspan(first, count)));
        } else {
          *tile.mutable_depths() = deflated(std::as_bytes(std::span(depths_).subspan(first, count)));
        }
      } catch (...) {
        const Error error = comm::current_error();
#pragma omp critical
        failure = error;
      }
    }
    if (failure) throw Error(*failure);
  }

  std::size_t width_;
  std::vector<float> depths_;
  std::vector<render::Rgba> colours_;
  std::int64_t empty_pixels_ = 0;
  std::vector<v1::RenderReply> replies_;
};

}  // namespace

session::RenderJob render_job_of(const v1::RenderRequest& request, const VolumePath& path_of, int threads) {
  session::RenderJob job;
  job.width = request.width();
  job.height = request.height();
  job.threads = threads;
  job.camera = camera_of(request.camera());
  if (request.has_visible()) job.visible = choice_of(request.visible());
  if (request.isosurfaces_size() < 1 || request.isosurfaces_size() > kMostIsosurfaces) {
    throw Error(ErrorCode::kUsage,
                "a picture shows 1 to " + std::to_string(kMostIsosurfaces) + " isosurfaces");
  }
  for (const v1::DrawnIsosurface& each : request.isosurfaces()) {
    session::RenderJob::Isosurface& surface = job.isosurfaces.emplace_back();
    surface.volume = path_of(each.volume());
    surface.value = each.value();
    if (!std::isfinite(surface.value)) {
      throw Error(ErrorCode::kUsage, "the value of an isosurface must be a number");
    }
    surface.colour = each.colour();
    surface.placement.linear = numbers<9>(each.placement().linear(), "the linear part of a placement");
    const auto shift = numbers<3>(each.placement().shift(), "the shift of a placement");
    surface.placement.shift = {shift[0], shift[1], shift[2]};
  }
  return job;
}

void send_picture(comm::Communicator& world, const session::RenderJob& job, bool every_pass,
                  const session::VolumeOf& volume_of, const Send& send, const JobContext& context) {
  const double start = omp_get_wtime();
  int passes = 0;
  const auto send_pass = [&](int pass, const render::SurfaceLayer& layer) {
    passes = pass;
    world.collectively([&] {
      if (world.rank() != 0) return;
      context.check();
      const Tiles tiles(layer, job.threads);
      tiles.send(send);
      v1::RenderReply reply;
      reply.mutable_pass()->set_pass(pass);
      reply.mutable_pass()->set_uncovered_pixels(tiles.empty_pixels());
      send(reply);
    });
  };
  session::AfterPass after_pass;
  if (job.visible && every_pass) after_pass = send_pass;
  nlohmann::json result;
  const render::SurfaceLayer layer =
      session::draw_isosurfaces(world, job, volume_of, context, after_pass, result);
  world.collectively([&] {
    context.report(0.95, "send");
    if (world.rank() != 0) return;
    // The last pass's tiles were those of the whole picture.
    if (!after_pass || passes == 0) Tiles(layer, job.threads).send(send);
    result["seconds"]["total"] = omp_get_wtime() - start;
    result["layer_bytes"] = layer.bytes();
    v1::RenderReply reply;
    reply.mutable_done()->set_report_json(result.dump());
    send(reply);
  });
}

}  // namespace footwall::service
