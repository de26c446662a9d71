// The responsible rank asks the owners for exactly the voxels that it lacks.
// Based on: seed 004, section 3.4.1 (strategy 1, minimum communication); differs in that a rank's halo of one
// trace counts as its own.
#include "engine/extract/exchange/by_request.h"

namespace footwall::extract {

Outcome exchange_minimum(const Setup& setup) {
  return exchange_by_request(setup, 1);
}

}  // namespace footwall::extract
