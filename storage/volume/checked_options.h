// What a writer was asked for, checked before any work is done.
#pragma once
#include "storage/volume/volume_writer.h"

namespace footwall::volume {

// The info of the volume to be written, with its chunk; what only the samples can tell is left at its
// defaults. Throws kInvalid: what cannot be stored is refused before hours of import, not after.
VolumeInfo checked(const WriteOptions& options);

}  // namespace footwall::volume
