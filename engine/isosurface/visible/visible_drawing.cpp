#include "engine/isosurface/visible/visible_drawing.h"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/isosurface/visible/detail/moved_bricks.h"
#include "engine/isosurface/visible/detail/pending_bricks.h"
#include "engine/isosurface/visible/detail/wave_surfaces.h"
#include "engine/voxelize/simd.h"
#include "storage/base/error.h"
#include "storage/base/stopwatch.h"

namespace footwall::isosurface {
namespace {

using detail::EarlierWaves;
using detail::MovedBrick;
using detail::PartSearch;
using detail::PendingBrick;
using detail::PendingBricks;
using detail::WaveSurfaces;

// Waves that look ahead; what they leave is taken by one more, or, where it is much against what was drawn
// (surfaces full of holes), looked at once more before that.
constexpr int kLookingAhead = 2;
constexpr std::int64_t kMuch = 4;  // a quarter
// That are left of a brick of which only the box was looked at.
constexpr std::int64_t kPartsOfFar = 8;
// By how much more than the mean a rank may have to do, before bricks move.
constexpr double kUneven = 0.01;

// Of what the state remembers.
struct Remembered {
  float isovalue = 0;
  survey::Index volume_size{0, 0, 0};
  std::vector<const float*> fields;
  std::vector<survey::Box> bricks;
  friend bool operator==(const Remembered&, const Remembered&) = default;
};

void check(std::span<const VolumePart> parts, const VisibleRequest& request) {
  if (!std::isfinite(request.isovalue)) throw Error(ErrorCode::kInvalid, "an isovalue is not finite");
  std::size_t bricks = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t size = request.volume_size[axis];
    const std::int64_t dims = std::max<std::int64_t>(1, (size + 6) / 8);
    if (size < 1 || request.bricks.dims[axis] != dims)
      throw Error(ErrorCode::kInvalid, "the table of bricks is that of another volume");
    bricks *= static_cast<std::size_t>(dims);
  }
  if (request.bricks.min.size() != bricks || request.bricks.max.size() != bricks)
    throw Error(ErrorCode::kInvalid, "the table of bricks is not whole");
  for (const VolumePart& part : parts) {
    if (part.bricks.empty()) continue;
    for (int axis = 0; axis < 3; ++axis) {
      const std::int64_t size = request.volume_size[axis];
      const std::int64_t first = std::max<std::int64_t>(0, 8 * part.bricks.lo[axis] - 1);
      const std::int64_t last = std::min(8 * part.bricks.hi[axis] + 2, size);
      if (part.bricks.lo[axis] < 0 || part.bricks.hi[axis] > request.bricks.dims[axis] ||
          part.field.volume_size[axis] != size || part.field.origin[axis] > first ||
          part.field.origin[axis] + part.field.size[axis] < last)
        throw Error(ErrorCode::kInvalid, "a part of the volume lacks samples of its bricks");
    }
  }
}

// Times of the slowest rank for each part of each pass.
void tell_slowest(Ranks& ranks, VisibleReport& report) {
  constexpr double kNano = 1e9;
  constexpr std::array kParts{&VisiblePass::Seconds::visibility, &VisiblePass::Seconds::partition,
                              &VisiblePass::Seconds::assign, &VisiblePass::Seconds::extract,
                              &VisiblePass::Seconds::composite};
  std::vector<std::int64_t> times;
  for (const VisiblePass& pass : report.passes) {
    for (const auto part : kParts) times.push_back(static_cast<std::int64_t>(pass.seconds.*part * kNano));
  }
  ranks.most(times);
  std::size_t at = 0;
  for (VisiblePass& pass : report.passes) {
    for (const auto part : kParts) pass.seconds.*part = static_cast<double>(times[at++]) / kNano;
  }
}

}  // namespace

struct VisibleDrawing::State {
  std::optional<Remembered> remembered;
  PendingBricks pending;
  std::vector<BrickParts> seen;    // by the last picture, by place in the table
  std::vector<BrickParts> chosen;  // in the wave under way, likewise; zeros between waves
  BrickNumbers numbers;
  WaveSurfaces surfaces;
  std::optional<render::VisibilityBuffer> window;
  render::DepthPyramid merged;
  render::DepthPyramid ahead;
  std::vector<std::uint64_t> open_bits;
  std::vector<MovedBrick> taken;  // from other ranks, in the wave under way

