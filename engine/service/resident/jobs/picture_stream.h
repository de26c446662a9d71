// A picture of isosurfaces, drawn by all ranks and sent in tiles.
#pragma once
#include "engine/comm/communicator.h"
#include "engine/service/engine.pb.h"
#include "engine/service/resident/jobs/box_reads.h"
#include "engine/service/resident/jobs/send.h"
#include "engine/session/isosurface_picture.h"
#include "storage/base/job_context.h"

namespace footwall::service {

// What is asked for as the command line's own job, without files. path_of: alike on every rank. Throws Error
// kUsage, kInvalid for a camera, placement or size that is none, and what path_of throws.
session::RenderJob render_job_of(const v1::RenderRequest& request, const VolumePath& path_of, int threads);

// Collective. Sends tiles of at most 256 rows, without rows that show nothing; with every_pass after each
// pass, followed by PassDone (after the last pass, too); then RenderDone with what RenderJob::result has.
// Throws on all ranks what draw_isosurfaces() throws, kCancelled where the client has gone.
void send_picture(comm::Communicator& world, const session::RenderJob& job, bool every_pass,
                  const session::VolumeOf& volume_of, const Send& send, const JobContext& context);

}  // namespace footwall::service
