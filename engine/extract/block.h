// A rank's values in memory: its own columns with a halo of one trace around them, NaN outside the survey, so
// that a voxel's 3x3 neighbours are always there.
#pragma once
#include <cstdlib>
#include <memory>
#include <span>

#include "storage/base/job_context.h"
#include "storage/survey/box.h"

namespace footwall::extract {

class Block {
 public:
  // All NaN at first. `own` may be empty (then nothing is stored); throws std::bad_alloc, kCancelled (looked
  // at every few MiB: new memory takes its time).
  Block(const survey::Box& own, const survey::Index& dims, const JobContext& job = {});

  const survey::Box& own() const { return own_; }
  // What has to be read: own with its halo, inside the survey.
  const survey::Box& wanted() const { return wanted_; }
  bool has(const survey::Index& voxel) const { return wanted_.contains(voxel); }

  // Takes the values [inline][crossline][sample] of a part of wanted().
  void put(const survey::Box& part, std::span<const float> values);

  // The place of a voxel of wanted() in data().
  std::int64_t offset(const survey::Index& p) const {
    return (p[0] - corner_[0]) * strides_[0] + (p[1] - corner_[1]) * strides_[1] + (p[2] - corner_[2]);
  }
  const std::array<std::int64_t, 3>& strides() const { return strides_; }
  const float* data() const { return values_.get(); }

 private:
  survey::Box own_;
  survey::Box wanted_;
  survey::Index corner_{0, 0, 0};  // of the stored box: the halo's, also where it leaves the survey
  std::array<std::int64_t, 3> strides_{0, 0, 1};
  struct Release {
    void operator()(float* values) const { std::free(values); }
  };
  // In huge pages where the system has them: faces cut across memory, and page tables are then half of the
  // cost.
  std::unique_ptr<float[], Release> values_;
};

}  // namespace footwall::extract
