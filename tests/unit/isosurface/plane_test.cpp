#include "engine/isosurface/plane.h"

#include "variant_check.h"

namespace footwall::isosurface {
namespace {

TEST(Plane, GivesTheSurfaceOfTheDefinition) {
  check_random_volumes(extract_plane);
}

TEST(Plane, StandsOddValues) {
  check_odd_values(extract_plane);
}

TEST(Plane, OfAPartIsThatOfTheWhole) {
  check_parts(extract_plane);
}

TEST(Plane, GivesWhatIsAskedFor) {
  check_choices(extract_plane);
}

}  // namespace
}  // namespace footwall::isosurface
