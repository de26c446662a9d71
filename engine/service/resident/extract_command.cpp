// Statistics of the model's faces: all, those that changed, or some.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "engine/extract/computations.h"
#include "engine/service/ranks.pb.h"
#include "engine/service/resident/commands.h"
#include "engine/service/resident/memory_needs.h"
#include "engine/service/resident/pieces.h"
#include "engine/service/resident/resident_state.h"
#include "engine/service/wire.h"
#include "engine/session/report_json.h"
#include "storage/base/hash.h"
#include "storage/survey/moved_lattice.h"

namespace footwall::service {
namespace {

using extract::Face;
using extract::FaceIdentity;
using extract::FaceStatistics;

// What was computed; numbers at rank 0, in the order of the faces.
struct Numbers {
  std::vector<Face> faces;
  std::vector<FaceStatistics> statistics;
  extract::Report report;
};

// As the volume sees them.
template <typename Wanted>
std::vector<Face> faces_where(const FaceModel::Faces& model, const OpenVolume& volume, Wanted&& wanted) {
  std::vector<Face> faces;
  for (const auto& [name, triangle] : model) {
    if (wanted(name))
      faces.push_back({name.fault, name.owner, name.n, survey::in_volume(triangle, volume.info.origin)});
  }
  return faces;
}

// By LoadedSurvey, which remembers no face.
Numbers compute(OpenVolume& volume, std::vector<Face> faces, const extract::Options& options,
                const JobContext& job) {
  Numbers numbers;
  const extract::Input input{volume.info.dims, volume.info.statistics.max_abs, faces};
  extract::Result result = volume.survey->extract(input, options, job);
  numbers.statistics = std::move(result.faces);
  numbers.report = std::move(result.report);
  numbers.faces = std::move(faces);
  return numbers;
}

// Drops the faces that were computed for the sake of others alone.
template <typename Wanted>
void keep(Numbers& numbers, Wanted&& wanted) {
  std::size_t kept = 0;
  for (std::size_t n = 0; n < numbers.faces.size(); ++n) {
    if (!wanted(extract::identity_of(numbers.faces[n]))) continue;
    numbers.faces[kept] = numbers.faces[n];
    if (!numbers.statistics.empty()) numbers.statistics[kept] = numbers.statistics[n];
    ++kept;
  }
  numbers.faces.resize(kept);
  if (!numbers.statistics.empty()) numbers.statistics.resize(kept);
  numbers.report.faces = static_cast<std::int64_t>(kept);
}

Numbers all(ResidentState& state, OpenVolume& volume, Extraction& extraction, const JobContext& job) {
  std::vector<Face> faces = state.world.collectively(
      [&] { return faces_where(state.model.faces(), volume, [](auto&) { return true; }); });
  if (!extraction.incremental) return compute(volume, std::move(faces), extraction.options, job);
  auto fresh = std::make_unique<extract::Incremental>(*volume.survey, volume.info.statistics.max_abs,
                                                      extraction.options);
  extract::FaceChanges changes;
  changes.added = std::move(faces);
  const extract::Update& update = fresh->update(changes, job);
  Numbers numbers{std::move(changes.added), update.statistics, update.report};
  extraction.incremental = std::move(fresh);
  return numbers;
}

Numbers changed(ResidentState& state, OpenVolume& volume, Extraction& extraction, const JobContext& job) {
  if (!extraction.incremental) {
    // The sign of a fault's offsets hangs on all of its faces.
    std::vector<Face> faces = state.world.collectively([&] {
      std::set<std::int64_t> faults;
      for (const FaceIdentity& name : extraction.touched) faults.insert(name.fault);
      return faces_where(state.model.faces(), volume,
                         [&](const auto& name) { return faults.contains(name.fault); });
    });
    return compute(volume, std::move(faces), extraction.options, job);
  }
  const extract::FaceChanges changes =
      state.world.collectively([&] { return extraction.changes(state.model.faces()); });
  const extract::Update& update = extraction.incremental->update(changes, job);
  Numbers numbers{changes.added, update.statistics, update.report};
  numbers.faces.insert(numbers.faces.end(), changes.changed.begin(), changes.changed.end());
  return numbers;
}

Numbers some(ResidentState& state, OpenVolume& volume, const extract::Options& options,
             const v1::FaceNames& only, const JobContext& job) {
  const bool whole_faults = extract::asks_for(options, "offset");
  std::set<FaceIdentity> asked;
  std::vector<Face> faces = state.world.collectively([&] {
    std::set<std::int64_t> faults;
    for (const FaceIdentity& name : names_from(only)) {
      if (!state.model.faces().contains(name)) {
        throw Error(ErrorCode::kInvalid,
                    fmt::format("face {} of fault {}, owner {}: there is no such face", name.n, name.fault,
                                name.owner),
                    "read the model again");
      }
      asked.insert(name);
      faults.insert(name.fault);
    }
    return faces_where(state.model.faces(), volume, [&](const auto& name) {
      return whole_faults ? faults.contains(name.fault) : asked.contains(name);
    });
  });
  Numbers numbers = compute(volume, std::move(faces), options, job);
  if (whole_faults) keep(numbers, [&](const auto& name) { return asked.contains(name); });
  return numbers;
}

// On rank 0.
void send_numbers(const Numbers& numbers, const Send& send, const JobContext& job) {
  for (std::size_t from = 0; from < numbers.faces.size(); from += kFacesInPiece) {
    job.check();
    v1::ExtractReply reply;
    for (std::size_t n = from; n < std::min(numbers.faces.size(), from + kFacesInPiece); ++n)
      append(extract::identity_of(numbers.faces[n]), numbers.statistics[n], *reply.mutable_numbers());
    send(reply);
  }
}

}  // namespace

void extract(ResidentState& state, const v1::Command& command, const Send& send, const JobContext& job) {
  const v1::ExtractRequest& request = command.extract();
  struct Asked {
    OpenVolume* volume;
    extract::Options options;
    Extraction* extraction;  // null where only some faces are asked for
  };
  const Asked found = state.world.collectively([&] {
    Asked asked{&state.volumes.find(request.volume()), options_from(request.options(), state.threads),
                nullptr};
    if (request.has_only() && request.changed_only()) {
      throw Error(ErrorCode::kUsage, "changed faces only and some faces only are asked for at once",
                  "ask for one of them");
    }
    if (!request.has_only()) asked.extraction = &state.extractions.of(*asked.volume, asked.options);
    return asked;
  });

  const bool is_changed = found.extraction != nullptr && request.changed_only() && found.extraction->complete;
  const auto asked = static_cast<std::int64_t>(request.has_only() ? request.only().faults_size()
                                               : is_changed       ? found.extraction->touched.size()
                                                                  : state.model.faces().size());
  const std::int64_t needed = extraction_passes(asked) + (request.has_only() ? 0 : extraction_stays(asked));
  if (needed > kWorthAsking) {
    state.memory.require_free(
        needed, "the extraction",
        "extract fewer faces at once, close volumes that are not needed, or use more hosts");
  }

  OpenVolume* const volume = found.volume;
  const extract::Options& options = found.options;
  Extraction* const extraction = found.extraction;
  const JobContext computing = job.part(0, 0.95);
  const bool is_all = extraction != nullptr && !(request.changed_only() && extraction->complete);
  const Numbers numbers = extraction == nullptr ? some(state, *volume, options, request.only(), computing)
                          : is_all              ? all(state, *volume, *extraction, computing)
                                                : changed(state, *volume, *extraction, computing);

  // Until the client has the numbers, it has to get all of them again.
  if (extraction != nullptr) extraction->complete = false;
  state.world.collectively([&] {
    if (state.world.rank() != 0) return;
    send_numbers(numbers, send, job);
    v1::ExtractReply last;
    v1::ExtractDone& done = *last.mutable_done();
    done.set_edit(state.model.edit());
    done.set_faces(static_cast<std::int64_t>(numbers.faces.size()));
    done.set_voxels(numbers.report.voxels);
    if (is_all) done.set_checksum(to_hex(extract::checksum_of(numbers.faces, numbers.statistics)));
    done.set_report_json(session::report_json(numbers.report, options)
                             .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
    send(last);
  });
  if (extraction != nullptr) {
    extraction->touched.clear();
    extraction->complete = true;
  }
}

}  // namespace footwall::service
