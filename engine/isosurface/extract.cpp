#include "engine/isosurface/extract.h"

#include "engine/isosurface/bricks.h"
#include "engine/isosurface/detail/arguments.h"

namespace footwall::isosurface {

void extract(const Field& field, float isovalue, const ExtractOptions& options, Surface& into) {
  detail::check_arguments(field, isovalue, options);
  extract_bricks(field, isovalue, options, into);
}

}  // namespace footwall::isosurface
