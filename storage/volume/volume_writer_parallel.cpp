#include "storage/volume/volume_writer_parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <nlohmann/json.hpp>
#include <optional>

#include "storage/base/byte_rate.h"
#include "storage/base/partial_file.h"
#include "storage/volume/block_writer.h"
#include "storage/volume/checked_options.h"
#include "storage/volume/description.h"
#include "storage/volume/mpi_agreement.h"
#include "storage/volume/progress_parallel.h"
#include "storage/volume/volume_tables.h"

namespace footwall::volume {
namespace {

constexpr std::int64_t kBytes = sizeof(float);

// Thrown through the writing of blocks where another rank has failed: that rank's error is everybody's.
struct OthersFailed {};

BlockRun run_of(const ChunkGrid& grid, int rank, int ranks) {
  const std::int64_t blocks = all_blocks(grid).end;
  const auto first = [&](int r) { return blocks / ranks * r + std::min<std::int64_t>(r, blocks % ranks); };
  return {first(rank), first(rank + 1)};
}

RowRange rows_of(const std::vector<survey::Box>& strips, const survey::Index& dims) {
  if (strips.empty()) return {};
  return {rows_touched_by(strips.front(), dims).first, rows_touched_by(strips.back(), dims).end};
}

// Rows of the pyramid on their way into the file: neighbouring ranks bring parts of the same rows.
class RowMerger {
 public:
  explicit RowMerger(VolumeTables& tables) : tables_(tables) {}
  // Row `a` as one rank knows it: ranks in order, each with its rows in order. The row and those before it
  // are whole where they come before `first_open`, the first row that a later rank touches.
  void add(std::int64_t a, MinMaxRow row, std::int64_t first_open) {
    const auto at = static_cast<std::size_t>(a - next_);
    if (at < open_.size()) {
      merge_row(open_[at], row);
    } else {
      open_.push_back(std::move(row));
    }
    for (; !open_.empty() && next_ <= a && next_ < first_open; ++next_, open_.pop_front())
      tables_.add_min_max(open_.front());
  }

 private:
  VolumeTables& tables_;
  std::int64_t next_ = 0;  // the row of open_[0]
  std::deque<MinMaxRow> open_;
};

class ParallelWriting {
 public:
  ParallelWriting(MPI_Comm parent, const std::filesystem::path& path, const WriteOptions& options)
      : comm_(parent), rank_(comm_.rank()), ranks_(comm_.size()) {
    create(path, options);
  }
  void write_blocks(const BlockSource& fill, const JobContext& job);
  void write_tables();
  VolumeInfo commit(const std::filesystem::path& path, const JobContext& job);

 private:
  void create(const std::filesystem::path& path, const WriteOptions& options);
  void add_up(SampleStatistics::Totals& totals) const;
  void send_to_root(const std::vector<MinMaxRow>& rows) const;
  std::optional<Error> collect(std::vector<MinMaxRow> rows, std::span<std::uint64_t> hashes);