  void prepare(std::span<const VolumePart> parts, const VisibleRequest& request);
  PartSearch place(Ranks& ranks, std::span<const VolumePart> parts, const VisibleRequest& request);
  void choose(Ranks& ranks, const PartSearch& search, int wave, bool looks_ahead);
  void share(Ranks& ranks, std::span<const VolumePart> parts, const VisibleRequest& request,
             const EarlierWaves& earlier, VisiblePass::Seconds& seconds);
  std::int64_t extract_chosen(std::span<const VolumePart> parts, const VisibleRequest& request,
                              const EarlierWaves& earlier);
  void draw_wave(Ranks& ranks, std::span<const VolumePart> parts, const VisibleRequest& request,
                 const EarlierWaves& earlier, VisiblePass& pass);
  void merge_depths(Ranks& ranks, const render::DepthScale& scale);
  std::int64_t count_open(Ranks& ranks, const PartSearch& search);
  std::int64_t count_left(Ranks& ranks, const PartSearch& search, std::int64_t enough);
  void remember_seen(const PartSearch& search, std::size_t wave);
};

void VisibleDrawing::State::prepare(std::span<const VolumePart> parts, const VisibleRequest& request) {
  voxelize::apply_forced_simd();
  check(parts, request);
  Remembered now{request.isovalue, request.volume_size, {}, {}};
  for (const VolumePart& part : parts) {
    now.fields.push_back(part.field.values.data());
    now.bricks.push_back(part.bricks);
  }
  if (remembered && *remembered == now) {
    pending.restart();
  } else {
    numbers = BrickNumbers(request.bricks, request.isovalue);
    pending.collect(parts, request);
    seen.clear();
    chosen.assign(request.bricks.min.size(), 0);
    remembered = std::move(now);
  }
  if (window && window->width() == request.width && window->height() == request.height) {
    const render::ScreenBox& drawn = merged.window();  // by the last picture
    window->clear(drawn.x0, drawn.x1 + 1, drawn.y0, drawn.y1 + 1);
  } else {
    window.emplace(request.width, request.height);
  }
  surfaces.begin(request);
}

// Where the bricks of all ranks lie in the picture, and between which depths.
PartSearch VisibleDrawing::State::place(Ranks& ranks, std::span<const VolumePart> parts,
                                        const VisibleRequest& request) {
  PartSearch search{
      parts, request, {request.camera, request.placement, request.width, request.height}, {}, {}};
  // As whole numbers, the greatest of which is wanted.
  constexpr double kFine = 1 << 30;
  std::array<std::int64_t, 6> most{-request.width,           -request.height,         -1, -1,
                                   -(std::int64_t{1} << 31), -(std::int64_t{1} << 31)};
  ranks.together([&] {
    pending.place(search.boxes, request);
    for (const PendingBrick& brick : pending.bricks()) {
      const LooseBox& box = brick.loose;
      if (box.empty()) continue;
      const std::array<std::int64_t, 6> here{-box.x0,
                                             -box.y0,
                                             box.x1,
                                             box.y1,
                                             static_cast<std::int64_t>(std::ceil(-box.nearest * kFine)),
                                             static_cast<std::int64_t>(std::ceil(box.farthest * kFine))};
      for (std::size_t n = 0; n < most.size(); ++n) most[n] = std::max(most[n], here[n]);
    }
  });
  ranks.most(most);
  const auto pixel = [](std::int64_t n) { return static_cast<std::int16_t>(n); };
  search.rectangle = {pixel(-most[0]), pixel(-most[1]), pixel(most[2]), pixel(most[3]), 0, 0};
  search.scale = render::DepthScale::between(static_cast<double>(-most[4]) / kFine,
                                             static_cast<double>(most[5]) / kFine);
  ranks.together([&] {
    pending.order(search);
    if (merged.window() != search.rectangle) {
      merged = render::DepthPyramid(search.rectangle);
      ahead = render::DepthPyramid(search.rectangle);
    }
  });
  return search;
}

void VisibleDrawing::State::choose(Ranks& ranks, const PartSearch& search, int wave, bool looks_ahead) {
  const int threads = search.request.threads;
  if (wave == 1 && !seen.empty()) {
    ranks.together([&] { pending.choose(seen, search); });
    std::array<std::int64_t, 1> count{pending.chosen_parts()};
    ranks.sum(count);
    if (count[0] > 0) return;
  }
  if (!looks_ahead) {
    ranks.together([&] {
      pending.find_some(merged, search, std::numeric_limits<std::int64_t>::max());
      pending.choose(nullptr, threads);
    });
    return;
  }
  ranks.together([&] {
    if (wave == 1) {
      ahead.open();
    } else {
      ahead.assign(merged);
    }
    pending.cover(ahead, wave == 1 ? nullptr : &merged, search);
  });
  ranks.least(ahead.pixels());
  ranks.together([&] {
    ahead.build();
    pending.choose(&ahead, threads);
  });
}

