// What an open volume keeps for isosurfaces and pictures of it.
#pragma once
#include <list>
#include <span>

#include "engine/service/resident/jobs/surface_stream.h"
#include "engine/service/resident/resident_state.h"
#include "engine/session/isosurface_picture.h"

namespace footwall::service {

class DrawnKept final : public Kept {
 public:
  DrawnKept(comm::Communicator& world, const std::filesystem::path& path) : drawn(world, path) {}
  std::int64_t memory_bytes() const override;

  session::DrawnVolume drawn;
  SentSurfaces sent;
};

// Of an open volume, made when it is first asked for; it goes with the volume, or where memory is short: then
// references no longer hold. Collective; throws kInvalid where the volume's file is another one by now, and
// what reading volumes throws.
DrawnKept& drawn_volume(ResidentState& state, const std::string& checksum);

}  // namespace footwall::service
