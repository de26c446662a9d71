#include "engine/extract/measure_rates.h"

#include <omp.h>
#include <time.h>

#include <algorithm>
#include <array>
#include <limits>

#include "engine/comm/rank_grid.h"
#include "engine/extract/balance/balance.h"
#include "engine/extract/computations.h"
#include "engine/extract/face_rows.h"
#include "engine/extract/fold_rows.h"
#include "engine/extract/statistics/discontinuity.h"
#include "engine/voxelize/registry.h"
#include "storage/base/error.h"

namespace footwall::extract {
namespace {

// Larger than the caches that a core has to itself, as surveys are; small enough to be filled at once.
constexpr survey::Index kDims{144, 144, 128};
constexpr std::int32_t kLegVoxels =
    44;  // of a face of about 1,000 voxel^2, the size in the seed's benchmarks
constexpr std::size_t kFaces = 256;
constexpr double kAmplitude = 1000;
constexpr int kBalancedRanks = 8;
constexpr double kDecibels = 40;  // asked of a coder

// In processor time of the calling thread.
double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Numbers without pattern, the same on every machine.
class Dice {
 public:
  std::uint64_t roll() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return state_ >> 33;
  }
  std::int32_t below(std::int64_t end) {
    return static_cast<std::int32_t>(roll() % static_cast<std::uint64_t>(end));
  }

 private:
  std::uint64_t state_ = 20260101;
};

class Stage {
 public:
  explicit Stage(std::size_t faces, std::int32_t leg) : block_({{0, 0, 0}, kDims}, kDims) {
    Dice dice;
    std::vector<float> values(static_cast<std::size_t>(survey_.count()));
    for (float& value : values) value = static_cast<float>(kAmplitude * (dice.below(2001) - 1000) / 1000.0);
    block_.put(survey_, values);
    for (std::size_t n = 0; n < faces; ++n) {
      survey::LatticeTriangle triangle;
      const std::array<std::int32_t, 3> at{corner(dice, 0, leg), corner(dice, 1, leg), corner(dice, 2, leg)};
      for (survey::LatticePoint& p : triangle) {
        p = {at[0] + dice.below(leg * kVoxel), at[1] + dice.below(leg * kVoxel),
             at[2] + dice.below(leg * kVoxel)};
      }
      Face face;
      face.triangle = triangle;
      faces_.push_back(face);
    }
  }

  const survey::Box& survey() const { return survey_; }
  const Block& block() const { return block_; }
  const std::vector<Face>& faces() const { return faces_; }

 private:
  static constexpr std::int32_t kVoxel = survey::kLatticePerVoxel;
  static std::int32_t corner(Dice& dice, std::size_t axis, std::int32_t leg) {
    return dice.below((kDims[axis] - leg - 1) * kVoxel);
  }

  survey::Box survey_{{0, 0, 0}, kDims};
  Block block_;
  std::vector<Face> faces_;
};

// Seconds of work(face) for each unit that it returns, over face after face for about `seconds`. A first
// round over some faces warms up what the work allocates.
template <typename Work>
double per_unit(const std::vector<Face>& faces, double seconds, Work&& work) {
  constexpr std::size_t kWarm = 8;
  for (std::size_t n = 0; n < std::min(kWarm, faces.size()); ++n) work(faces[n]);
  double units = 0;
  const double start = thread_seconds();
  double spent = 0;
  for (std::size_t n = 0; spent < seconds; n = (n + 1) % faces.size()) {
    units += static_cast<double>(work(faces[n]));
    spent = thread_seconds() - start;
  }
  return units > 0 ? spent / units : spent;
}

class VoxelCounter final : public voxelize::RowSink {
 public:
  void row(const voxelize::Row& row) override { voxels += voxelize::voxels_in(row); }
  std::int64_t voxels = 0;
};

// The values of a face's rows, in their order.
void look_up(const Block& block, const FaceRows& rows, std::vector<float>& values) {
  values.clear();
  rows.for_each([&](const survey::Index& voxel) { values.push_back(block.data()[block.offset(voxel)]); });
}

class Measurement {
 public:
  explicit Measurement(double seconds) : stage_(kFaces, kLegVoxels), share_(seconds / kSteps) {}

