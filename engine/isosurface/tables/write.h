// The tables as C++.
#pragma once
#include <string>
#include <vector>

#include "engine/isosurface/tables/cases.h"

namespace footwall::isosurface::tables {

// The source file that defines what case_tables.h declares.
std::string as_source(const std::vector<SignCase>& all);

}  // namespace footwall::isosurface::tables
