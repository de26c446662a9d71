#include "storage/project/detail/run_table.h"

#include <fmt/format.h>
#include <algorithm>

#include "storage/project/detail/clock.h"
#include "storage/project/detail/names.h"
#include "storage/project/detail/packing.h"

namespace footwall::project::detail {
namespace {

constexpr std::size_t kFaceIdBytes = sizeof(std::int64_t) + sizeof(std::int32_t);
static_assert(sizeof(survey::LatticeTriangle) == 36);

Error no_run(std::int64_t run) {
  return {ErrorCode::kNotFound, fmt::format("there is no run {}", run), "footwall extract makes one"};
}

}  // namespace

std::vector<StatisticRecord> RunTable::statistics() const {
  std::vector<StatisticRecord> all;
  Query row(
      database_,
      "SELECT name, version, unit_rule, low, high, colour_map, description FROM statistic ORDER BY rowid");
  while (row.next()) {
    all.push_back({row.text(0), static_cast<std::int32_t>(row.integer(1)), row.text(2), row.optional_real(3),
                   row.optional_real(4), row.text(5), row.text(6)});
  }
  return all;
}

void RunTable::put(const StatisticRecord& s) {
  check_name("statistic", s.name);
  Query(database_,
        "INSERT INTO statistic(name, version, unit_rule, low, high, colour_map, description)"
        " VALUES(?1, ?2, ?3, ?4, ?5, ?6, ?7) ON CONFLICT(name) DO UPDATE SET version = ?2, unit_rule = ?3, "
        "low = ?4,"
        " high = ?5, colour_map = ?6, description = ?7",
        s.name, s.version, s.unit_rule, s.low, s.high, s.colour_map, s.description)
      .run();
}

std::vector<RunRecord> RunTable::all() const {
  std::vector<RunRecord> runs;
  Query row(
      database_,
      "SELECT id, name, live, volume, volume_checksum, parameters, result, made FROM extraction ORDER BY id");
  while (row.next()) {
    runs.push_back({row.integer(0), row.text(1), row.integer(2) != 0, row.text(3), row.text(4), row.text(5),
                    row.text(6), row.text(7)});
  }
  return runs;
}

std::vector<std::int64_t> RunTable::faults(std::int64_t run) const {
  std::vector<std::int64_t> ids;
  Query row(database_, "SELECT fault FROM extraction_fault WHERE run = ? ORDER BY fault", run);
  while (row.next()) ids.push_back(row.integer(0));
  return ids;
}

FaultRun RunTable::read(std::int64_t run, std::int64_t fault) const {
  Query head(database_,
             "SELECT fault_name, revision, faces, face_ids, lattice FROM extraction_fault WHERE run = ? AND "
             "fault = ?",
             run, fault);
  if (!head.next()) {
    throw Error(ErrorCode::kNotFound, fmt::format("run {} has no fault with id {}", run, fault));
  }
  const std::string what = fmt::format("run {}, fault {}: ", run, fault);
  FaultRun found;
  found.fault = fault;
  found.fault_name = head.text(0);
  found.revision = head.integer(1);
  const std::int64_t faces = head.integer(2);
  auto ids = head.view(3);
  require_size(what + "face ids", ids.size(), faces, kFaceIdBytes);
  const auto n = static_cast<std::size_t>(faces);
  found.panels = taken<std::int64_t>(ids, n);
  found.numbers = taken<std::int32_t>(ids, n);
  auto lattice = head.view(4);
  require_size(what + "lattice positions", lattice.size(), faces, sizeof(survey::LatticeTriangle));
  found.lattice = taken<survey::LatticeTriangle>(lattice, n);
  Query row(database_, "SELECT statistic, data FROM face_statistics WHERE run = ? AND fault = ?", run, fault);
  while (row.next()) {
    auto values = row.view(1);
    require_size(what + row.text(0), values.size(), faces, sizeof(double));
    found.statistics[row.text(0)] = taken<double>(values, n);
  }
  return found;
}

std::vector<FaceVoxels> RunTable::voxels(std::int64_t run, std::int64_t fault) const {
  std::vector<FaceVoxels> all;
  Query row(database_,
            "SELECT v.codec, v.parameters, v.ends, v.data, f.faces FROM face_voxels v JOIN extraction_fault f"
            " ON f.run = v.run AND f.fault = v.fault WHERE v.run = ? AND v.fault = ? ORDER BY v.codec",
            run, fault);
  while (row.next()) {
    FaceVoxels& voxels = all.emplace_back();
    voxels.codec = row.text(0);
    voxels.parameters = row.text(1);
    const std::string what = fmt::format("run {}, fault {}: {}", run, fault, voxels.codec);
    const std::int64_t faces = row.integer(4);
    auto ends = row.view(2);
    require_size(what, ends.size(), faces, sizeof(std::uint64_t));
    voxels.ends = taken<std::uint64_t>(ends, static_cast<std::size_t>(faces));
    const auto bytes = row.view(3);
    const std::uint64_t last = voxels.ends.empty() ? 0 : voxels.ends.back();
    if (!std::is_sorted(voxels.ends.begin(), voxels.ends.end()) || last != bytes.size()) {
      throw Error(ErrorCode::kCorrupt, what + " does not hold the bytes of its faces",
                  "compute it again with footwall extract");
    }
    voxels.bytes.assign(bytes.begin(), bytes.end());
  }
  return all;
}

std::int64_t RunTable::add(const RunRecord& run, std::span<const FaultRun> faults) {
  check_text("a run's name", run.name);
  if (run.live) {
    std::vector<std::int64_t> former;
    {
      Query row(database_, "SELECT id FROM extraction WHERE live = 1 AND volume = ?", run.volume);
      while (row.next()) former.push_back(row.integer(0));
    }
    for (const std::int64_t id : former) remove(id);
  }
  Query(database_,
        "INSERT INTO extraction(name, live, volume, volume_checksum, parameters, result, made)"
        " VALUES(?, ?, ?, ?, ?, ?, ?)",
        run.name, run.live, run.volume, run.volume_checksum, run.parameters, run.result, now_text())
      .run();
  const std::int64_t id = database_.integer("SELECT last_insert_rowid()");
  if (run.name.empty()) rename(id, {});
  for (const FaultRun& fault : faults) add_fault(id, fault);
  return id;
}

void RunTable::add_fault(std::int64_t run, const FaultRun& f) {
  const std::size_t n = f.panels.size();
  const auto refuse_length = [&](std::string_view what, std::size_t found) {
    if (found == n) return;
    throw Error(ErrorCode::kInvalid,
                fmt::format("fault '{}' has {} faces but {} of {}", f.fault_name, n, found, what));
  };
  refuse_length("face numbers", f.numbers.size());
  refuse_length("lattice positions", f.lattice.size());
  Bytes ids = packed(f.panels);
  append(ids, std::span<const std::int32_t>(f.numbers));
  const Bytes lattice = packed(f.lattice);
  Query(database_,
        "INSERT INTO extraction_fault(run, fault, fault_name, revision, faces, face_ids, lattice)"
        " VALUES(?, ?, ?, ?, ?, ?, ?)",
        run, f.fault, f.fault_name, f.revision, static_cast<std::int64_t>(n), ids, lattice)
      .run();
  for (const auto& [statistic, values] : f.statistics) {
    refuse_length(statistic, values.size());
    if (Query known(database_, "SELECT 1 FROM statistic WHERE name = ?", statistic); !known.next()) {
      throw Error(ErrorCode::kInvalid,
                  fmt::format("the statistic '{}' is not registered in the project", statistic));
    }
    const Bytes data = packed(values);
    Query(database_, "INSERT INTO face_statistics(run, fault, statistic, data) VALUES(?, ?, ?, ?)", run,
          f.fault, statistic, data)
        .run();
  }
  for (const FaceVoxels& voxels : f.voxels) {
    refuse_length(voxels.codec, voxels.ends.size());
    add_voxels(run, f, voxels);
  }
}

void RunTable::add_voxels(std::int64_t run, const FaultRun& f, const FaceVoxels& voxels) {
  if (static_cast<std::int64_t>(voxels.bytes.size()) > kLargestValue) {
    throw Error(ErrorCode::kInvalid,
                fmt::format("'{}' of fault '{}' takes {} bytes, more than a project holds in one value",
                            voxels.codec, f.fault_name, voxels.bytes.size()),
                "give a lower --snr, or take fewer faces at once");
  }
  Query(database_,
        "INSERT INTO face_voxels(run, fault, codec, parameters, ends, data) VALUES(?, ?, ?, ?, ?, ?)", run,
        f.fault, voxels.codec, voxels.parameters, packed(voxels.ends), voxels.bytes)
      .run();
}

void RunTable::rename(std::int64_t run, const std::string& name) {
  if (!name.empty()) check_name("run", name);
  Query renamed(database_, "UPDATE extraction SET name = ? WHERE id = ? RETURNING id",
                name.empty() ? fmt::format("run {}", run) : name, run);
  if (!renamed.next()) throw no_run(run);
}

void RunTable::remove(std::int64_t run) {
  Query(database_, "DELETE FROM face_voxels WHERE run = ?", run).run();
  Query(database_, "DELETE FROM face_statistics WHERE run = ?", run).run();
  Query(database_, "DELETE FROM extraction_fault WHERE run = ?", run).run();
  Query removed(database_, "DELETE FROM extraction WHERE id = ? RETURNING id", run);
  if (!removed.next()) throw no_run(run);
}

}  // namespace footwall::project::detail
