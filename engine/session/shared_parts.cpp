#include "engine/session/shared_parts.h"

#include <algorithm>
#include <cstring>

#include "engine/extract/face_geometry.h"
#include "engine/session/part_file.h"

namespace footwall::session {
namespace {

using Statistics = std::vector<extract::FaceStatistics>;
static_assert(std::is_trivially_copyable_v<extract::FaceStatistics>);

void append(std::span<const extract::FaceStatistics> statistics, comm::Bytes& bytes) {
  const auto raw = std::as_bytes(statistics);
  bytes.insert(bytes.end(), raw.begin(), raw.end());
}

// Takes the statistics of `faces` faces off the front.
Statistics taken(std::span<const std::byte>& bytes, std::size_t faces) {
  Statistics statistics(faces);
  const std::size_t size = faces * sizeof(extract::FaceStatistics);
  require(bytes.size() >= size, "the statistics of all faces");
  if (size > 0) std::memcpy(statistics.data(), bytes.data(), size);
  bytes = bytes.subspan(size);
  return statistics;
}

// The statistics of the faces, and behind them those of the whole fault.
std::optional<Statistics> earlier_part(const Job& job, const JobFault& fault) {
  const std::filesystem::path path = part_path(job.output, fault.id);
  if (!std::filesystem::exists(path)) return std::nullopt;
  try {
    Part part = read_part(path);
    if (part.hash == part_hash(job, fault) && part.faces == fault.faces) {
      part.statistics.push_back(part.whole);
      return std::move(part.statistics);
    }
  } catch (const Error&) {
    // Not whole, or not ours: it is computed and written again.
  }
  return std::nullopt;
}

void append_number(std::uint64_t number, comm::Bytes& bytes) {
  const auto raw = std::as_bytes(std::span(&number, 1));
  bytes.insert(bytes.end(), raw.begin(), raw.end());
}

std::uint64_t taken_number(std::span<const std::byte>& bytes) {
  std::uint64_t number = 0;
  require(bytes.size() >= sizeof number, "a number");
  std::memcpy(&number, bytes.data(), sizeof number);
  bytes = bytes.subspan(sizeof number);
  return number;
}

// The results of `faces` faces from the one at `first`: how many bytes each has, then the bytes.
void append(const extract::FaceBlobs& blobs, std::size_t first, std::size_t faces, comm::Bytes& bytes) {
  append_number(blobs.computation.size(), bytes);
  const auto name = std::as_bytes(std::span(blobs.computation));
  bytes.insert(bytes.end(), name.begin(), name.end());
  const std::uint64_t start = blobs.offsets.at(first);
  for (std::size_t f = first; f <= first + faces; ++f) append_number(blobs.offsets.at(f) - start, bytes);
  const auto own = std::span(blobs.bytes).subspan(start, blobs.offsets[first + faces] - start);
  bytes.insert(bytes.end(), own.begin(), own.end());
}

extract::FaceBlobs taken_blobs(std::span<const std::byte>& bytes, std::size_t faces) {
  extract::FaceBlobs blobs;
  const std::uint64_t letters = taken_number(bytes);
  require(bytes.size() >= letters, "a name");
  blobs.computation.assign(reinterpret_cast<const char*>(bytes.data()), letters);
  bytes = bytes.subspan(letters);
  for (std::size_t f = 0; f <= faces; ++f) blobs.offsets.push_back(taken_number(bytes));
  require(bytes.size() >= blobs.offsets.back(), "the results of all faces");
  const auto own = bytes.first(blobs.offsets.back());
  blobs.bytes.assign(own.begin(), own.end());
  bytes = bytes.subspan(own.size());
  return blobs;
}

Part new_part(const Job& job, const JobFault& fault, Statistics statistics) {
  const extract::FaceStatistics whole = statistics.back();
  statistics.pop_back();
  Part part{fault.id, fault.name, part_hash(job, fault), fault.faces, std::move(statistics), {}, {}, whole};
  part.geometry.reserve(part.faces.size());
  for (const extract::Face& face : part.faces) {
    part.geometry.push_back(extract::face_geometry(job.geometry, face.triangle, job.velocity));
  }
  return part;
}

}  // namespace

SharedParts::SharedParts(const comm::Communicator& world, const Job& job, int writers)
    : world_(world.get()),
      job_(job),
      writers_(std::clamp(writers, 1, world.size())),
      done_(job.faults.size()),
      statistics_(job.faults.size()),
      wholes_(job.faults.size()) {
  const std::size_t faults = job.faults.size();
  const auto ranks = static_cast<std::size_t>(world_.size());
  // 1 Every rank looks for its own parts, and tells all ranks which it has; rank 0 gets what is in them.
  const std::vector<comm::Bytes> heard = world_.exchange(world_.collectively([&] {
    comm::Bytes found;
    comm::Bytes contents;
    for (std::size_t n = 0; n < faults; ++n) {
      if (writer_of(n) != world_.rank()) continue;
      const std::optional<Statistics> part = earlier_part(job_, job_.faults[n]);
      found.push_back(static_cast<std::byte>(part.has_value() ? 1 : 0));
      if (part) append(*part, contents);
    }
    std::vector<comm::Bytes> outgoing(ranks, found);
    outgoing[0].insert(outgoing[0].end(), contents.begin(), contents.end());
    return outgoing;
  }));
  // 2 Everyone notes the same.
  world_.collectively([&] {
    for (std::size_t r = 0; r < ranks; ++r) {
      std::vector<std::size_t> theirs;
      for (std::size_t n = 0; n < faults; ++n) {
        if (writer_of(n) == static_cast<int>(r)) theirs.push_back(n);
      }
      require(heard[r].size() >= theirs.size(), "a word about every part");
      std::span<const std::byte> contents = std::span(heard[r]).subspan(theirs.size());
      for (std::size_t each = 0; each < theirs.size(); ++each) {
        const std::size_t n = theirs[each];
        done_[n] = heard[r][each] != std::byte{0};
        if (!done_[n] || world_.rank() != 0) continue;
        statistics_[n] = taken(contents, job_.faults[n].faces.size() + 1);
        wholes_[n] = statistics_[n].back();
        statistics_[n].pop_back();
      }
    }
    reused_ = done_;
  });
}

std::vector<std::size_t> SharedParts::next_group(std::size_t faces) const {
  std::vector<std::size_t> group;
  std::size_t held = 0;
  for (std::size_t n = 0; n < done_.size() && (group.empty() || held < faces); ++n) {
    if (done_[n]) continue;
    group.push_back(n);
    held += job_.faults[n].faces.size();
  }
  return group;
}

void SharedParts::write(const std::vector<std::size_t>& faults,
                        std::span<const extract::FaceStatistics> statistics,
                        std::span<const extract::FaceBlobs> blobs,
                        std::span<const extract::FaultStatistics> wholes) {
  // 1 Rank 0 gives every rank the results of the parts that it writes.
  const std::vector<comm::Bytes> heard = world_.exchange(world_.collectively([&] {
    std::vector<comm::Bytes> outgoing(static_cast<std::size_t>(world_.size()));
    if (world_.rank() != 0) return outgoing;
    std::size_t next = 0;
    for (const std::size_t n : faults) {
      const std::size_t count = job_.faults[n].faces.size();
      const auto part = statistics.subspan(next, count);
      const auto whole = std::find_if(wholes.begin(), wholes.end(),
                                      [&](const auto& one) { return one.fault == job_.faults[n].id; });
      if (whole != wholes.end()) wholes_[n] = whole->statistics;  // a fault without faces has none
      comm::Bytes& to = outgoing[static_cast<std::size_t>(writer_of(n))];
      append(part, to);
      append(std::span(&wholes_[n], 1), to);
      append_number(blobs.size(), to);
      for (const extract::FaceBlobs& each : blobs) append(each, next, count, to);
      statistics_[n].assign(part.begin(), part.end());
      next += count;
    }
    return outgoing;
  }));
  // 2 Each writes its own.
  world_.collectively([&] {
    std::span<const std::byte> rest(heard[0]);
    for (const std::size_t n : faults) {
      if (writer_of(n) != world_.rank()) continue;
      const JobFault& fault = job_.faults[n];
      Part part = new_part(job_, fault, taken(rest, fault.faces.size() + 1));
      for (std::uint64_t left = taken_number(rest); left > 0; --left) {
        part.blobs.push_back(taken_blobs(rest, fault.faces.size()));
      }
      write_part(part, part_path(job_.output, fault.id));
    }
  });
  for (const std::size_t n : faults) done_[n] = true;
}

}  // namespace footwall::session
