#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>

#include "engine/isosurface/visible/paper/merge_masks.h"
#include "engine/isosurface/visible/paper/partition.h"
#include "engine/isosurface/visible/paper/screen_box.h"
#include "engine/isosurface/visible/paper/visibility_mask.h"
#include "engine/isosurface/visible/paper/visible_paper.h"
#include "engine/isosurface/visible/paper/workload.h"
#include "engine/render/composite/send.h"

namespace footwall::isosurface {
namespace {

static_assert(std::is_trivially_copyable_v<survey::Box>);

// Adds the time of its own life.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds), start_(omp_get_wtime()) {}
  ~Stopwatch() { seconds_ += omp_get_wtime() - start_; }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& seconds_;
  double start_;
};

double processor_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

// What a rank did in a pass.
struct Share {
  std::int64_t cells = 0;
  std::int64_t triangles = 0;
  VisiblePass::Seconds seconds;
  double busy_seconds = 0;
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
  Host(const Octree& octree, const VisibleRequest& request, const render::Matrix4& to_clip)
      : request_(request), mask_(request.width, request.height) {
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
  void end_pass(const render::CoverageMask& covered) { mask_.end_pass(covered); }

  // The boxes of visible cells that each rank gets, in the order in which they were found.
  std::vector<std::vector<survey::Box>> partition(const Field& volume, int ranks) {
    survey::Index block = request_.estimate_cell;
    for (int axis = 0; axis < 3; ++axis) {
      if (block[axis] == 0) block[axis] = kDefaultEstimateCell[axis];
    }
    std::vector<PlacedWork> placed;
    for (const ActiveCell& cell : visible_)
      placed.push_back({cell.box, workload_.of(volume, cell.cells, request_.isovalue, block)});
    const std::vector<int> rank_of = partition_picture(placed, request_.width, request_.height, ranks);
    std::vector<std::vector<survey::Box>> boxes(static_cast<std::size_t>(ranks));
    for (std::size_t n = 0; n < visible_.size(); ++n)
      boxes[static_cast<std::size_t>(rank_of[n])].push_back(visible_[n].cells);
    return boxes;
  }

 private:
  const VisibleRequest& request_;
  VisibilityMask mask_;
  std::vector<ActiveCell> active_;
  std::vector<ActiveCell> visible_;
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
VisiblePass pass_of(comm::Communicator& world, const Share& mine, double& busy_seconds) {
  comm::Bytes bytes(sizeof mine);
  std::memcpy(bytes.data(), &mine, sizeof mine);
  const std::vector<comm::Bytes> others = render::gather_to_first(world, world.size(), bytes);
  VisiblePass pass;
  std::vector<std::int64_t> cells;
  std::vector<std::int64_t> triangles;
  const auto add = [&](const Share& share) {
    cells.push_back(share.cells);
    triangles.push_back(share.triangles);
    pass.cells += share.cells;
    pass.triangles += share.triangles;
    busy_seconds = std::max(busy_seconds, share.busy_seconds);
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
  pass.load_difference = load_difference(cells, triangles);
  return pass;
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

}  // namespace

void extract_visible_paper(comm::Communicator& world, const Field& volume, const Octree* octree,
                           const VisibleRequest& request, const JobContext& job,
                           const std::function<void(const VisiblePieces&)>& after_pass, VisiblePieces& into) {
  std::vector<SomeTriangles> room = std::move(into.passes);
  into = {};
  const double start = omp_get_wtime();
  double aside = 0;  // in after_pass
  const render::Matrix4 to_clip = request.placement.then(request.camera.view_projection);
  std::optional<Host> host;
  std::optional<ExtractCells> cells;
  std::optional<render::CoverageMask> covered;
  Cover cover(to_clip);
  double walked = 0;
  world.collectively([&] {
    check(request, volume);
    covered.emplace(request.width, request.height);
    cells.emplace(volume, request.bricks, request.isovalue, request.threads);
    if (world.rank() != 0) return;
    const Stopwatch time(walked);
    require(octree != nullptr && octree->volume_size() == request.volume_size, "an octree of the volume");
    host.emplace(*octree, request, to_clip);
  });

  for (int pass = 0;; ++pass) {
    Share mine;
    std::vector<Assignment> all(world.rank() == 0 ? static_cast<std::size_t>(world.size()) : 0);
    world.collectively([&] {
      job.check();
      if (world.rank() != 0) return;
      // 1. Which cells are visible, as far as is known.
      std::size_t visible = 0;
      {
        const Stopwatch time(mine.seconds.visibility);
        visible = host->find_visible().size();
      }
      if (pass == 0) mine.seconds.visibility += walked;
      if (pass > 0) into.report.passes.back().uncovered_pixels = host->uncovered_pixels();
      const bool late =
          request.budget_seconds && pass > 0 && omp_get_wtime() - start - aside >= *request.budget_seconds;
      const bool stops = late || (request.passes > 0 && pass == request.passes);
      if (stops && visible > 0) into.report.finished = false;
      if (stops || visible == 0) {
        for (Assignment& each : all) each.ends = true;
        return;
      }
      // 2. The picture is cut into tiles, one for each rank.
      const Stopwatch time(mine.seconds.partition);
      std::vector<std::vector<survey::Box>> boxes = host->partition(volume, world.size());
      for (std::size_t rank = 0; rank < all.size(); ++rank) all[rank].boxes = std::move(boxes[rank]);
    });

    // 3. Each rank learns its cells.
    Assignment assignment;
    {
      const Stopwatch time(mine.seconds.assign);
      assignment = assign(world, all);
    }
    if (assignment.ends) break;

    // 4. Triangles, and what they cover.
    world.collectively([&] {
      if (assignment.boxes.empty()) return;
      const Stopwatch time(mine.seconds.extract);
      const double busy = processor_seconds();
      const std::size_t at = into.passes.size();
      into.passes.push_back(at < room.size() ? std::move(room[at]) : SomeTriangles());
      cells->extract(assignment.boxes, into.passes.back());
      cover.draw(into.passes.back(), *covered);
      mine.cells = static_cast<std::int64_t>(assignment.boxes.size());
      mine.triangles = static_cast<std::int64_t>(into.passes.back().surface.triangles.size());
      mine.busy_seconds = processor_seconds() - busy;
    });

    // 5. The masks of all ranks to rank 0.
    {
      const Stopwatch time(mine.seconds.composite);
      merge_masks(world, *covered);
    }
    double busy = 0;
    const VisiblePass done = pass_of(world, mine, busy);
    if (world.rank() == 0) {
      into.busy_seconds.push_back(busy);
      into.report.passes.push_back(done);
      host->end_pass(*covered);
    }
    if (after_pass) {
      const Stopwatch time(aside);
      after_pass(into);
    }
  }
  into.report.sum_up();
}

}  // namespace footwall::isosurface
