// All sign cases of a cell with all of their alternatives.
#pragma once
#include <map>
#include <vector>

#include "engine/isosurface/tables/triangulate.h"

namespace footwall::isosurface::tables {

struct Entry {
  Filling filling;
  int loops = 0;
  int tunnels = 0;  // 0 or 1
};

struct SignCase {
  std::map<unsigned, Entry> entries;  // by alternative, as in case_tables.h
  std::map<unsigned, Entry> fans;     // without tunnels
};

// By signs 0..255. The entries of 255 - signs are those of signs with every triangle turned over. Throws
// std::runtime_error where no triangulation is found.
std::vector<SignCase> all_cases();

}  // namespace footwall::isosurface::tables
