// The responsible rank voxelizes its faces and asks the owners for exactly the voxels that it lacks.
// Based on: seed 004, section 3.4.1 (strategy 1, minimum communication); differs in that a rank's halo counts
// as its own, and in that nothing is kept for a next extraction. Steps: 1 voxelize the faces of this rank
// over the whole survey, listing voxels; 2 exchange: requests, 12 bytes a voxel, each voxel once per pair of
// ranks; 3 exchange: the values, 4 bytes each, in the same order; 4 compute.
#include <omp.h>

#include <array>
#include <cstring>
#include <tuple>

#include "engine/extract/exchange/exchange.h"
#include "engine/extract/parallel_faces.h"
#include "engine/extract/statistics/partial.h"
#include "engine/voxelize/registry.h"

namespace footwall::extract {
namespace {

using Coordinates = std::array<std::int32_t, 3>;
static_assert(sizeof(Coordinates) == 12);

// Lists a face's voxels.
class Lister final : public voxelize::RowSink {
 public:
  explicit Lister(std::vector<Coordinates>& out) : out_(out) {}
  void row(const voxelize::Row& row) override {
    Coordinates p{};
    p[static_cast<std::size_t>(row.v_axis)] = static_cast<std::int32_t>(row.v);
    for (std::size_t n = 0; n < row.lo.size(); ++n) {
      p[static_cast<std::size_t>(row.u_axis)] =
          static_cast<std::int32_t>(row.u0 + static_cast<std::int64_t>(n));
      for (std::int32_t w = row.lo[n]; w <= row.hi[n]; ++w) {
        p[static_cast<std::size_t>(row.w_axis)] = w;
        out_.push_back(p);
      }
    }
  }

 private:
  std::vector<Coordinates>& out_;
};

survey::Index index_of(const Coordinates& p) {
  return {p[0], p[1], p[2]};
}

// The faces of this rank, the voxels of each, and the voxels that must be fetched.
struct Plan {
  std::vector<std::size_t> faces;
  std::vector<std::vector<Coordinates>> voxels;
  std::vector<Coordinates> missing;  // ordered, each once
};

class Values {
 public:
  Values(const Setup& setup, const Plan& plan)
      : setup_(setup),
        survey_{{0, 0, 0}, setup.input.dims},
        ids_(plan.missing),
        values_(plan.missing.size()) {}

  std::vector<float>& fetched() { return values_; }
  // NaN for nulls and outside the survey.
  float at(const Coordinates& p) const {
    const survey::Index voxel = index_of(p);
    if (!survey_.contains(voxel)) return std::numeric_limits<float>::quiet_NaN();
    if (const Block* block = setup_.blocks.holding(voxel)) return block->data()[block->offset(voxel)];
    const auto found = std::lower_bound(ids_.begin(), ids_.end(), p);
    require(found != ids_.end() && *found == p, "a voxel that was asked for");
    return values_[static_cast<std::size_t>(found - ids_.begin())];
  }

