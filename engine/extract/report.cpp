#include "engine/extract/report.h"

#include <algorithm>

namespace footwall::extract {
namespace {

static_assert(std::is_trivially_copyable_v<Tally>);

std::array<double, 7> listed(const Seconds& s) {
  return {s.read, s.balance, s.voxelize, s.exchange, s.compute, s.wait, s.total};
}

Seconds named(const std::array<double, 7>& s, double sign) {
  return {sign * s[0], sign * s[1], sign * s[2], sign * s[3], sign * s[4], sign * s[5], sign * s[6]};
}

void add(const Tally& other, Tally& into) {
  Tally::Sums& sums = into.sums;
  sums.walked += other.sums.walked;
  sums.bytes += other.sums.bytes;
  sums.messages += other.sums.messages;
  sums.checksum += other.sums.checksum;
  sums.cache_hits += other.sums.cache_hits;
  sums.cache_voxels += other.sums.cache_voxels;
  sums.failed += other.sums.failed;
  into.most_walked = std::max(into.most_walked, other.most_walked);
  into.most_bytes = std::max(into.most_bytes, other.most_bytes);
  into.most_messages = std::max(into.most_messages, other.most_messages);
  for (std::size_t n = 0; n < into.slowest.size(); ++n) {
    into.slowest[n] = std::max(into.slowest[n], other.slowest[n]);
    into.quickest[n] = std::max(into.quickest[n], other.quickest[n]);
  }
}

void combine(void* in, void* inout, int* count, MPI_Datatype* /*type*/) {
  const auto* from = static_cast<const Tally*>(in);
  auto* into = static_cast<Tally*>(inout);
  for (int n = 0; n < *count; ++n) add(from[n], into[n]);
}

// MPI's names for Tally and its sum, made for one call: they are local and cost less than a microsecond.
class TallySum {
 public:
  TallySum() {
    comm::check(MPI_Type_contiguous(sizeof(Tally), MPI_BYTE, &type_), "MPI_Type_contiguous");
    comm::check(MPI_Type_commit(&type_), "MPI_Type_commit");
    comm::check(MPI_Op_create(&combine, 1, &sum_), "MPI_Op_create");
  }
  ~TallySum() {
    MPI_Op_free(&sum_);
    MPI_Type_free(&type_);
  }
  TallySum(const TallySum&) = delete;
  TallySum& operator=(const TallySum&) = delete;

  MPI_Datatype type() const { return type_; }
  MPI_Op sum() const { return sum_; }

 private:
  MPI_Datatype type_ = MPI_DATATYPE_NULL;
  MPI_Op sum_ = MPI_OP_NULL;
};

}  // namespace

void Tally::set(const Seconds& seconds) {
  slowest = listed(seconds);
  for (std::size_t n = 0; n < slowest.size(); ++n) quickest[n] = -slowest[n];
}

Seconds Tally::slowest_seconds() const {
  return named(slowest, 1);
}

Seconds Tally::quickest_seconds() const {
  return named(quickest, -1);
}

Tally together(const comm::Communicator& world, Tally mine, const std::optional<Error>& failure) {
  mine.sums.failed = failure ? 1 : 0;
  Tally all = mine;
  if (world.size() > 1) {
    const TallySum names;
    comm::check(MPI_Allreduce(&mine, &all, 1, names.type(), names.sum(), world.get()), "MPI_Allreduce");
  }
  if (all.sums.failed > 0) world.agree(failure);
  return all;
}

void fill_report(const Tally& all, int ranks, Report& report) {
  report.ranks = ranks;
  report.voxels = all.sums.walked;
  report.bytes_sent = all.sums.bytes;
  report.messages = all.sums.messages;
  report.most_bytes = all.most_bytes;
  report.most_messages = all.most_messages;
  report.cache_hits = all.sums.cache_hits;
  report.cache_voxels = all.sums.cache_voxels;
  report.checksum = static_cast<std::uint64_t>(all.sums.checksum);
  report.load_max_over_mean = all.sums.walked == 0 ? 1
                                                   : static_cast<double>(all.most_walked) * ranks /
                                                         static_cast<double>(all.sums.walked);
  report.seconds = all.slowest_seconds();
  report.quickest = all.quickest_seconds();
}

}  // namespace footwall::extract
