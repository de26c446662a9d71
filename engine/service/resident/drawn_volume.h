// What an open volume keeps for isosurfaces and pictures of it.
#pragma once
#include "engine/service/resident/resident_state.h"
#include "engine/session/isosurface_picture.h"

namespace footwall::service {

// Of an open volume, made when it is first asked for; it goes with the volume. Collective; throws kInvalid
// where the volume's file is another one by now, and what reading volumes throws.
session::DrawnVolume& drawn_volume(ResidentState& state, const std::string& checksum);

}  // namespace footwall::service