// Bricks of ranks that have more to do than the mean go to those that have less.
void VisibleDrawing::State::share(Ranks& ranks, std::span<const VolumePart> parts,
                                  const VisibleRequest& request, const EarlierWaves& earlier,
                                  VisiblePass::Seconds& seconds) {
  taken.clear();
  if (ranks.size() == 1) return;
  std::vector<detail::Move> moves;
  {
    const Stopwatch time(seconds.partition);
    std::array<std::int64_t, 1> work{0};
    ranks.together([&] {
      const detail::ExpectedTriangles expected(request, earlier);
      pending.weigh_chosen(parts, earlier.depths != nullptr ? &expected : nullptr, request.threads);
    });
    for (const PendingBrick& brick : pending.bricks()) work[0] += brick.work;
    moves = detail::moves_for(ranks.all(work), kUneven);
  }
  if (moves.empty()) return;
  const Stopwatch time(seconds.assign);
  std::vector<std::vector<std::byte>> messages;
  ranks.together([&] { messages = detail::give_away(moves, ranks.rank(), ranks.size(), parts, pending); });
  messages = ranks.exchange(std::move(messages));
  ranks.together([&] {
    for (const std::vector<std::byte>& message : messages) {
      for (MovedBrick& brick : detail::taken_from(message, request.volume_size))
        taken.push_back(std::move(brick));
    }
  });
}

std::int64_t VisibleDrawing::State::extract_chosen(std::span<const VolumePart> parts,
                                                   const VisibleRequest& request,
                                                   const EarlierWaves& earlier) {
  std::vector<std::uint8_t> has_chosen(parts.size(), 0);
  for (const PendingBrick& brick : pending.bricks()) {
    chosen[brick.word] = brick.chosen;
    if (brick.chosen != 0) has_chosen[brick.part] = 1;
  }
  const std::size_t first = surfaces.frame().surfaces().size();
  std::int64_t kept = 0;
  for (std::size_t part = 0; part < parts.size(); ++part) {
    if (has_chosen[part] != 0)
      kept += surfaces.add(parts[part].field, parts[part].bricks, chosen, request, numbers, earlier);
  }
  for (const PendingBrick& brick : pending.bricks()) chosen[brick.word] = 0;
  for (const MovedBrick& brick : taken) {
    const survey::Index& at = brick.at;
    const auto word =
        static_cast<std::size_t>((at[0] * request.bricks.dims[1] + at[1]) * request.bricks.dims[2] + at[2]);
    chosen[word] = brick.chosen;
    kept +=
        surfaces.add(brick.field, {at, {at[0] + 1, at[1] + 1, at[2] + 1}}, chosen, request, numbers, earlier);
    chosen[word] = 0;
  }
  surfaces.frame().rasterize(*window, request.threads, first);
  return kept;
}

void VisibleDrawing::State::merge_depths(Ranks& ranks, const render::DepthScale& scale) {
  ranks.together([&] { merged.assign(*window, scale); });
  ranks.least(merged.pixels());
  merged.build();
}

// Pixels that show nothing and that something pending may cover.
std::int64_t VisibleDrawing::State::count_open(Ranks& ranks, const PartSearch& search) {
  ranks.together([&] {
    open_bits.assign(merged.words_a_row() * static_cast<std::size_t>(merged.height()), 0);
    ahead.assign_open(merged);
    pending.close(ahead, merged, search);
    ahead.mark_closed(merged, open_bits);
  });
  ranks.any(open_bits);
  std::int64_t count = 0;
  for (const std::uint64_t word : open_bits) count += std::popcount(word);
  return count;
}

// How many parts are left that `merged` does not hide, of all ranks: exactly where they are no more than
// `enough`, which does not depend on who has what, and otherwise more than that.
std::int64_t VisibleDrawing::State::count_left(Ranks& ranks, const PartSearch& search, std::int64_t enough) {
  std::array<std::int64_t, 2> left{};
  const auto count = [&] {
    left = {pending.pending_parts(), pending.far_bricks()};
    ranks.sum(left);
    return left[0] > enough || left[1] == 0;
  };
  // Each rank its share first, then as if it were alone.
  for (const int share : {ranks.size(), 1}) {
    if (count()) return left[0];
    ranks.together([&] { pending.find_some(merged, search, enough / share); });
  }
  count();
  return left[0];
}

// The parts that the merged depths of all waves but the last do not hide: what was seen, and a little more.
void VisibleDrawing::State::remember_seen(const PartSearch& search, std::size_t wave) {
  pending.take_up_drawn();
  if (wave > 1) pending.give_up_hidden(merged, search.request.threads);
  seen.assign(chosen.size(), 0);
  for (const PendingBrick& brick : pending.bricks()) seen[brick.word] = brick.pending;
}

VisibleDrawing::VisibleDrawing() : state_(std::make_unique<State>()) {}
VisibleDrawing::~VisibleDrawing() = default;

