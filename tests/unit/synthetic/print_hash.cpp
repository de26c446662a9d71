// Prints the hashes of the small survey, and which processor features the C library believes it may use.
#include <fmt/format.h>

#if defined(__GLIBC__) && __has_include(<sys/platform/x86.h>)
#ifdef __clang__
#define _Bool bool  // the header is written in C
#endif
#include <sys/platform/x86.h>
#define FOOTWALL_FEATURE(name) (CPU_FEATURE_ACTIVE(name) ? "on" : "off")
#else
#define FOOTWALL_FEATURE(name) "unknown"
#endif

#include <cstdio>

#include "unit/synthetic/small_survey.h"

int main() {
  using namespace footwall::synthetic;
  const FaultedSurvey survey(small_survey());
  const std::string line = fmt::format("{} {} avx2={} fma={}", hash_of_voxels(survey), hash_of_faults(survey),
                                       FOOTWALL_FEATURE(AVX2), FOOTWALL_FEATURE(FMA));
  return std::puts(line.c_str()) < 0 ? 1 : 0;
}