  double voxelize() {
    return per_unit(stage_.faces(), share_, [&](const Face& face) {
      VoxelCounter counter;
      voxelizer_->rows(face.triangle, stage_.survey(), counter);
      return counter.voxels;
    });
  }
  double fold(bool with_discontinuity) {
    RowFolder folder(stage_.block(), with_discontinuity, discontinuity_scale(kAmplitude));
    return per_unit(stage_.faces(), share_, [&](const Face& face) {
      voxelizer_->rows(face.triangle, stage_.survey(), folder);
      return folder.take().voxels();
    });
  }
  // Without the voxelizing.
  double gather() {
    const double both = per_unit(stage_.faces(), share_, [&](const Face& face) {
      list(face);
      look_up(stage_.block(), rows_, values_);
      Moments moments;
      extract::fold(values_, moments);
      return moments.count;
    });
    return both;
  }
  double listing() {
    return per_unit(stage_.faces(), share_, [&](const Face& face) {
      list(face);
      return rows_.voxels();
    });
  }
  // Coordinates into a message, values out of the volume into another, and those into a table.
  double pack() {
    std::vector<std::array<std::int32_t, 3>> request;
    std::vector<float> table(static_cast<std::size_t>(stage_.survey().count()));
    return per_unit(stage_.faces(), share_,
                    [&](const Face& face) {
                      list(face);
                      request.clear();
                      rows_.for_each([&](const survey::Index& p) {
                        request.push_back({static_cast<std::int32_t>(p[0]), static_cast<std::int32_t>(p[1]),
                                           static_cast<std::int32_t>(p[2])});
                      });
                      look_up(stage_.block(), rows_, values_);
                      for (std::size_t n = 0; n < request.size(); ++n) {
                        const auto& p = request[n];
                        table[static_cast<std::size_t>((p[0] * kDims[1] + p[1]) * kDims[2] + p[2])] =
                            values_[n];
                      }
                      return rows_.voxels();
                    }) /
           3;  // listed, looked up, entered: the model counts each
  }
  double finish() {
    RowFolder folder(stage_.block(), false, 0);
    voxelizer_->rows(stage_.faces().front().triangle, stage_.survey(), folder);
    const Partial partial = folder.take();
    std::vector<std::byte> record;
    return per_unit(stage_.faces(), share_, [&](const Face&) {
      record.clear();
      encode(1, partial, record);
      std::span<const std::byte> bytes(record);
      Partial read;
      decode(bytes, read);
      read.merge(partial);
      return extract::finish(read, true).count > 0 ? 2 : 1;  // a writer and a reader
    });
  }
  double balance() {
    const comm::RankGrid grid(kDims, kBalancedRanks);
    const Choice choice = parse_choice("minimal");
    const BalanceStrategy& strategy = balance_strategy(choice.name);
    return per_unit({stage_.faces().front()}, share_, [&](const Face&) {
      return strategy.run({grid, stage_.faces(), choice, {}}).size();
    });
  }
  // Of one computation that needs a face's voxels, without voxelizing and looking up.
  double whole_face(const Computation& computation) {
    Options options;
    options.snr = kDecibels;
    const std::unique_ptr<WholeFace> work = computation.make(options);
    std::vector<std::byte> out;
    return per_unit(stage_.faces(), share_, [&](const Face& face) {
      list(face);
      look_up(stage_.block(), rows_, values_);
      out.clear();
      work->compute({face, rows_, values_}, out);
      return rows_.voxels();
    });
  }

 private:
  static constexpr double kSteps = 10;
  void list(const Face& face) {
    rows_.clear();
    voxelizer_->rows(face.triangle, stage_.survey(), rows_);
  }

  Stage stage_;
  double share_;
  std::unique_ptr<voxelize::Voxelizer> voxelizer_ = voxelize::make_voxelizer();
  FaceRows rows_;
  std::vector<float> values_;
};

}  // namespace

MachineRates measure_computing(double seconds) {
  Measurement measurement(seconds);
  MachineRates rates;
  rates.voxelize = measurement.voxelize();
  rates.fold = measurement.fold(false);
  rates.fold_discontinuity = measurement.fold(true);
  const double listing = measurement.listing();
  const double gathering = measurement.gather();
  constexpr double kLeast = 1e-11;  // what cannot be told from nothing: well under a cycle
  rates.gather = std::max(kLeast, gathering - listing);
  rates.pack = std::max(kLeast, measurement.pack());
  rates.finish = measurement.finish();
  rates.balance = measurement.balance();
  for (const Computation& computation : computations()) {
    if (computation.make == nullptr || !computation.built) continue;
    const double all = measurement.whole_face(computation);
    rates.whole_face.push_back({std::string(computation.name), std::max(kLeast, all - gathering)});
  }
  // A face of next to no voxels costs what every face costs.
  const Stage small(kFaces, 1);
  const auto voxelizer = voxelize::make_voxelizer();
  RowFolder folder(small.block(), false, 0);
  rates.face = per_unit(small.faces(), seconds / 9, [&](const Face& face) {
    voxelizer->rows(face.triangle, small.survey(), folder);
    return folder.take().voxels() > 0 ? 1 : 0;
  });
  return rates;
}

double measure_folding(int threads, double seconds) {
  const Stage stage(kFaces, kLegVoxels);
  double voxels = 0;
  double longest = 0;
  bool failed = false;
#pragma omp parallel num_threads(threads) reduction(+ : voxels) reduction(max : longest) reduction(|| : failed)
  {
    try {
      const auto voxelizer = voxelize::make_voxelizer();
      RowFolder folder(stage.block(), false, 0);
      const auto fold = [&](std::size_t n) {
        voxelizer->rows(stage.faces()[n % kFaces].triangle, stage.survey(), folder);
        return static_cast<double>(folder.take().voxels());
      };
      auto n = static_cast<std::size_t>(omp_get_thread_num()) * kFaces / static_cast<std::size_t>(threads);
      fold(n);
#pragma omp barrier
      const double start = omp_get_wtime();
      while (longest < seconds) {
        voxels += fold(++n);
        longest = omp_get_wtime() - start;
      }
    } catch (...) {
      failed = true;
    }
  }
  require(!failed, "faces of a small volume fold");
  return longest * threads / voxels;
}

}  // namespace footwall::extract
