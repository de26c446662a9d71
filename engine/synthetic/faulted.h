// A made-up seismic survey whose faults are known: layered impedance, folded, cut by a planar, a listric and
// a twisted fault, seen through a Ricker wavelet and band-limited noise.
//
// The same options give the same bytes on every machine: integer random numbers that depend on position
// alone, doubles with + - * / and sqrt only, sums in a fixed order. docs: the model is told in faulted.cpp.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "storage/survey/box.h"
#include "storage/survey/geometry.h"
#include "storage/survey/pillar.h"
#include "storage/survey/surface.h"

namespace footwall::synthetic {

struct Options {
  survey::Index size{256, 256, 256};  // voxels: inlines, crosslines, samples
  std::uint64_t seed = 1;
  double signal_to_noise = 4;   // ratio of rms amplitudes, > 0; infinity leaves the noise out
  int pillar_every_lines = 16;  // a pillar on every n-th line, n >= 1; fewer lines apart in narrow surveys
  double jitter_voxels = 1;     // a picked node lies at most so far off the truth, along its section, >= 0
};

struct Fault {
  std::string name;  // "planar", "listric", "twisted"
  // As an interpreter would pick them: nodes from shallow to deep, world coordinates, ids 0. Pillars of the
  // planar and the listric fault lie on inlines, those of the twisted one on crosslines, in ascending line
  // order.
  std::vector<survey::Pillar> pillars;
  // Where the fault really is, inside the survey's box: world coordinates, legs of about 8 voxels (longer
  // beyond 2048 voxels), an oriented manifold with border. The twisted fault is the youngest: it cuts the two
  // others and moves their hanging parts, so theirs are torn from its tip line on (the listric one into two
  // pieces), with the gap that the missing section leaves. Its own ends at that tip line, where the throw
  // falls below one sample.
  survey::Surface truth;
};

class FaultedSurvey {
 public:
  // Any size from 1x1x1 up; below 16 voxels on an axis there is no room for faults, and faults() is empty.
  // Throws Error kUsage for a size below 1, above 2^23 on an axis or too many voxels in all, and for other
  // options out of their range.
  explicit FaultedSurvey(const Options& options);
  ~FaultedSurvey();
  FaultedSurvey(FaultedSurvey&&) noexcept;
  FaultedSurvey& operator=(FaultedSurvey&&) noexcept;

  // Inlines from 300 step 1, 25 m apart; crosslines from 600 step 2, 12.5 m apart; rotated, in metres far
  // from the origin as UTM coordinates are; two-way time from 800 ms every 4 ms.
  const survey::Geometry& geometry() const;
  const std::vector<Fault>& faults() const;

  // The amplitudes of a box, [inline][crossline][sample] with the sample fastest; the signal's rms is
  // about 1. Any box inside geometry().box() gives the same bytes as the whole, whatever the number of
  // threads; safe to call from several threads. Full columns are cheapest: a box costs 29 samples a trace
  // beyond its own. Broken preconditions (box outside, values not box.count() long) throw Error kInternal.
  void fill(const survey::Box& box, std::span<float> values) const;

  // One JSON object for provenance: generator, version, options, wavelet, and per fault its throw and its
  // effective pillar spacing.
  std::string description_json() const;

 private:
  struct Model;
  std::unique_ptr<const Model> model_;
};

}  // namespace footwall::synthetic
