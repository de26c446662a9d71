#include "engine/render/composite/compose.h"

#include <algorithm>

#include "engine/render/composite/send.h"
#include "storage/base/stopwatch.h"

namespace footwall::render {

SurfaceLayer Composer::compose(comm::Communicator& world, std::span<const LitSurface> surfaces,
                               const Camera& camera, const ComposeOptions& options, ComposeReport& report,
                               const JobContext& job) {
  report = {};
  const comm::Traffic before = world.traffic();
  const Halving halving(world.size());
  SurfaceLayer layer = world.collectively([&] {
    const VisibilityBuffer possible(options.width, options.height, 0, 1);  // throws where it is not
    return SurfaceLayer(options.width, options.height);
  });

  // 1. Geometry to neighbours, where that is less than a picture.
  Group group;
  {
    const Stopwatch time(report.seconds.group);
    group = form_groups(world, halving, surfaces, camera, options.width, options.height, options.groups);
  }
  report.group_steps = group.steps;

  // 2. Vertices to pixels.
  const int band_rows =
      static_cast<int>(std::clamp<std::int64_t>(kMostPixels / options.width, 1, options.height));
  world.collectively([&] {
    const Stopwatch time(report.seconds.project);
    frame_.project(group.surfaces, camera, options.width, options.height, options.threads);
    report.triangles = static_cast<std::int64_t>(frame_.triangles());
  });

  for (int first = 0; first < options.height; first += band_rows) {
    const Rows band{first, std::min(first + band_rows, options.height)};
    // 3. Each its own rows.
    const Rows own = halving.rows(world.rank(), group.steps, band);
    world.collectively([&] {
      job.report(static_cast<double>(first) / options.height, "draw");
      draw(own, options, report);
    });
    // 4. Halves of pictures change hands, until everybody has its part of the whole one.
    const Rows left = merge(world, halving, group.steps, band, report);
    // 5. The parts to rank 0.
    gather(world, halving, left, layer, report);
  }
  report.bytes = world.traffic().bytes - before.bytes;
  report.messages = world.traffic().messages - before.messages;
  return layer;
}

SurfaceLayer Composer::compose_drawn(comm::Communicator& world, SurfaceFrame& frame, VisibilityBuffer& window,
                                     const ComposeOptions& options, ComposeReport& report) {
  report = {};
  const comm::Traffic before = world.traffic();
  const Halving halving(world.size());
  SurfaceLayer layer = world.collectively([&] {
    require(window.width() == options.width && window.rows() == options.height, "a whole picture");
    const Stopwatch time(report.seconds.shade);
    colours_.resize(window.pixels().size());
    frame.shade(window, colours_, options.threads);
    report.triangles = static_cast<std::int64_t>(frame.triangles());
    return SurfaceLayer(options.width, options.height);
  });
  window_ = std::move(window);
  const Rows left = merge(world, halving, 0, {0, options.height}, report);
  gather(world, halving, left, layer, report);
  window = std::move(*window_);
  window_.reset();
  report.bytes = world.traffic().bytes - before.bytes;
  report.messages = world.traffic().messages - before.messages;
  return layer;
}

void Composer::draw(Rows rows, const ComposeOptions& options, ComposeReport& report) {
  if (rows.count() == 0) {
    window_.reset();
    colours_.clear();
    return;
  }
  {
    const Stopwatch time(report.seconds.rasterize);
    if (window_ && window_->width() == options.width && window_->height() == options.height &&
        window_->first_row() == rows.begin && window_->rows() == rows.count()) {
      window_->clear();
    } else {
      window_.emplace(options.width, options.height, rows.begin, rows.count());
    }
    frame_.rasterize(*window_, options.threads);
  }
  const Stopwatch time(report.seconds.shade);
  colours_.resize(window_->pixels().size());
  frame_.shade(*window_, colours_, options.threads);
}

Rows Composer::merge(comm::Communicator& world, const Halving& halving, int steps_done, Rows band,
                     ComposeReport& report) {
  const Stopwatch time(report.seconds.merge);
  const std::int64_t before = world.traffic().bytes;
  const auto part_of = [&](Rows rows) {
    part_.clear();
    if (rows.count() == 0) return;
    const std::size_t pixels =
        encode_pixels(*window_, colours_, rows.begin, rows.end, PixelKind::kVisible, part_);
    report.merged_pixels += static_cast<std::int64_t>(pixels);
    if (pixels == 0) part_.clear();
  };
  Rows rows = halving.rows(world.rank(), steps_done, band);
  for (int step = steps_done; step < halving.steps(); ++step) {
    const int partner = halving.partner(world.rank(), step);
    if (partner < 0) continue;
    comm::Bytes received;
    if (step == 0 && halving.gives(world.rank())) {
      part_of(rows);
      give_to(world, partner, part_);
      rows = {band.begin, band.begin};
      break;
    }
    if (step == 0) {
      received = take_from(world, partner);
    } else {
      const Rows kept = halving.rows(world.rank(), step + 1, band);
      part_of(halving.rows(partner, step + 1, band));
      received = swap_with(world, partner, part_);
      rows = kept;
    }
    if (!received.empty()) merge_pixels(received, *window_, colours_);
  }
  report.merged_bytes += world.traffic().bytes - before;
  return rows;
}

void Composer::gather(comm::Communicator& world, const Halving& halving, Rows rows, SurfaceLayer& layer,
                      ComposeReport& report) {
  const Stopwatch time(report.seconds.gather);
  if (halving.gives(world.rank())) return;
  part_.clear();
  if (rows.count() > 0) {
    const std::size_t pixels =
        encode_pixels(*window_, colours_, rows.begin, rows.end, PixelKind::kDepth, part_);
    if (pixels == 0) part_.clear();
  }
  std::vector<comm::Bytes> parts = gather_to_first(world, halving.core(), part_);
  if (world.rank() != 0) return;
  if (!part_.empty()) parts.push_back(part_);
  for (comm::Bytes& part : parts) {
    if (!part.empty()) layer.add(std::move(part));
  }
}

}  // namespace footwall::render
