// A look-up table of 128 entries; that of signs from 128 on is the entry of 255 - signs with its facets
// turned over. An entry is a record of variable length,
//
//   N  S1 .. SN  V1 .. VM
//
// with the number of facets, the number of vertices of each, and the vertices (edges 0..11, or kCentre) of
// all. A facet of S vertices is the fan of S - 2 triangles from its first one. Based on: seed 002,
// section 2.2.1; differs in that an entry has a record for each of its alternatives, and that facets are fans
// of triangles in space, which need not be plane.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "engine/isosurface/case_tables.h"

namespace footwall::isosurface::detail {

class HalfTable {
 public:
  // Made from the patterns of signs below 128.
  HalfTable();

  struct Entry {
    const std::uint8_t* record;
    bool turned;
    bool has_centre;
    std::uint16_t centre_edges;

    // Calls visit(a, b, c) for each triangle.
    template <class Visit>
    void for_each_triangle(Visit&& visit) const {
      const int facets = record[0];
      const std::uint8_t* vertex = record + 1 + facets;
      for (int facet = 0; facet < facets; ++facet) {
        const int count = record[1 + facet];
        for (int n = 2; n < count; ++n) {
          if (turned) {
            visit(vertex[0], vertex[n], vertex[n - 1]);
          } else {
            visit(vertex[0], vertex[n - 1], vertex[n]);
          }
        }
        vertex += count;
      }
    }
  };
  // An alternative that the signs can have.
  Entry entry(unsigned signs, Alternative alternative) const {
    const bool turned = signs >= 128;
    const unsigned half = turned ? 255 - signs : signs;
    const Alternative same = turned ? complement_of(signs, alternative) : alternative;
    const Place& place = places_[first_[half] + same];
    return {records_.data() + place.record, turned, place.has_centre, place.centre_edges};
  }

  // As Sweep asks for them.
  bool undecided(unsigned signs) const { return is_undecided(signs); }
  Alternative decide(unsigned signs, const std::array<float, 8>& values, float isovalue) const {
    return isosurface::decide(signs, values, isovalue);
  }

 private:
  struct Place {
    std::uint32_t record = 0;
    bool has_centre = false;
    std::uint16_t centre_edges = 0;
  };
  std::array<std::uint32_t, 128> first_{};  // of the alternatives' places; one for decided signs
  std::vector<Place> places_;
  std::vector<std::uint8_t> records_;
};

// The same face for rules that are given as patterns.
class PatternTable {
 public:
  explicit PatternTable(const CaseRules& rules) : rules_(rules) {}
  struct Entry {
    const Pattern& pattern;
    bool has_centre;
    std::uint16_t centre_edges;
    template <class Visit>
    void for_each_triangle(Visit&& visit) const {
      for (const auto& [a, b, c] : pattern.triangles) visit(a, b, c);
    }
  };
  Entry entry(unsigned signs, Alternative alternative) const {
    const Pattern& pattern = rules_.pattern(signs, alternative);
    return {pattern, pattern.has_centre, pattern.centre_edges};
  }
  bool undecided(unsigned signs) const { return rules_.undecided(signs); }
  Alternative decide(unsigned signs, const std::array<float, 8>& values, float isovalue) const {
    return rules_.decide(signs, values, isovalue);
  }

 private:
  const CaseRules& rules_;
};

}  // namespace footwall::isosurface::detail