void VisibleDrawing::forget() {
  state_->remembered.reset();
  state_->seen.clear();
}

// Triangles of the chosen parts; tells how many there are and how evenly they are spread.
void VisibleDrawing::State::draw_wave(Ranks& ranks, std::span<const VolumePart> parts,
                                      const VisibleRequest& request, const EarlierWaves& earlier,
                                      VisiblePass& pass) {
  const Stopwatch time(pass.seconds.extract);
  std::array<std::int64_t, 2> mine{pending.chosen_bricks() + static_cast<std::int64_t>(taken.size()), 0};
  ranks.together([&] {
    mine[1] = extract_chosen(parts, request, earlier);
    pending.finish_chosen();
  });
  const std::vector<std::int64_t> loads = ranks.all(mine);
  std::vector<std::int64_t> cells;
  std::vector<std::int64_t> triangles;
  for (std::size_t n = 0; n < loads.size(); n += 2) {
    cells.push_back(loads[n]);
    triangles.push_back(loads[n + 1]);
    pass.cells += loads[n];
    pass.triangles += loads[n + 1];
  }
  pass.load_difference = load_difference(cells, triangles);
}

VisibleReport VisibleDrawing::draw(Ranks& ranks, std::span<const VolumePart> parts,
                                   const VisibleRequest& request,
                                   const std::function<void(int)>& after_wave) {
  double start = omp_get_wtime();
  State& state = *state_;
  const auto count_of_all = [&](std::int64_t mine) {
    std::array<std::int64_t, 1> count{mine};
    ranks.sum(count);
    return count[0];
  };
  VisibleReport report;
  double visibility = 0;
  const auto begin = [&] {
    const Stopwatch time(visibility);
    ranks.together([&] { state.prepare(parts, request); });
    return state.place(ranks, parts, request);
  };
  const PartSearch search = begin();
  std::int64_t left = 0;
  std::int64_t drawn = 0;
  for (int wave = 1;; ++wave) {
    double wave_start = omp_get_wtime();
    VisiblePass pass;
    pass.seconds.visibility = std::exchange(visibility, 0);
    {
      const Stopwatch time(pass.seconds.visibility);
      const bool looks_ahead =
          wave <= kLookingAhead ||
          (wave == kLookingAhead + 1 && state.count_left(ranks, search, drawn / kMuch) > drawn / kMuch);
      state.choose(ranks, search, wave, looks_ahead);
    }
    const std::int64_t drawn_now = count_of_all(state.pending.chosen_parts());
    drawn += drawn_now;
    const EarlierWaves earlier{wave > 1 ? &state.merged : nullptr, search.scale};
    state.share(ranks, parts, request, earlier, pass.seconds);
    state.draw_wave(ranks, parts, request, earlier, pass);
    if (after_wave) {
      double aside = 0;
      {
        const Stopwatch time(aside);
        after_wave(wave);
      }
      start += aside;
      wave_start += aside;
    }
    left = wave > 1 ? state.count_left(ranks, search, 0)
                    : count_of_all(state.pending.pending_parts() + state.pending.far_bricks());
    if (left > 0) {
      {
        const Stopwatch time(pass.seconds.composite);
        state.merge_depths(ranks, search.scale);
      }
      const Stopwatch time(visibility);
      ranks.together([&] { state.pending.give_up_hidden(state.merged, request.threads); });
      left = state.count_left(ranks, search, 0);
      pass.uncovered_pixels = left > 0 ? state.count_open(ranks, search) : 0;
      // The next wave may take all that is left, at this one's speed.
      bool is_late = false;
      if (request.budget_seconds) {
        const std::int64_t about =
            count_of_all(state.pending.pending_parts() + kPartsOfFar * state.pending.far_bricks());
        const double share = std::min(
            1.0, static_cast<double>(about) / static_cast<double>(std::max<std::int64_t>(drawn_now, 1)));
        const double now = omp_get_wtime();
        is_late = now - start + share * (now - wave_start) > *request.budget_seconds;
      }
      std::array<std::int64_t, 1> late{is_late || wave == request.passes ? 1 : 0};
      ranks.most(late);
      report.finished = left == 0 || late[0] == 0;
    }
    report.passes.push_back(pass);
    if (left == 0 || !report.finished) break;
  }
  ranks.together([&] {
    state.surfaces.frame().number();
    state.remember_seen(search, report.passes.size());
  });
  tell_slowest(ranks, report);
  report.sum_up();
  return report;
}

const render::VisibilityBuffer& VisibleDrawing::window() const {
  return *state_->window;
}
render::VisibilityBuffer& VisibleDrawing::window() {
  return *state_->window;
}
render::SurfaceFrame& VisibleDrawing::frame() {
  return state_->surfaces.frame();
}

}  // namespace footwall::isosurface
