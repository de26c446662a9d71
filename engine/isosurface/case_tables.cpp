#include "engine/isosurface/case_tables.h"

namespace footwall::isosurface {

const CaseRules& trilinear_rules() {
  static constexpr CaseRules kRules{is_undecided, decide, pattern_of};
  return kRules;
}

}  // namespace footwall::isosurface
