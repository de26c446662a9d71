// The parts of `footwall export`: each adds its options, says whether any was given, and writes its files.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "app/footwall/console/program.h"
#include "storage/project/project.h"

namespace footwall::commands {

// Options that several parts look at.
struct ExportChoice {
  std::string fault;                // empty: all
  std::optional<std::int64_t> run;  // none: the last
  std::string z_positive;           // "up", "down" or empty: the format's default
  std::string z_unit;               // "ms", "s", "m", "ft" or empty: the survey's vertical unit

  void add_to(CLI::App& command);
  bool z_up(bool otherwise) const { return z_positive.empty() ? otherwise : z_positive == "up"; }
};

struct ExportVolumes {
  std::string volume, section, raw, nrrd, segy, vti;
  std::string axes, endian, holes = "skip";
  int segy_format = 5;
  std::optional<float> segy_null;

  void add_to(CLI::App& command);
  bool asked() const { return !(raw.empty() && nrrd.empty() && segy.empty() && vti.empty()); }
  void run(const project::Project& project, const ExportChoice& choice, const console::Console& console,
           console::Output& output) const;
};

struct ExportFaces {
  std::string vtp, tsurf, csv;
  std::vector<std::string> properties;
  bool strict = false;

  void add_to(CLI::App& command);
  bool asked() const { return !vtp.empty() || !tsurf.empty() || !csv.empty(); }
  void run(const project::Project& project, const ExportChoice& choice, console::Output& output) const;
};

struct ExportFaceVoxels {
  std::string file;

  void add_to(CLI::App& command);
  bool asked() const { return !file.empty(); }
  void run(const project::Project& project, const ExportChoice& choice, const console::Console& console,
           console::Output& output) const;
};

struct ExportSticks {
  std::string sticks, format = "charisma";
  bool interpolated = false, no_blanks = false;

  void add_to(CLI::App& command);
  bool asked() const { return !sticks.empty(); }
  void run(const project::Project& project, const ExportChoice& choice, console::Output& output) const;
};

// A folder for another program, with a note on how to load it.
struct ExportPackage {
  std::string program, folder;

  void add_to(CLI::App& command);
  bool asked() const { return !program.empty(); }
  // Throws kUsage where only one of the two options is given.
  void check() const;
  void run(const project::Project& project, const ExportChoice& choice, console::Output& output) const;
};

// Notes a file that was written.
void add_file(console::Output& output, const std::string& file);
// Notes names that a format cannot hold, as "old -> new".
void add_renamed(console::Output& output, const std::vector<std::string>& renamed);

}  // namespace footwall::commands