  OwnCommunicator comm_;
  int rank_;
  int ranks_;
  VolumeInfo info_;
  ChunkGrid grid_;
  std::optional<PartialFile> file_;     // on rank 0, as
  std::optional<VolumeTables> tables_;  // this, which is closed first
  std::optional<BlockWriter> blocks_;
  std::vector<std::vector<std::uint8_t>> masks_;  // of this rank's strips
};

void ParallelWriting::create(const std::filesystem::path& path, const WriteOptions& options) {
  std::string name;
  std::int64_t voxels_at = 0;
  agree(comm_, outcome_of([&] {
          quiet_hdf5();
          info_ = checked(options);
          grid_ = {info_.dims, info_.chunk};
          if (rank_ != 0) return;
          file_.emplace(path);
          tables_.emplace(file_->path(), grid_);
          name = file_->path().string();
          voxels_at = tables_->voxels_at();
        }));
  broadcast(comm_, name);
  check_mpi(MPI_Bcast(&voxels_at, 1, MPI_INT64_T, 0, comm_.get()), "MPI_Bcast");
  agree(comm_, outcome_of([&] {
          std::error_code ignored;
          if (!std::filesystem::exists(name, ignored)) {
            throw Error(ErrorCode::kIo,
                        fmt::format("rank {} does not see {}, which rank 0 has made", rank_, name),
                        "choose a folder on a file system that all ranks reach");
          }
          blocks_.emplace(name, voxels_at, grid_, info_.null_value, run_of(grid_, rank_, ranks_));
        }));
}

void ParallelWriting::write_blocks(const BlockSource& fill, const JobContext& job) {
  const std::int64_t voxels = grid_.dims[0] * grid_.dims[1] * grid_.dims[2];
  ByteRate rate(voxels * kBytes);
  CommonProgress progress(comm_);
  const auto report = [&] {
    job.report(static_cast<double>(progress.done()) / static_cast<double>(voxels), "write",
               rate.text(progress.done() * kBytes, ByteRate::Clock::now()));
  };
  std::optional<Error> failure = outcome_of([&] {
    try {
      blocks_->write(
          fill,
          [&](std::int64_t done) {
            progress.tell(done);
            if (progress.failed()) throw OthersFailed();
            report();
          },
          [&](const survey::Box&, std::span<const std::uint8_t> mask) {
            masks_.emplace_back(mask.begin(), mask.end());
          });
      blocks_->flush();
    } catch (const OthersFailed&) {
      // finish() finds it too.
    }
  });
  std::int64_t mine = 0;
  for (const survey::Box& strip : strips_of(grid_, run_of(grid_, rank_, ranks_))) mine += strip.count();
  progress.finish(mine, !failure, [&] {
    if (!failure) failure = outcome_of(report);
    return !failure;
  });
  if (!failure && !progress.failed()) failure = outcome_of(report);
  agree(comm_, failure);
}

void ParallelWriting::write_tables() {
  SampleStatistics::Totals totals;
  std::vector<MinMaxRow> rows;
  std::vector<std::uint64_t> hashes;
  agree(comm_, outcome_of([&] {
          totals = blocks_->statistics().totals();
          rows = blocks_->take_finished(grid_.dims[0]);
          if (rank_ == 0) hashes.resize(static_cast<std::size_t>(grid_.count()));
        }));
  add_up(totals);
  std::optional<Error> failure;
  if (rank_ != 0) {
    send_to_root(rows);
  } else {
    failure = collect(std::move(rows), hashes);
    if (!failure) {
      failure = outcome_of([&] {
        SampleStatistics statistics(totals);
        tables_->finish(info_, hashes, statistics);
      });
    }
  }
  agree(comm_, failure);
}

// On rank 0 the totals of all ranks.
void ParallelWriting::add_up(SampleStatistics::Totals& totals) const {
  const auto reduce = [&](void* values, std::size_t count, MPI_Datatype type, MPI_Op how) {
    check_mpi(MPI_Reduce(rank_ == 0 ? MPI_IN_PLACE : values, values, static_cast<int>(count), type, how, 0,
                         comm_.get()),
              "MPI_Reduce");
  };
  reduce(totals.numbers.data(), totals.numbers.size(), MPI_UINT64_T, MPI_SUM);
  reduce(&totals.min, 1, MPI_FLOAT, MPI_MIN);
  reduce(&totals.max, 1, MPI_FLOAT, MPI_MAX);
}

// Both sides know how much there is of everything: it follows from the rank's run of blocks.
void ParallelWriting::send_to_root(const std::vector<MinMaxRow>& rows) const {
  send(comm_, std::as_bytes(blocks_->hashes()), 0);
  for (const auto& mask : masks_) send(comm_, std::as_bytes(std::span(mask)), 0);
  for (const MinMaxRow& row : rows) send(comm_, std::as_bytes(std::span(row)), 0);
}

// Rank 0: what send_to_root() of all ranks sends, one rank after the other, into the tables.
std::optional<Error> ParallelWriting::collect(std::vector<MinMaxRow> rows, std::span<std::uint64_t> hashes) {
  const survey::Index n = min_max_dims(grid_.dims, 0);
  RowMerger merger(*tables_);
  std::optional<Error> failure;  // kept until all was received: the others must not wait for it
  const auto attempt = [&](const std::function<void()>& f) {
    if (!failure) failure = outcome_of(f);
  };
  for (int rank = 0; rank < ranks_; ++rank) {
    const BlockRun run = run_of(grid_, rank, ranks_);
    const std::vector<survey::Box> strips = strips_of(grid_, run);
    const auto all = hashes.subspan(static_cast<std::size_t>(run.first * grid_.counts()[2]),
                                    static_cast<std::size_t>((run.end - run.first) * grid_.counts()[2]));
    if (rank == 0) {
      std::copy(blocks_->hashes().begin(), blocks_->hashes().end(), all.begin());
    } else {
      receive(comm_, std::as_writable_bytes(all), rank);
    }
    for (std::size_t s = 0; s < strips.size(); ++s) {
      std::vector<std::uint8_t> mask;
      if (rank == 0) {
        mask = std::move(masks_[s]);
      } else {
        mask.resize(static_cast<std::size_t>(strips[s].size(0) * strips[s].size(1)));
        receive(comm_, std::as_writable_bytes(std::span(mask)), rank);
      }
      attempt([&] { tables_->add_live(strips[s], mask); });
    }
    const BlockRun following = run_of(grid_, rank + 1, ranks_);
    const bool last = rank + 1 == ranks_ || following.empty();
    const std::int64_t first_open =
        last ? n[0] : rows_touched_by(box_of_block(grid_, following.first), grid_.dims).first;
    const auto [first, end] = rows_of(strips, grid_.dims);
    for (std::int64_t a = first; a < end; ++a) {
      MinMaxRow row;
      if (rank == 0) {
        row = std::move(rows[static_cast<std::size_t>(a - first)]);
      } else {
        row.resize(static_cast<std::size_t>(3 * n[1] * n[2]));
        receive(comm_, std::as_writable_bytes(std::span(row)), rank);
      }
      attempt([&] { merger.add(a, std::move(row), first_open); });
    }
  }
  return failure;
}

VolumeInfo ParallelWriting::commit(const std::filesystem::path& path, const JobContext& job) {
  agree(comm_, outcome_of([&] { job.report(1, "write"); }));
  std::string text;
  agree(comm_, outcome_of([&] {
          if (rank_ != 0) return;
          text = nlohmann::json{{"description", describe(info_)}, {"bytes", info_.bytes}}.dump();
          tables_.reset();
          file_->commit();
        }));
  broadcast(comm_, text);
  const nlohmann::json j = nlohmann::json::parse(text);
  VolumeInfo info = info_from(j.at("description").get<Description>(), path);
  info.chunk = grid_.chunk;
  info.bytes = j.at("bytes").get<std::int64_t>();
  return info;
}

}  // namespace

VolumeInfo write_volume_parallel(MPI_Comm comm, const std::filesystem::path& path,
                                 const WriteOptions& options, const BlockSource& fill,
                                 const JobContext& job) {
  // 1. Rank 0 makes the file and takes its room; all open it.
  ParallelWriting writing(comm, path, options);
  // 2. Each rank its own chunks, until they are on the disk.
  writing.write_blocks(fill, job.part(0, 0.98));
  // 3. Rank 0 the tables, from what all ranks know.
  writing.write_tables();
  // 4. The file is whole.
  return writing.commit(path, job);
}

}  // namespace footwall::volume
