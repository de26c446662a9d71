#include "engine/isosurface/detail/half_table.h"

namespace footwall::isosurface::detail {
namespace {

// Triangles that follow each other around the same first vertex become one facet.
void append_record(const Pattern& pattern, std::vector<std::uint8_t>& records) {
  std::vector<std::vector<std::uint8_t>> facets;
  for (const auto& [a, b, c] : pattern.triangles) {
    if (!facets.empty() && facets.back().front() == a && facets.back().back() == b) {
      facets.back().push_back(c);
    } else {
      facets.push_back({a, b, c});
    }
  }
  records.push_back(static_cast<std::uint8_t>(facets.size()));
  for (const auto& facet : facets) records.push_back(static_cast<std::uint8_t>(facet.size()));
  for (const auto& facet : facets) records.insert(records.end(), facet.begin(), facet.end());
}

}  // namespace

HalfTable::HalfTable() {
  for (unsigned signs = 0; signs < first_.size(); ++signs) {
    first_[signs] = static_cast<std::uint32_t>(places_.size());
    const unsigned alternatives = is_undecided(signs) ? 256 : 1;
    for (unsigned alternative = 0; alternative < alternatives; ++alternative) {
      Place& place = places_.emplace_back();
      if (!has_pattern(signs, static_cast<Alternative>(alternative))) continue;
      const Pattern& pattern = pattern_of(signs, static_cast<Alternative>(alternative));
      place = {static_cast<std::uint32_t>(records_.size()), pattern.has_centre, pattern.centre_edges};
      append_record(pattern, records_);
    }
  }
}

}  // namespace footwall::isosurface::detail
