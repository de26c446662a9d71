#include "ui/scene3d/isosurface_maker.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

#include "engine/isosurface/extract.h"
#include "storage/base/error.h"
#include "storage/base/hash.h"
#include "storage/volume/volume_reader.h"

namespace footwall::ui {
namespace {

using render::Vec3;

constexpr std::int64_t kBrick = 8;  // cells
// Cells that are looked at in one go: even noise makes no more than some hundred megabytes of them before
// they are counted.
constexpr std::int64_t kCellsAtOnce = std::int64_t{1} << 21;

int threads_to_use() {
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency() / 2));
}

std::array<std::int8_t, 4> packed(const Vec3& normal) {
  const double size = length(normal);
  if (!(size > 0)) return {};
  const auto byte = [size](double x) { return static_cast<std::int8_t>(std::lround(127 * x / size)); };
  return {byte(normal.x), byte(normal.y), byte(normal.z), 0};
}

// Adds what was extracted, brought into the scene.
void append(const isosurface::Surface& part, const VolumePlace& place, IsosurfaceShape& shape) {
  const auto first = static_cast<std::uint32_t>(shape.positions.size());
  const auto& [a, b, c] = place.steps;
  const double turned = dot(a, cross(b, c)) < 0 ? -1 : 1;  // a survey may be left-handed
  const std::array<Vec3, 3> across{cross(b, c) * turned, cross(c, a) * turned, cross(a, b) * turned};
  for (const isosurface::Point& p : part.positions.all()) {
    shape.positions.emplace_back(place.zero + a * static_cast<double>(p.i) + b * static_cast<double>(p.j) +
                                 c * static_cast<double>(p.k));
  }
  for (const isosurface::Point& n : part.normals.all()) {
    shape.normals.push_back(packed(across[0] * static_cast<double>(n.i) +
                                   across[1] * static_cast<double>(n.j) +
                                   across[2] * static_cast<double>(n.k)));
  }
  for (const isosurface::Triangle& triangle : part.triangles.all()) {
    for (const std::uint32_t corner : triangle) shape.corners.push_back(first + corner);
  }
}

}  // namespace

bool is_same(const IsosurfaceRequest& a, const IsosurfaceRequest& b) {
  const auto alike = [](const Vec3& p, const Vec3& q) { return p.x == q.x && p.y == q.y && p.z == q.z; };
  return a.isosurface == b.isosurface && a.volume == b.volume && a.path == b.path &&
         a.checksum == b.checksum && a.value == b.value && alike(a.place.zero, b.place.zero) &&
         alike(a.place.steps[0], b.place.steps[0]) && alike(a.place.steps[1], b.place.steps[1]) &&
         alike(a.place.steps[2], b.place.steps[2]);
}

// An opened volume and the slab of its inlines that was read last.
class IsosurfaceMaker::Volume {
 public:
  explicit Volume(const IsosurfaceRequest& request)
      : path_(request.path), checksum_(request.checksum), reader_(request.path), ranges_(reader_.min_max(0)) {
    if (!checksum_.empty() && to_hex(reader_.info().checksum) != checksum_) {
      throw Error(ErrorCode::kCorrupt,
                  path_.string() + " is not the file that the project knows as " + request.name,
                  "bring the right file back, or point the project to it with relink");
    }
  }
  bool is_of(const IsosurfaceRequest& request) const {
    return path_ == request.path && checksum_ == request.checksum;
  }
  const survey::Index& size() const { return reader_.info().dims; }
  isosurface::Bricks bricks() const { return {ranges_.dims, ranges_.min, ranges_.max, ranges_.has_null}; }

  // Whether the value can occur in cells of inlines [first, end).
  bool may_cross(std::int64_t first, std::int64_t end, float value) const {
    for (std::int64_t a = first / kBrick; a * kBrick < end && a < ranges_.dims[0]; ++a) {
      for (std::int64_t n = ranges_.at(a, 0, 0); n < static_cast<std::int64_t>(ranges_.at(a + 1, 0, 0));
           ++n) {
        const auto at = static_cast<std::size_t>(n);
        if (ranges_.min[at] < value && ranges_.max[at] >= value) return true;
      }
    }
    return false;
  }

  // Samples of inlines [first, end), kept until others are asked for.
  isosurface::Field slab(std::int64_t first, std::int64_t end, const JobContext& job) {
    const survey::Index& n = size();
    if (first != first_ || end != end_) {
      first_ = end_ = 0;
      const std::int64_t plane = n[1] * n[2];
      samples_.resize(static_cast<std::size_t>((end - first) * plane));
      const std::int64_t chunk = reader_.info().chunk[0];
      for (std::int64_t i = first; i < end;) {
        job.check();
        const std::int64_t next = std::min(end, (i / chunk + 1) * chunk);
        reader_.read({{i, 0, 0}, {next, n[1], n[2]}},
                     std::span(samples_).subspan(static_cast<std::size_t>((i - first) * plane),
                                                 static_cast<std::size_t>((next - i) * plane)));
        i = next;
      }
      first_ = first;
      end_ = end;
    }
    return {.values = samples_, .size = {end - first, n[1], n[2]}, .origin = {first, 0, 0}, .volume_size = n};
  }

 private:
  std::filesystem::path path_;
  std::string checksum_;
  volume::VolumeReader reader_;
  volume::MinMaxLevel ranges_;
  std::vector<float> samples_;
  std::int64_t first_ = 0, end_ = 0;
};

IsosurfaceMaker::IsosurfaceMaker(Events events, std::size_t most_triangles, std::int64_t most_sample_bytes)
    : events_(std::move(events)),
      most_triangles_(most_triangles),
      most_sample_bytes_(most_sample_bytes),
      thread_([this] { work(); }) {}

