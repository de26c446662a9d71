// RMS points and polygons (.poi, .pol, rms_attr): rows `x y z [attributes]`; a row of three times 999.0 ends
// a line. Based on: what xtgeo reads and writes, and real files; unlike there, 999.0 in one column alone is a
// value.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "storage/formats/sticks.h"

namespace footwall::formats::rms {

// Three of four rows at least are three numbers, one of them 999.0 alone; or attribute rows ("Discrete",
// "String", "Float", "Int", each with a name) stand in front of rows of numbers.
bool recognises(std::string_view head);
// Lines are numbered from 1 in the order of the file. In a file without any row of 999.0 the rows are points,
// each a stick of one. An attribute called fault or fault name (in any case, with or without "_") gives the
// name, one called stick, stick id, segment, segment id, seg, line id or poly id the stick's number.
SticksImport parse(std::string_view text, const SticksOptions& options = {});
// One fault a file, lines ended by 999.0: the format has no place for the name, nor for unit and direction of
// z. Throws kInvalid for a point at 999 999 999.
std::string write(std::span<const Stick> sticks, const SticksWriteOptions& options,
                  std::vector<std::string>& renamed);

}  // namespace footwall::formats::rms
