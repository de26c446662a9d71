// What the user says about a SEG-Y file, as text and choices; and what a look at the file answers. No
// widgets.
#pragma once
#include <QString>
#include <optional>

#include "storage/formats/segy/survey_look.h"
#include "storage/project/project.h"

namespace footwall::ui {

struct SegyFields {
  // As storage/formats/segy/header_word.h writes them, "189", "81:ieee"; empty: where the headers show them.
  QString inline_byte, crossline_byte, x_byte, y_byte;
  QString scalar;             // of coordinates, as at byte 71: -100 divides by 100; empty: each trace's own
  std::optional<int> format;  // sample format code; none: the file's
  std::optional<formats::segy::Endian> endian;
  QString interval;  // in the vertical unit; empty: the file's
  // SEG-Y cannot tell these, so nothing is assumed.
  std::optional<survey::Domain> domain;
  std::optional<survey::VerticalUnit> unit;
  QString crs;   // may stay empty: not stated
  QString name;  // of the volume
};

// Throws kUsage naming the field. Without domain and unit the look is as for ms.
formats::segy::Options options_of(const SegyFields& fields);

// "189/193: 23 × 18 lines, 100 % filled, fit 0.02 bins (preset rev1)".
QString evidence_of(const formats::segy::LineCandidate& candidate);
// Of the words that are used: "189/193: 23 × 18 lines, 0 gaps, fit 0.02 m".
QString evidence_of(const formats::segy::Inspection& found);

// What keeps the file from being imported, each a short sentence; empty where nothing does. look may be null:
// still reading. project may be null: a new one.
QStringList missing_of(const SegyFields& fields, const formats::segy::SurveyLook* look,
                       const project::Project* project);

// "Import 414 traces (read 0.2 MB, write 0.1 MB)"; "Import" where nothing is known.
QString import_text(const formats::segy::SurveyLook* look);
// "0.2 MB"
QString bytes_text(std::int64_t bytes);

}  // namespace footwall::ui
