// Draws only what can be seen of isosurfaces on all ranks, for run_render().
#pragma once
#include "engine/session/render_job.h"

namespace footwall::session {

// Each isosurface by itself, as if it were the only one; their pictures are laid into one, by depth. Of a
// budget of time each gets an even share of what is left when it begins, but one pass at least. Collective;
// job.visible must be there. Throws and leaves what run_render() does.
void run_visible_render(comm::Communicator& world, const RenderJob& job, const JobContext& context);

}  // namespace footwall::session
