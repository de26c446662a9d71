// The tables as C++.
#pragma once
#include <string>
#include <vector>

#include "engine/isosurface/tables/cases.h"

namespace footwall::isosurface::tables {

// The source file that defines what case_tables.h declares, with a comment at its top.
std::string as_source(const std::vector<SignCase>& all, const std::string& comment);

}  // namespace footwall::isosurface::tables
