// The kinds of synthetic survey that `new --synthetic NAME` offers.
#pragma once
#include <span>
#include <string_view>

#include "engine/synthetic/faulted.h"

namespace footwall::synthetic {

struct SurveyKind {
  std::string_view name;
  std::string_view help;  // one line
  FaultedSurvey (*make)(const Options&);
};

std::span<const SurveyKind> survey_kinds();
// Throws Error kUsage listing the names if there is none of that name, and whatever the kind's constructor
// throws.
FaultedSurvey make_survey(std::string_view name, const Options& options);

}  // namespace footwall::synthetic
