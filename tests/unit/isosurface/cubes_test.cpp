#include "engine/isosurface/cubes.h"

#include "variant_check.h"

namespace footwall::isosurface {
namespace {

TEST(Cubes, GivesTheSurfaceOfTheDefinition) {
  check_random_volumes(extract_cubes);
}

TEST(Cubes, StandsOddValues) {
  check_odd_values(extract_cubes);
}

TEST(Cubes, OfAPartIsThatOfTheWhole) {
  check_parts(extract_cubes);
}

TEST(Cubes, GivesWhatIsAskedFor) {
  check_choices(extract_cubes);
}

}  // namespace
}  // namespace footwall::isosurface
