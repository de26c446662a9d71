#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "engine/isosurface/visible/paper/merge_masks.h"
#include "engine/isosurface/visible/paper/partition.h"
#include "engine/isosurface/visible/paper/screen_box.h"
#include "engine/isosurface/visible/paper/visibility_mask.h"
#include "engine/isosurface/visible/paper/visible_paper.h"
#include "engine/isosurface/visible/paper/workload.h"
#include "engine/render/composite/send.h"
#include "storage/base/stopwatch.h"

namespace footwall::isosurface {
namespace {

static_assert(std::is_trivially_copyable_v<survey::Box>);

// What a rank did in a pass.
struct Share {
  std::int64_t cells = 0;
  std::int64_t triangles = 0;
  VisiblePass::Seconds seconds;
  VisiblePieces::Busy busy;
};

struct ActiveCell {
  survey::Box cells;
  render::PixelRect box;
};

void check(const VisibleRequest& request, const Field& volume) {
  for (int axis = 0; axis < 3; ++axis) {
    if (volume.size[axis] != request.volume_size[axis] ||
        volume.volume_size[axis] != request.volume_size[axis])
      throw Error(ErrorCode::kInvalid, "mode paper needs the whole volume on every rank");
    if (request.cell[axis] < 0 || request.estimate_cell[axis] < 0) {
      throw Error(ErrorCode::kUsage, "a cell of the octree has at least one cell of the lattice each way");
    }
  }
  if (request.passes < 0)
    throw Error(ErrorCode::kUsage, fmt::format("{} passes cannot be made", request.passes));
}

// Rank 0: which cells are visible, and who gets them.
class Host {
 public:
  Host(const Octree& octree, const VisibleRequest& request, const render::Matrix4& to_clip, int ranks)
      : request_(request),
        mask_(request.width, request.height),
        triangles_of_ranks_(static_cast<std::size_t>(ranks)) {
    const Viewpoint from = viewpoint_of(request.camera, request.placement);
    octree.front_to_back(from, request.isovalue, [&](const Octree::Node& node) {
      if (node.level > 0) return true;
      const survey::Box cells = octree.cells_of(node);
      const render::PixelRect box = screen_box(cells, to_clip, request.width, request.height);
      if (!box.empty() && !cells.empty()) active_.push_back({cells, box});
      return false;
    });
  }

  // The cells of the next pass, nearest first; those that are hidden now are forgotten.
  const std::vector<ActiveCell>& find_visible() {
    visible_.clear();
    std::size_t kept = 0;
    for (const ActiveCell& cell : active_) {
      switch (mask_.classify(cell.box)) {
        case VisibilityMask::Outcome::kVisible:
          visible_.push_back(cell);
          break;
        case VisibilityMask::Outcome::kUndetermined:
          active_[kept++] = cell;
          break;
        case VisibilityMask::Outcome::kHidden:
          break;
      }
    }
    active_.resize(kept);
    return visible_;
  }
  std::int64_t uncovered_pixels() const { return mask_.claimed_pixels(); }
  void end_pass(const render::CoverageMask& covered, const std::vector<std::int64_t>& triangles_of_ranks) {
    mask_.end_pass(covered);
    for (std::size_t rank = 0; rank < triangles_of_ranks_.size(); ++rank)
      triangles_of_ranks_[rank] += triangles_of_ranks[rank];
  }

  // The boxes of visible cells that each rank gets, in the order in which they were found.
  std::vector<std::vector<survey::Box>> partition(const Field& volume) {
    const std::size_t ranks = triangles_of_ranks_.size();
    survey::Index block = request_.estimate_cell;
    for (int axis = 0; axis < 3; ++axis) {
      if (block[axis] == 0) block[axis] = kDefaultEstimateCell[axis];
    }
    std::vector<PlacedWork> placed;
    for (const ActiveCell& cell : visible_)
      placed.push_back({cell.box, workload_.of(volume, cell.cells, request_.isovalue, block)});
    const std::vector<int> tile_of =
        partition_picture(placed, request_.width, request_.height, static_cast<int>(ranks));
    std::vector<std::int64_t> work_of_tiles(ranks);
    for (std::size_t n = 0; n < placed.size(); ++n)
      work_of_tiles[static_cast<std::size_t>(tile_of[n])] += placed[n].work;
    const std::vector<int> rank_of = deal_tiles(work_of_tiles, triangles_of_ranks_);
    std::vector<std::vector<survey::Box>> boxes(ranks);
    for (std::size_t n = 0; n < visible_.size(); ++n) {
      const int rank = rank_of[static_cast<std::size_t>(tile_of[n])];
      boxes[static_cast<std::size_t>(rank)].push_back(visible_[n].cells);
    }
    return boxes;
  }

