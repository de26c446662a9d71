#include "engine/tasks/bench_quality.h"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "engine/extract/discontinuity_volume.h"
#include "engine/extract/face_rows.h"
#include "engine/extract/fold_rows.h"
#include "engine/extract/probes.h"
#include "engine/extract/statistics/profile.h"
#include "engine/synthetic/faulted.h"
#include "engine/voxelize/registry.h"
#include "storage/base/error.h"
#include "storage/survey/lattice.h"
#include "storage/survey/vector.h"

namespace footwall::tasks {
namespace {

using Vector = survey::Vector3;  // in index space, in voxels

// a + t b
Vector moved(const Vector& a, double t, const Vector& b) {
  return {a.x + t * b.x, a.y + t * b.y, a.z + t * b.z};
}
Vector unit(const Vector& a) {
  return moved({0, 0, 0}, 1 / std::sqrt(dot(a, a)), a);
}

// The true surface of a fault in index space.
class Truth {
 public:
  Truth(const survey::Surface& surface, const survey::Geometry& geometry) {
    std::vector<Vector> corners;
    for (const survey::WorldPoint& p : surface.vertices) {
      const survey::IndexPoint at = geometry.index_of(p);
      corners.push_back({at.i, at.j, at.k});
    }
    for (const auto& t : surface.triangles) {
      const auto corner = [&](std::size_t n) { return corners[static_cast<std::size_t>(t[n])]; };
      const Triangle triangle{corner(0), corner(1), corner(2)};
      const Vector normal = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
      const double area = std::sqrt(dot(normal, normal)) / 2;
      if (area < 1e-6) continue;
      triangles_.push_back(triangle);
      area_.push_back((area_.empty() ? 0 : area_.back()) + area);
    }
  }
  bool empty() const { return triangles_.empty(); }

  // A random true face with legs of `leg` voxels; none where its corners do not meet the surface.
  std::optional<survey::LatticeTriangle> face(double leg, const survey::Lattice& lattice,
                                              std::mt19937_64& random) const {
    const auto draw = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    const auto chosen = std::upper_bound(area_.begin(), area_.end() - 1, draw() * area_.back());
    const Triangle& t = triangles_[static_cast<std::size_t>(chosen - area_.begin())];
    double u = draw();
    double v = draw();
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const Vector centre = moved(moved(t[0], u, t[1] - t[0]), v, t[2] - t[0]);
    const Vector normal = unit(cross(t[1] - t[0], t[2] - t[0]));
    const Vector east = unit(t[1] - t[0]);
    const Vector north = cross(normal, east);
    double turn_a = 0;
    double turn_b = 0;
    do {  // a random direction in the plane
      turn_a = 2 * draw() - 1;
      turn_b = 2 * draw() - 1;
    } while (turn_a * turn_a + turn_b * turn_b > 1 || turn_a * turn_a + turn_b * turn_b < 0.01);
    const Vector a = unit(moved(moved({0, 0, 0}, turn_a, east), turn_b, north));
    const Vector b = cross(normal, a);
    survey::LatticeTriangle face;
    for (std::size_t n = 0; n < 3; ++n) {
      const double along_a = (n == 1 ? 2.0 : -1.0) / 3 * leg;
      const double along_b = (n == 2 ? 2.0 : -1.0) / 3 * leg;
      const auto corner = on_surface(moved(moved(centre, along_a, a), along_b, b), normal, leg / 2);
      if (!corner) return std::nullopt;
      face[n] = lattice.from_index({corner->x, corner->y, corner->z});
    }
    return face;
  }

 private:
  using Triangle = std::array<Vector, 3>;

  // Where the line through p along n meets the surface nearest to p, at most `reach` away.
  std::optional<Vector> on_surface(const Vector& p, const Vector& n, double reach) const {
    std::optional<double> best;
    for (const Triangle& t : triangles_) {
      const Vector e1 = t[1] - t[0];
      const Vector e2 = t[2] - t[0];
      const Vector h = cross(n, e2);
      const double determinant = dot(e1, h);
      if (std::abs(determinant) < 1e-12) continue;
      const Vector s = p - t[0];
      const double u = dot(s, h) / determinant;
      const Vector q = cross(s, e1);
      const double v = dot(n, q) / determinant;
      if (u < -1e-9 || v < -1e-9 || u + v > 1 + 1e-9) continue;
      const double distance = dot(e2, q) / determinant;
      if (std::abs(distance) <= reach && (!best || std::abs(distance) < std::abs(*best))) best = distance;
    }
    if (!best) return std::nullopt;
    return moved(p, *best, n);
  }

