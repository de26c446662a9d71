// Edits as they are made, with the numbers of the faces that they touch.
#include <omp.h>

#include "engine/extract/computations.h"
#include "engine/service/ranks.pb.h"
#include "engine/service/resident/commands.h"
#include "engine/service/resident/memory_needs.h"
#include "engine/service/resident/resident_state.h"
#include "engine/service/wire.h"

namespace footwall::service {
namespace {

// So that no message comes near the largest one that is sent.
constexpr std::size_t kFacesInReply = std::size_t{1} << 18;

// The batches of a step that were applied, to be taken back together; and those that were refused.
struct Applied {
  struct Refusal {
    std::uint64_t edit;
    Error why;
  };
  std::vector<FaceModel::Change> changes;
  std::vector<Refusal> refusals;

  std::vector<extract::FaceIdentity> names() const {
    std::vector<extract::FaceIdentity> all;
    for (const FaceModel::Change& change : changes) {
      const auto names = change.names();
      all.insert(all.end(), names.begin(), names.end());
    }
    return all;
  }
  void undo(FaceModel& model) {
    while (!changes.empty()) {
      model.undo(std::move(changes.back()));
      changes.pop_back();
    }
  }
};

void apply(const v1::LiveStep& step, const JobContext& job, FaceModel& model, Applied& applied) {
  for (const v1::EditBatch& batch : step.batches()) {
    try {
      applied.changes.push_back(model.apply(batch, job));
    } catch (const Error& error) {
      if (error.code() != ErrorCode::kInvalid && error.code() != ErrorCode::kFormat) throw;
      applied.refusals.push_back({batch.edit(), error});
    }
  }
}

v1::LiveReply answer_to(const Applied::Refusal& refusal) {
  v1::LiveReply reply;
  reply.set_edit(refusal.edit);
  v1::Failure& failure = *reply.mutable_failure();
  failure.set_code(std::string(name_of(refusal.why.code())));
  failure.set_message(refusal.why.message());
  failure.set_hint(refusal.why.hint());
  return reply;
}

// On rank 0: one answer under the newest number; more with the same number only where it would be huge.
void send_numbers(std::uint64_t edit, double begun, const extract::FaceChanges& changes,
                  const extract::Update& update, const Send& send) {
  const std::size_t faces = update.statistics.size();
  std::size_t n = 0;
  do {
    v1::LiveReply reply;
    reply.set_edit(edit);
    if (n == 0)
      *reply.mutable_removed() = message_of(std::span<const extract::FaceIdentity>(changes.removed));
    for (const std::size_t end = std::min(faces, n + kFacesInReply); n < end; ++n) {
      const bool added = n < changes.added.size();
      const extract::Face& face = added ? changes.added[n] : changes.changed[n - changes.added.size()];
      append(extract::identity_of(face), update.statistics[n], *reply.mutable_numbers());
    }
    reply.set_engine_seconds(omp_get_wtime() - begun);
    send(reply);
  } while (n < faces);
}

}  // namespace

void live(ResidentState& state, const v1::Command& command, const Send& send, const JobContext& job) {
  const v1::LiveStep& step = command.live();
  const double begun = omp_get_wtime() - step.waited_seconds();
  std::int64_t needed = 0;
  for (const v1::EditBatch& batch : step.batches()) {
    const std::int64_t edit = edit_bytes(batch, static_cast<std::int64_t>(state.model.faces().size()));
    needed += edit + edit * extraction_passes(1) / model_bytes(1);
  }
  if (needed > kWorthAsking)
    state.memory.require_free(needed, "the edit", "close volumes that are not needed, or use more hosts");
  Applied applied;
  Extraction* extraction = nullptr;
  bool touched = false;
  try {
    // 1 The batches, each as a whole or not at all.
    extract::FaceChanges changes;
    state.world.collectively([&] {
      const OpenVolume& volume = state.volumes.find(step.volume());
      const extract::Options options = options_from(step.options(), state.threads);
      if (extract::asks_for(options, "offset")) {
        throw Error(ErrorCode::kUnsupported, "offset is not computed while faces are moved",
                    "leave offset out, and extract with it when the edit is done");
      }
      apply(step, job, state.model, applied);
      touched = true;
      const auto names = applied.names();
      state.extractions.touch(names, state.model.faces().size());
      extraction = &state.extractions.of(volume, options);
      extraction->touched.insert(names.begin(), names.end());  // also where it is new
      changes = extraction->changes(state.model.faces());
    });

    // 2 The faces that they touch; 3 the answers.
    const extract::Update& update = extraction->incremental->update(changes, job);
    extraction->touched.clear();
    state.world.collectively([&] {
      if (state.world.rank() != 0) return;
      for (const Applied::Refusal& refusal : applied.refusals) send(answer_to(refusal));
      if (!applied.changes.empty()) send_numbers(state.model.edit(), begun, changes, update, send);
    });
  } catch (const comm::AgreedError&) {
    const auto names = applied.names();
    applied.undo(state.model);
    if (touched) {
      // What was extracted above is no longer what is there, and nobody has heard of it.
      if (extraction != nullptr) extraction->complete = false;
      state.extractions.touch(names, state.model.faces().size());
    }
    throw;
  }
}

}  // namespace footwall::service