 private:
  const VisibleRequest& request_;
  VisibilityMask mask_;
  std::vector<ActiveCell> active_;
  std::vector<ActiveCell> visible_;
  std::vector<std::int64_t> triangles_of_ranks_;  // in all passes that are done
  Workload workload_;
};

// A rank's part in a pass.
struct Assignment {
  bool ends = false;  // there is no pass any more
  std::vector<survey::Box> boxes;
};

comm::Bytes bytes_of(const Assignment& assignment) {
  comm::Bytes bytes(1 + assignment.boxes.size() * sizeof(survey::Box));
  bytes.front() = assignment.ends ? std::byte{1} : std::byte{0};
  if (!assignment.boxes.empty()) std::memcpy(bytes.data() + 1, assignment.boxes.data(), bytes.size() - 1);
  return bytes;
}

Assignment assignment_from(const comm::Bytes& bytes) {
  Assignment assignment;
  assignment.ends = bytes.at(0) == std::byte{1};
  assignment.boxes.resize((bytes.size() - 1) / sizeof(survey::Box));
  if (!assignment.boxes.empty()) std::memcpy(assignment.boxes.data(), bytes.data() + 1, bytes.size() - 1);
  return assignment;
}

// From rank 0 to each: sizes, then boxes.
Assignment assign(comm::Communicator& world, const std::vector<Assignment>& all) {
  std::vector<comm::Bytes> bytes;
  std::vector<std::uint64_t> sizes;
  for (const Assignment& each : all) {
    bytes.push_back(bytes_of(each));
    sizes.push_back(bytes.back().size());
  }
  std::uint64_t size = 0;
  std::vector<comm::KnownOutgoing> outgoing;
  std::vector<comm::KnownIncoming> incoming;
  if (world.rank() != 0) incoming.push_back({0, std::as_writable_bytes(std::span(&size, 1))});
  for (int rank = 1; rank < static_cast<int>(all.size()); ++rank) {
    const auto n = static_cast<std::size_t>(rank);
    outgoing.push_back({rank, std::as_bytes(std::span(sizes).subspan(n, 1)), sizeof size});
  }
  world.exchange_known(outgoing, incoming);
  comm::Bytes mine(size);
  for (comm::KnownOutgoing& message : outgoing) {
    message.bytes = bytes[static_cast<std::size_t>(message.rank)];
    message.most = message.bytes.size();
  }
  for (comm::KnownIncoming& message : incoming) message.room = mine;
  world.exchange_known(outgoing, incoming);
  return world.rank() == 0 ? all.front() : assignment_from(mine);
}

// What all ranks did, on rank 0.
struct Done {
  VisiblePass pass;
  VisiblePieces::Busy busy;
  std::vector<std::int64_t> triangles_of_ranks;
};
Done pass_of(comm::Communicator& world, const Share& mine) {
  comm::Bytes bytes(sizeof mine);
  std::memcpy(bytes.data(), &mine, sizeof mine);
  const std::vector<comm::Bytes> others = render::gather_to_first(world, world.size(), bytes);
  Done done;
  VisiblePass& pass = done.pass;
  std::vector<std::int64_t> cells;
  const auto add = [&](const Share& share) {
    cells.push_back(share.cells);
    done.triangles_of_ranks.push_back(share.triangles);
    pass.cells += share.cells;
    pass.triangles += share.triangles;
    done.busy.host = std::max(done.busy.host, share.busy.host);
    done.busy.extract = std::max(done.busy.extract, share.busy.extract);
    pass.seconds.visibility = std::max(pass.seconds.visibility, share.seconds.visibility);
    pass.seconds.partition = std::max(pass.seconds.partition, share.seconds.partition);
    pass.seconds.assign = std::max(pass.seconds.assign, share.seconds.assign);
    pass.seconds.extract = std::max(pass.seconds.extract, share.seconds.extract);
    pass.seconds.composite = std::max(pass.seconds.composite, share.seconds.composite);
  };
  add(mine);
  for (const comm::Bytes& other : others) {
    Share share;
    std::memcpy(&share, other.data(), sizeof share);
    add(share);
  }
  pass.load_difference = load_difference(cells, done.triangles_of_ranks);
  return done;
}

// Draws triangles into the coverage mask.
class Cover {
 public:
  explicit Cover(const render::Matrix4& to_clip) : to_clip_(to_clip) {}

  void draw(const SomeTriangles& some, render::CoverageMask& into) {
    const render::LitSurface surface = lit(some, 0, {});
    vertices_.resize(surface.positions.size());
    render::project(to_clip_, surface.positions, into.width(), into.height(), vertices_);
    render::cover(to_clip_, surface.positions, vertices_, surface.triangles, into);
  }

 private:
  render::Matrix4 to_clip_;
  std::vector<render::ScreenVertex> vertices_;
};

// The passes of one picture, step by step; every step is called on all ranks.
class Passes {
 public:
  Passes(comm::Communicator& world, const Field& volume, const VisibleRequest& request, VisiblePieces& into)
      : world_(world), volume_(volume), request_(request), into_(into), start_(omp_get_wtime()) {
    room_ = std::move(into.passes);
    into = {};
  }

