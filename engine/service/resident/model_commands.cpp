// Changing and reading the model.
#include <set>

#include "engine/service/ranks.pb.h"
#include "engine/service/resident/commands.h"
#include "engine/service/resident/memory_needs.h"
#include "engine/service/resident/pieces.h"
#include "engine/service/resident/resident_state.h"
#include "engine/service/wire.h"
#include "storage/base/hash.h"

namespace footwall::service {

void edit_model(ResidentState& state, const v1::Command& command, const Send& send, const JobContext& job) {
  const std::int64_t needed =
      edit_bytes(command.edit_model(), static_cast<std::int64_t>(state.model.faces().size()));
  if (needed > kWorthAsking)
    state.memory.require_free(needed, "the edit", "close volumes that are not needed, or use more hosts");
  std::optional<FaceModel::Change> change;
  try {
    state.world.collectively([&] {
      job.check();
      change = state.model.apply(command.edit_model(), job);
    });
    state.world.collectively([&] {
      if (state.world.rank() != 0) return;
      v1::EditModelReply reply;
      reply.set_edit(state.model.edit());
      reply.set_faces(static_cast<std::int64_t>(state.model.faces().size()));
      reply.set_state_hash(to_hex(state.hash()));
      for (const mesh::Applied& made : change->made()) {
        v1::Made& to = *reply.add_made();
        to.set_mesh(made.mesh);
        to.set_vertex(made.vertex);
        to.set_edge(made.edge);
        to.set_face(made.face);
      }
      send(reply);
    });
  } catch (const comm::AgreedError&) {
    if (change) state.model.undo(std::move(*change));
    throw;
  }
  state.extractions.touch(change->names(), state.model.faces().size());
}

void read_model(ResidentState& state, const v1::Command& command, const Send& send, const JobContext& job) {
  const auto& faults = command.read_model().faults();
  state.world.collectively([&] {
    if (state.world.rank() != 0) return;
    const std::set<std::int64_t> asked(faults.begin(), faults.end());
    std::vector<extract::Face> piece;
    const auto send_piece = [&] {
      if (piece.empty()) return;
      job.check();
      v1::ReadModelReply reply;
      *reply.mutable_faces() = message_of(std::span<const extract::Face>(piece));
      send(reply);
      piece.clear();
    };
    for (const auto& [name, triangle] : state.model.faces()) {
      if (!asked.empty() && !asked.contains(name.fault)) continue;
      piece.push_back({name.fault, name.owner, name.n, triangle});
      if (piece.size() == kFacesInPiece) send_piece();
    }
    send_piece();
  });
}

}  // namespace footwall::service
