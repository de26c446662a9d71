// CPS-3 lines: `FFASCI` and `FFATTR` rows, then `->` in front of each line and rows `x y z`.
// Based on: public readers and a vendor's note on fault boundaries ('->' parts them; a closed one repeats its
// first point).
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "storage/formats/sticks.h"

namespace footwall::formats::cps3 {

// A row FFASCI or one that starts with '->' is in the head, and no row FSASCI (a grid).
bool recognises(std::string_view head);
// Sticks are numbered from 1 in the order of the file; text after '->' that is no number names the fault of
// its line. The null value is the last word of the FFASCI row where that is a number with a point or an
// exponent.
SticksImport parse(std::string_view text, const SticksOptions& options = {});
// One fault a file: the format has no place for its name, nor for unit and direction of z.
std::string write(std::span<const Stick> sticks, const SticksWriteOptions& options,
                  std::vector<std::string>& renamed);

}  // namespace footwall::formats::cps3
