// The algorithms by name, for the command line, dialogs and messages. A new one is one file and one row.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/extract/face.h"

namespace footwall::extract {

struct Row {
  std::string_view name;
  bool built;
  std::string_view help;
};

std::span<const Row> exchange_rows();   // auto and those of exchange/strategies.cpp
std::span<const Row> balance_rows();    // those of balance/strategies.cpp
std::span<const Row> voxelizer_rows();  // those of engine/voxelize/registry.h
std::span<const Row> statistic_rows();  // those of computations.h

// What users who name nothing get: all statistics that fold, but for `offset`, which costs 17 times what a
// face does (contrast: three times).
std::vector<std::string> usual_computations();

// Throws Error kUsage for names that are unknown or not built, and for impossible numbers.
void validate(const Options& options);

// The row of `text`, which may carry parameters ("block=8": not looked at); throws Error kUsage, listing the
// names, where there is none or it is not built. `family` is the option's name, e.g. "exchange".
const Row& find_row(std::span<const Row> rows, std::string_view family, std::string_view text);

}  // namespace footwall::extract