 private:
  const Setup& setup_;
  survey::Box survey_;
  const std::vector<Coordinates>& ids_;
  std::vector<float> values_;
};

void sort_and_unique(std::vector<Coordinates>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

Plan voxelize_mine(const Setup& setup) {
  Plan plan;
  for (std::size_t n = 0; n < setup.input.faces.size(); ++n) {
    if (setup.mine(n)) plan.faces.push_back(n);
  }
  plan.voxels.resize(plan.faces.size());
  const survey::Box survey{{0, 0, 0}, setup.input.dims};
  const std::int32_t reach = setup.reach();
  std::vector<std::unique_ptr<voxelize::Voxelizer>> voxelizers(static_cast<std::size_t>(setup.threads));
  for (auto& voxelizer : voxelizers) voxelizer = voxelize::make_voxelizer(setup.options.voxelizer);
  std::vector<std::vector<Coordinates>> missing(voxelizers.size());
  parallel_faces(plan.faces.size(), setup.threads, setup.job, "voxelize",
                 [&](std::size_t thread, std::size_t n) {
                   Lister lister(plan.voxels[n]);
                   voxelizers[thread]->rows(setup.face(plan.faces[n]).triangle, survey, lister);
                   std::vector<Coordinates> lacking;
                   for (const Coordinates& p : plan.voxels[n]) {
                     for (std::int32_t di = -reach; di <= reach; ++di) {
                       for (std::int32_t dj = -reach; dj <= reach; ++dj) {
                         const Coordinates neighbour{p[0] + di, p[1] + dj, p[2]};
                         const survey::Index voxel = index_of(neighbour);
                         if (survey.contains(voxel) && setup.blocks.holding(voxel) == nullptr)
                           lacking.push_back(neighbour);
                       }
                     }
                   }
                   sort_and_unique(lacking);
                   missing[thread].insert(missing[thread].end(), lacking.begin(), lacking.end());
                 });
  for (std::vector<Coordinates>& part : missing) {
    plan.missing.insert(plan.missing.end(), part.begin(), part.end());
    part = {};
  }
  sort_and_unique(plan.missing);
  return plan;
}

template <typename T>
void append(const T& value, comm::Bytes& bytes) {
  const auto raw = std::as_bytes(std::span(&value, 1));
  bytes.insert(bytes.end(), raw.begin(), raw.end());
}

template <typename T>
T item(const comm::Bytes& bytes, std::size_t n) {
  T value;
  std::memcpy(&value, bytes.data() + n * sizeof(T), sizeof(T));
  return value;
}

std::vector<comm::Bytes> requests_of(const Setup& setup, const Plan& plan) {
  std::vector<comm::Bytes> requests(static_cast<std::size_t>(setup.world.size()));
  for (const Coordinates& p : plan.missing) {
    append(p, requests[static_cast<std::size_t>(setup.grid.owner(index_of(p)))]);
  }
  return requests;
}

std::vector<comm::Bytes> answers_to(const Setup& setup, const std::vector<comm::Bytes>& requests) {
  std::vector<comm::Bytes> answers(requests.size());
  for (std::size_t r = 0; r < requests.size(); ++r) {
    const std::size_t count = requests[r].size() / sizeof(Coordinates);
    answers[r].reserve(count * sizeof(float));
    for (std::size_t n = 0; n < count; ++n) {
      const survey::Index voxel = index_of(item<Coordinates>(requests[r], n));
      const Block* block = setup.blocks.owning(voxel);
      require(block != nullptr, "a request for a voxel of this rank");
      append(block->data()[block->offset(voxel)], answers[r]);
    }
  }
  return answers;
}

void take_answers(const Setup& setup, const Plan& plan, const std::vector<comm::Bytes>& answers,
                  Values& values) {
  std::vector<std::size_t> next(answers.size(), 0);
  for (std::size_t n = 0; n < plan.missing.size(); ++n) {
    const auto owner = static_cast<std::size_t>(setup.grid.owner(index_of(plan.missing[n])));
    require((next[owner] + 1) * sizeof(float) <= answers[owner].size(), "an answer for every request");
    values.fetched()[n] = item<float>(answers[owner], next[owner]++);
  }
}

Partial folded(const Setup& setup, const std::vector<Coordinates>& voxels, const Values& values) {
  Partial partial;
  if (!setup.with_discontinuity) {
    std::vector<float> own(voxels.size());
    std::transform(voxels.begin(), voxels.end(), own.begin(),
                   [&](const Coordinates& p) { return values.at(p); });
    fold(own, partial.moments);
    return partial;
  }
  Windows windows;
  for (std::size_t first = 0; first < voxels.size(); first += kWindowBlock) {
    const std::size_t n = std::min(kWindowBlock, voxels.size() - first);
    for (std::size_t v = 0; v < n; ++v) {
      const Coordinates& p = voxels[first + v];
      for (std::size_t k = 0; k < kNeighbours; ++k) {
        windows.value[k][v] = values.at(
            {p[0] + static_cast<std::int32_t>(k / 3) - 1, p[1] + static_cast<std::int32_t>(k % 3) - 1, p[2]});
      }
    }
    fold(std::span(windows.value[kNeighbours / 2], n), partial.moments);
    fold_windows(windows, n, setup.scale, partial.discontinuity);
  }
  return partial;
}

// The whole-face results of a face; `rows`, `values` and `tools` are one thread's.
void compute_blobs(const Setup& setup, std::size_t face, const std::vector<Coordinates>& voxels,
                   const Values& all, voxelize::Voxelizer& voxelizer, FaceRows& rows,
                   std::vector<float>& values, std::span<const std::unique_ptr<WholeFace>> tools,
                   std::vector<FinishedBlob>& blobs) {
  rows.clear();
  voxelizer.rows(setup.face(face).triangle, {{0, 0, 0}, setup.input.dims}, rows);
  values.resize(voxels.size());
  std::transform(voxels.begin(), voxels.end(), values.begin(),
                 [&](const Coordinates& p) { return all.at(p); });
  for (std::size_t c = 0; c < tools.size(); ++c) {
    FinishedBlob& blob = blobs.emplace_back(FinishedBlob{static_cast<std::int64_t>(face), c, {}});
    tools[c]->compute({setup.face(face), rows, values}, blob.bytes);
  }
}

}  // namespace

Outcome exchange_minimum(const Setup& setup) {
  Outcome outcome;
  comm::Communicator& world = setup.world;
  const double start = omp_get_wtime();
  const Plan plan = world.collectively([&] { return voxelize_mine(setup); });
  const double voxelized = omp_get_wtime();

  std::vector<comm::Bytes> requests = world.collectively([&] { return requests_of(setup, plan); });
  const std::vector<comm::Bytes> asked = world.exchange(std::move(requests));
  std::vector<comm::Bytes> answers = world.collectively([&] { return answers_to(setup, asked); });
  const std::vector<comm::Bytes> replies = world.exchange(std::move(answers));
  const double exchanged = omp_get_wtime();

  outcome.finished = world.collectively([&] {
    Values values(setup, plan);
    take_answers(setup, plan, replies, values);
    std::vector<Finished> finished(plan.faces.size());
    struct Worker {
      std::unique_ptr<voxelize::Voxelizer> voxelizer;
      std::vector<std::unique_ptr<WholeFace>> tools;
      FaceRows rows;
      std::vector<float> values;
      std::vector<FinishedBlob> blobs;
    };
    std::vector<Worker> workers(static_cast<std::size_t>(setup.threads));
    for (Worker& worker : workers) {
      worker.voxelizer = voxelize::make_voxelizer(setup.options.voxelizer);
      for (const Computation* each : setup.whole_face) worker.tools.push_back(each->make(setup.options));
    }
    parallel_faces(
        finished.size(), setup.threads, setup.job, "compute", [&](std::size_t thread, std::size_t n) {
          Worker& w = workers[thread];
          if (!w.tools.empty()) {
            compute_blobs(setup, plan.faces[n], plan.voxels[n], values, *w.voxelizer, w.rows, w.values,
                          w.tools, w.blobs);
          }
          const Partial partial = folded(setup, plan.voxels[n], values);
          finished[n] = {static_cast<std::int64_t>(plan.faces[n]),
                         finish(partial, inside(setup.face(plan.faces[n]).triangle, setup.input.dims))};
        });
    for (Worker& worker : workers) {
      std::move(worker.blobs.begin(), worker.blobs.end(), std::back_inserter(outcome.blobs));
    }
    return finished;
  });
  for (const auto& voxels : plan.voxels) outcome.walked += static_cast<std::int64_t>(voxels.size());
  outcome.seconds.voxelize = voxelized - start;
  outcome.seconds.exchange = exchanged - voxelized;
  outcome.seconds.compute = omp_get_wtime() - exchanged;
  return outcome;
}

}  // namespace footwall::extract