  void begin(const Octree* octree) {
    const render::Matrix4 to_clip = request_.placement.then(request_.camera.view_projection);
    world_.collectively([&] {
      check(request_, volume_);
      covered_.emplace(request_.width, request_.height);
      cells_.emplace(volume_, request_.bricks, request_.isovalue, request_.threads);
      cover_.emplace(to_clip);
      if (world_.rank() != 0) return;
      const Stopwatch time(mine_.seconds.visibility, mine_.busy.host);
      require(octree != nullptr && octree->volume_size() == request_.volume_size, "an octree of the volume");
      host_.emplace(*octree, request_, to_clip, world_.size());
    });
  }

  // 1. Which cells are visible, as far as is known, and 2. who is to extract them. Rank 0 alone.
  std::vector<Assignment> find(const JobContext& job) {
    std::vector<Assignment> all(world_.rank() == 0 ? static_cast<std::size_t>(world_.size()) : 0);
    world_.collectively([&] {
      job.check();
      if (world_.rank() != 0) return;
      const bool any = find_visible();
      const bool stops = any && is_over();
      if (stops) into_.report.finished = false;
      if (!any || stops) {
        for (Assignment& each : all) each.ends = true;
        return;
      }
      const Stopwatch time(mine_.seconds.partition, mine_.busy.host);
      std::vector<std::vector<survey::Box>> boxes = host_->partition(volume_);
      for (std::size_t rank = 0; rank < all.size(); ++rank) all[rank].boxes = std::move(boxes[rank]);
    });
    return all;
  }

  // 3. Each rank learns its cells.
  Assignment assigned(const std::vector<Assignment>& all) {
    const Stopwatch time(mine_.seconds.assign);
    return assign(world_, all);
  }

  // 4. Triangles, and what they cover.
  void extract(const std::vector<survey::Box>& boxes) {
    world_.collectively([&] {
      if (boxes.empty()) return;
      const Stopwatch time(mine_.seconds.extract, mine_.busy.extract);
      const std::size_t at = into_.passes.size();
      into_.passes.push_back(at < room_.size() ? std::move(room_[at]) : SomeTriangles());
      SomeTriangles& some = into_.passes.back();
      cells_->extract(boxes, some);
      cover_->draw(some, *covered_);
      mine_.cells = static_cast<std::int64_t>(boxes.size());
      mine_.triangles = static_cast<std::int64_t>(some.surface.triangles.size());
    });
  }

  // 5. The masks of all ranks to rank 0, and what was done.
  void composite() {
    {
      const Stopwatch time(mine_.seconds.composite);
      merge_masks(world_, *covered_);
    }
    const Done done = pass_of(world_, mine_);
    mine_ = {};
    if (world_.rank() != 0) return;
    into_.busy_seconds.push_back(done.busy);
    into_.report.passes.push_back(done.pass);
    host_->end_pass(*covered_, done.triangles_of_ranks);
  }

  // Something that does not count.
  void aside(const std::function<void(const VisiblePieces&)>& call) {
    if (!call) return;
    const double before = omp_get_wtime();
    call(into_);
    start_ += omp_get_wtime() - before;
  }

 private:
  bool find_visible() {
    const Stopwatch time(mine_.seconds.visibility, mine_.busy.host);
    const bool any = !host_->find_visible().empty();
    std::vector<VisiblePass>& done = into_.report.passes;
    if (!done.empty()) done.back().uncovered_pixels = host_->uncovered_pixels();
    return any;
  }
  // One pass is made, whatever the time.
  bool is_over() const {
    const auto done = static_cast<int>(into_.report.passes.size());
    if (request_.passes > 0 && done >= request_.passes) return true;
    return done > 0 && request_.budget_seconds && omp_get_wtime() - start_ >= *request_.budget_seconds;
  }

  comm::Communicator& world_;
  const Field& volume_;
  const VisibleRequest& request_;
  VisiblePieces& into_;
  double start_;
  std::vector<SomeTriangles> room_;  // of the last picture
  std::optional<Host> host_;         // on rank 0
  std::optional<ExtractCells> cells_;
  std::optional<render::CoverageMask> covered_;
  std::optional<Cover> cover_;
  Share mine_;
};

}  // namespace

void extract_visible_paper(comm::Communicator& world, const Field& volume, const Octree* octree,
                           const VisibleRequest& request, const JobContext& job,
                           const std::function<void(const VisiblePieces&)>& after_pass, VisiblePieces& into) {
  Passes passes(world, volume, request, into);
  passes.begin(octree);
  for (;;) {
    const std::vector<Assignment> all = passes.find(job);
    const Assignment mine = passes.assigned(all);
    if (mine.ends) break;
    passes.extract(mine.boxes);
    passes.composite();
    passes.aside(after_pass);
  }
  into.report.sum_up();
}

}  // namespace footwall::isosurface