IsosurfaceMaker::~IsosurfaceMaker() {
  {
    const std::scoped_lock lock(mutex_);
    ends_ = true;
    job_.cancel();
  }
  wake_.notify_one();
  thread_.join();
}

std::set<Id> IsosurfaceMaker::want(std::vector<IsosurfaceRequest> requests) {
  std::set<Id> awaited;
  {
    const std::scoped_lock lock(mutex_);
    std::map<Id, Wanted> now;
    for (IsosurfaceRequest& request : requests) {
      const Id id = request.isosurface;
      const auto known = wanted_.find(id);
      const bool is_done =
          known != wanted_.end() && is_same(known->second.request, request) && known->second.is_done;
      if (!is_done) awaited.insert(id);
      now[id] = {std::move(request), is_done};
    }
    const auto before = wanted_.find(under_way_);
    const auto after = now.find(under_way_);
    const bool overtaken = before != wanted_.end() &&
                           (after == now.end() || !is_same(before->second.request, after->second.request));
    if (overtaken) job_.cancel();
    wanted_ = std::move(now);
  }
  wake_.notify_one();
  return awaited;
}

void IsosurfaceMaker::work() {
  std::unique_lock lock(mutex_);
  const auto next = [this] {
    return std::ranges::find_if(wanted_, [](const auto& entry) { return !entry.second.is_done; });
  };
  for (;;) {
    wake_.wait(lock,
               [&] { return ends_ || next() != wanted_.end() || (wanted_.empty() && volume_ != nullptr); });
    if (ends_) return;
    if (next() == wanted_.end()) {
      volume_.reset();  // its samples are of no use any more
      continue;
    }
    const IsosurfaceRequest request = next()->second.request;
    under_way_ = request.isosurface;
    job_ = JobContext([this](const Progress& progress) { events_.progress(progress.fraction); });
    const JobContext job = job_;
    lock.unlock();
    std::shared_ptr<const IsosurfaceShape> shape;
    std::string message, hint;
    try {
      shape = make(request, job);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::kCancelled) {
        message = error.message();
        hint = error.hint();
      }
    } catch (const std::exception& error) {
      message = error.what();
    }
    lock.lock();
    under_way_ = 0;
    const auto now = wanted_.find(request.isosurface);
    if (now == wanted_.end() || !is_same(now->second.request, request)) continue;  // overtaken
    if (shape == nullptr && message.empty()) continue;  // cancelled, and wanted again since
    now->second.is_done = true;
    lock.unlock();
    if (shape != nullptr) {
      events_.made(std::move(shape));
    } else {
      events_.failed(request, message, hint);
    }
    lock.lock();
  }
}

std::shared_ptr<const IsosurfaceShape> IsosurfaceMaker::make(const IsosurfaceRequest& request,
                                                             const JobContext& job) {
  if (volume_ == nullptr || !volume_->is_of(request)) {
    volume_.reset();
    volume_ = std::make_unique<Volume>(request);
  }
  const survey::Index n = volume_->size();
  const auto value = static_cast<float>(request.value);
  const isosurface::Bricks bricks = volume_->bricks();
  auto shape = std::make_shared<IsosurfaceShape>();
  shape->isosurface = request.isosurface;
  shape->value = request.value;
  // 1. Slabs of inlines, each with a sample more at either side for the gradients.
  const std::int64_t plane = n[1] * n[2];
  const std::int64_t planes =
      std::max<std::int64_t>(4, most_sample_bytes_ / (4 * std::max<std::int64_t>(1, plane)));
  const bool whole = planes >= n[0];
  const std::int64_t cells = n[0] - 1;
  const std::int64_t slab = whole ? cells : std::max<std::int64_t>(1, (planes - 3) / kBrick * kBrick);
  const std::int64_t at_once =
      std::max<std::int64_t>(kBrick, kCellsAtOnce / std::max<std::int64_t>(1, plane) / kBrick * kBrick);
  isosurface::ExtractOptions options;
  options.threads = threads_to_use();
  options.bricks = &bricks;
  isosurface::Surface part;
  for (std::int64_t first = 0; first < cells; first += slab) {
    const std::int64_t end = std::min(cells, first + slab);
    for (std::int64_t i = first; i < end; i += at_once) {
      job.report(0.8 * static_cast<double>(i) / static_cast<double>(cells), "extract");
      const std::int64_t to = std::min(end, i + at_once);
      if (!volume_->may_cross(i, to, value)) continue;
      const isosurface::Field field =
          whole ? volume_->slab(0, n[0], job)
                : volume_->slab(std::max<std::int64_t>(0, first - 1), std::min(n[0], end + 2), job);
      options.cells = survey::Box{{i, 0, 0}, {to, n[1] - 1, n[2] - 1}};
      isosurface::extract(field, value, options, part);
      if (shape->triangles() + part.triangles.size() > most_triangles_) {
        throw Error(
            ErrorCode::kInvalid,
            fmt::format("{} = {:g} has more than {} triangles", request.name, request.value, most_triangles_),
            "show it as a picture by the engine, or choose another value");
      }
      append(part, request.place, *shape);
    }
  }
  // 2. What picks and coarse frames need.
  job.report(0.8, "order");
  shape->tree = RayTree(shape->positions, shape->corners);
  for (std::size_t level = 0; level < shape->coarse.size(); ++level) {
    job.report(0.85 + 0.05 * static_cast<double>(level), "order");
    shape->coarse[level] =
        coarse_faces(shape->positions, shape->corners, shape->tree.bounds(), IsosurfaceShape::kCoarse[level]);
  }
  job.report(1, "order");
  return shape;
}

}  // namespace footwall::ui
