// What can be exported, and the doing of it. No widgets.
#pragma once
#include <QString>
#include <QStringList>
#include <functional>
#include <optional>

#include "storage/project/project.h"
#include "ui/model/document.h"

namespace footwall::ui {

struct ExportChoice {
  enum class Kind { kCsv, kVtp, kTsurf, kSticks, kPicture, kSegy, kVti, kNrrd, kRaw };
  Kind kind = Kind::kCsv;
  QString file;
  std::string fault;      // empty: all
  std::optional<Id> run;  // of the statistics; none: the last
  std::string volume;     // by name; empty: the first
  std::string stick_format = "charisma";
  bool interpolated = false;  // sticks: the interpolated pillars too
};

bool is_volume(ExportChoice::Kind kind);
// The suffix with its dot, ".csv".
QString suffix_of(const ExportChoice& choice);
// The file's name with the suffix of the kind, whatever suffix of a kind it has now.
QString with_suffix(const QString& file, const ExportChoice& choice);
// Formats of sticks that can be written.
QStringList stick_format_names();

// Writes the picture of the scene or a section to a PNG; throws Error.
using WritePicture = std::function<void(const QString& file)>;

struct Exported {
  QString text;         // "3,108 faces of 2 faults, statistics of run 3"
  QStringList notices;  // names that had to change, faults that are stale
};
// In the window's thread: makes the picture, and opens a connection to the project for the rest. What comes
// back reads and writes, on any thread. Both throw what tasks::write_faces(), tasks::export_sticks(),
// tasks::export_segy() and their likes, and write_picture throw.
std::function<Exported(const JobContext&)> prepare_export(const project::Project& project,
                                                          const ExportChoice& choice,
                                                          const WritePicture& write_picture);

}  // namespace footwall::ui