  std::vector<Triangle> triangles_;
  std::vector<double> area_;  // running sum
};

// A synthetic survey in memory, and the numbers of faces in it.
class Measured {
 public:
  Measured(const synthetic::FaultedSurvey& survey, const JobContext& job)
      : box_(survey.geometry().box()),
        block_(box_, survey.geometry().dims()),
        voxelizer_(voxelize::make_voxelizer()) {
    const survey::Index dims = survey.geometry().dims();
    const survey::Index slab_step{16, dims[1], dims[2]};
    double max_abs = 0;
    std::vector<float> values;
    for (std::int64_t i = 0; i < dims[0]; i += slab_step[0]) {
      job.report(static_cast<double>(i) / static_cast<double>(dims[0]) / 2, "make a survey");
      const survey::Box slab{{i, 0, 0}, {std::min(i + slab_step[0], dims[0]), dims[1], dims[2]}};
      values.resize(static_cast<std::size_t>(slab.count()));
      survey.fill(slab, values);
      for (const float value : values) max_abs = std::max(max_abs, std::abs(static_cast<double>(value)));
      block_.put(slab, values);
    }
    folder_.emplace(block_, true, extract::discontinuity_scale(max_abs));
    attribute_.resize(static_cast<std::size_t>(box_.count()));
    extract::DiscontinuityVolume kernel({}, dims, max_abs);
    for (std::int64_t i = 0; i < dims[0]; i += slab_step[0]) {
      job.report(0.5 + static_cast<double>(i) / static_cast<double>(dims[0]) / 2, "make its discontinuity");
      const survey::Box slab{{i, 0, 0}, {std::min(i + slab_step[0], dims[0]), dims[1], dims[2]}};
      const survey::Box needed = extract::needed_for(slab, {}, dims);
      values.resize(static_cast<std::size_t>(needed.count()));
      float* to = values.data();
      for (std::int64_t p = needed.lo[0]; p < needed.hi[0]; ++p) {
        for (std::int64_t q = needed.lo[1]; q < needed.hi[1]; ++q, to += dims[2])
          std::copy_n(block_.data() + block_.offset({p, q, 0}), dims[2], to);
      }
      kernel.compute(slab, values,
                     std::span(attribute_)
                         .subspan(static_cast<std::size_t>(i * dims[1] * dims[2]),
                                  static_cast<std::size_t>(slab.count())));
    }
  }

  extract::FaceStatistics statistics(const survey::LatticeTriangle& face) {
    voxelizer_->rows(face, box_, *folder_);
    return extract::finish(folder_->take(), true);
  }
  // Discontinuities at the shifts from -most to most that are asked for.
  extract::Profile profile(const survey::LatticeTriangle& face, std::span<const int> shifts) {
    extract::Profile profile;
    for (const int shift : shifts) {
      const auto probe = extract::shifted(face, shift);
      if (!probe) continue;
      const extract::FaceStatistics there = statistics(*probe);
      profile.set(shift, there.count, there.discontinuity);
    }
    return profile;
  }
  // The mean of the attribute volume.
  double attribute(const survey::LatticeTriangle& face) {
    rows_.clear();
    voxelizer_->rows(face, box_, rows_);
    double sum = 0;
    std::int64_t count = 0;
    rows_.for_each([&](const survey::Index& p) {
      const float value =
          attribute_[static_cast<std::size_t>((p[0] * box_.size(1) + p[1]) * box_.size(2) + p[2])];
      if (std::isnan(value)) return;
      sum += value;
      ++count;
    });
    return count == 0 ? extract::kUndefined : sum / static_cast<double>(count);
  }

