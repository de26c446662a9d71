// footwall export --for PROGRAM --out FOLDER: everything that a program can load, and how.
#include "app/footwall/commands/export_parts.h"
#include "engine/tasks/export_petrel.h"
#include "storage/base/log.h"

namespace footwall::commands {

void ExportPackage::add_to(CLI::App& command) {
  command.add_option("--for", program, "Everything that a program can load, into the folder of --out")
      ->check(CLI::IsMember({"petrel"}));
  command.add_option("--out", folder, "The folder for --for; it is made where it is not there");
}

void ExportPackage::check() const {
  if (program.empty() == folder.empty()) return;
  throw Error(ErrorCode::kUsage, "--for and --out go together", "e.g. --for petrel --out FOLDER");
}

void ExportPackage::run(const project::Project& project, const ExportChoice& choice,
                        console::Output& output) const {
  tasks::PetrelOptions how;
  how.fault = choice.fault;
  how.run = choice.run;
  how.z_positive_up = choice.z_up(true);
  how.z_unit = choice.z_unit;
  const tasks::PetrelExport done = tasks::export_petrel(project, folder, how);
  for (const std::string& file : done.files) add_file(output, file);
  add_renamed(output, done.renamed);
  for (const std::string& line : done.notices) log::warn(line);
}

}  // namespace footwall::commands
