#include "engine/synthetic/registry.h"

#include <fmt/format.h>

#include "storage/base/error.h"

namespace footwall::synthetic {
namespace {

constexpr SurveyKind kKinds[] = {
    {"faulted", "folded layers cut by a planar, a listric and a twisted fault",
     [](const Options& options) { return FaultedSurvey(options); }},
};

}  // namespace

std::span<const SurveyKind> survey_kinds() {
  return kKinds;
}

FaultedSurvey make_survey(std::string_view name, const Options& options) {
  std::string names;
  for (const SurveyKind& kind : survey_kinds()) {
    if (kind.name == name) return kind.make(options);
    names += names.empty() ? "" : ", ";
    names += kind.name;
  }
  throw Error(ErrorCode::kUsage, fmt::format("there is no synthetic survey '{}'", name),
              "choose one of: " + names);
}

}  // namespace footwall::synthetic
