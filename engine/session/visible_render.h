// Draws only what can be seen of isosurfaces on all ranks, for draw_isosurfaces().
#pragma once
#include "engine/session/isosurface_picture.h"

namespace footwall::session {

// Each isosurface by itself, as if it were the only one; their pictures are laid into one, by depth. Of a
// budget of time each gets an even share of what is left when it begins, but one pass at least. Collective;
// job.visible must be there. Throws and returns what draw_isosurfaces() does.
render::SurfaceLayer draw_visible(comm::Communicator& world, const RenderJob& job, const VolumeOf& volume_of,
                                  const JobContext& context, const AfterPass& after_pass,
                                  nlohmann::json& result);

}  // namespace footwall::session
