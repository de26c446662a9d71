// The voxels that one triangle cuts, with their values, from the ranks that own them.
#pragma once
#include "engine/extract/extract.h"
#include "engine/service/engine.pb.h"
#include "engine/service/resident/jobs/send.h"
#include "storage/volume/volume_info.h"

namespace footwall::service {

// Collective, by the way of the computations `voxels` and `lot` of EXTRACT-ALL: the same bytes as a run of
// the command line keeps. Sends FaceVoxelsReply pieces: places and values (code "voxels", the empty word
// too), or places and then the code's bytes. Throws on all ranks kUsage (code, voxelizer, ratio), kInvalid
// (not nine corners, or too far away), kMemory, kCancelled.
void send_face_values(const comm::Communicator& world, extract::LoadedSurvey& survey,
                      const volume::VolumeInfo& info, const v1::FaceVoxelsRequest& request, int threads,
                      const Send& send, const JobContext& job);

}  // namespace footwall::service