 private:
  survey::Box box_;
  extract::Block block_;
  std::unique_ptr<voxelize::Voxelizer> voxelizer_;
  std::optional<extract::RowFolder> folder_;
  std::vector<float> attribute_;
  extract::FaceRows rows_;
};

struct Scores {
  double contrast, discontinuity, attribute, variance;
  bool defined() const {
    return !std::isnan(contrast) && !std::isnan(discontinuity) && !std::isnan(attribute) &&
           !std::isnan(variance);
  }
};

Scores scores_of(const survey::LatticeTriangle& face, Measured& in) {
  constexpr std::array kShifts{-extract::kContrastShift, extract::kContrastShift};
  const extract::FaceStatistics own = in.statistics(face);
  Scores scores{in.profile(face, kShifts).contrast(own.discontinuity), own.discontinuity, in.attribute(face),
                own.variance};
  if (own.count < extract::kLeastSamples) scores.contrast = extract::kUndefined;
  return scores;
}

double win(double is, double other) {
  return is > other ? 1 : is == other ? 0.5 : 0;
}

void compare(const survey::LatticeTriangle& face, Measured& in, QualityOfLeg& leg) {
  const Scores is = scores_of(face, in);
  for (const int side : {-extract::kContrastShift, extract::kContrastShift}) {
    const auto beside = extract::shifted(face, side);
    if (!beside || !is.defined()) continue;
    const Scores other = scores_of(*beside, in);
    if (!other.defined()) continue;
    ++leg.pairs;
    leg.chance.contrast += win(is.contrast, other.contrast);
    leg.chance.discontinuity += win(is.discontinuity, other.discontinuity);
    leg.chance.attribute += win(is.attribute, other.attribute);
    leg.chance.variance += win(is.variance, other.variance);
  }
}

void find_again(const survey::LatticeTriangle& face, int away, Measured& in, QualityOfLeg& leg) {
  constexpr std::array kShifts{-8, -7, -6, -5, -4, -3, -2, -1, 0, 1, 2, 3, 4, 5, 6, 7, 8};
  const auto beside = extract::shifted(face, away);
  if (!beside) return;
  const double found = in.profile(*beside, kShifts).peak().shift;
  if (std::isnan(found)) return;
  ++leg.offsets;
  leg.within_one += std::abs(found + away) <= 1 ? 1 : 0;
}

void check(const BenchQualityOptions& options) {
  const auto refuse = [](const std::string& what, const std::string& hint) {
    throw Error(ErrorCode::kUsage, what, hint);
  };
  if (options.volumes < 1 || options.faces < 1) refuse("there is nothing to measure", "give 1 or more");
  if (options.legs.empty()) refuse("there are no legs", "give lengths in voxels, such as 8,16,32");
  for (const int leg : options.legs) {
    if (leg < 4 || leg > 64) refuse(fmt::format("legs of {} voxels", leg), "give 4 to 64");
  }
}

}  // namespace

BenchQualityResult bench_quality(const BenchQualityOptions& options, const JobContext& job) {
  check(options);
  const double start = omp_get_wtime();
  BenchQualityResult result;
  for (const int leg : options.legs) result.legs.push_back({leg, 0, 0, {}, 0, 0});
  for (int n = 0; n < options.volumes; ++n) {
    const double share = 1.0 / options.volumes;
    const JobContext part = job.part(n * share, (n + 1) * share);
    synthetic::Options made;
    made.size = options.size;
    made.seed = options.seed + static_cast<std::uint64_t>(n);
    const synthetic::FaultedSurvey survey(made);
    if (survey.faults().empty()) {
      throw Error(ErrorCode::kUsage, "a survey of this size has no faults",
                  "give 16 voxels or more on an axis");
    }
    Measured in(survey, part.part(0, 0.7));
    const survey::Lattice lattice(survey.geometry());
    for (std::size_t l = 0; l < result.legs.size(); ++l) {
      QualityOfLeg& leg = result.legs[l];
      part.report(0.7 + 0.3 * static_cast<double>(l) / static_cast<double>(result.legs.size()), "measure");
      for (const synthetic::Fault& fault : survey.faults()) {
        const Truth truth(fault.truth, survey.geometry());
        if (truth.empty()) continue;
        std::mt19937_64 random(made.seed * 1000 + static_cast<std::uint64_t>(leg.leg));
        // Some places are too near to the surface's border: twenty tries a face are enough.
        int found = 0;
        for (int tries = 0; found < options.faces && tries < 20 * options.faces; ++tries) {
          const auto face = truth.face(leg.leg, lattice, random);
          if (!face) continue;
          ++found;
          ++leg.faces;
          compare(*face, in, leg);
          find_again(*face, static_cast<int>(random() % 13) - 6, in, leg);
          part.check();
        }
      }
    }
  }
  for (QualityOfLeg& leg : result.legs) {
    for (double* sum :
         {&leg.chance.contrast, &leg.chance.discontinuity, &leg.chance.attribute, &leg.chance.variance})
      *sum = leg.pairs == 0 ? extract::kUndefined : *sum / static_cast<double>(leg.pairs);
    leg.within_one =
        leg.offsets == 0 ? extract::kUndefined : leg.within_one / static_cast<double>(leg.offsets);
  }
  result.seconds = omp_get_wtime() - start;
  return result;
}

}  // namespace footwall::tasks
