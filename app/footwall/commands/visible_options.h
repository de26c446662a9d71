// The options of commands that can be asked for only what can be seen of isosurfaces, and how passes are
// told.
#pragma once
#include <optional>
#include <string>

#include "app/footwall/console/program.h"
#include "engine/session/visible_choice.h"

namespace footwall::commands {

struct VisibleOptions {
  bool visible = false;
  std::string mode, cell, estimate_cell, pass_images;
  std::optional<double> budget;
  std::optional<int> passes;

  void add_to(CLI::App& command);
  // None without --visible. Throws Error kUsage for options that need it, or another mode, and for numbers
  // that cannot be.
  std::optional<session::VisibleChoice> choice() const;

 private:
  // The first of the options that need --visible which was given; "" where none was.
  std::string needs_visible() const;
};

// A table of the passes of one isosurface: of the engine's report with pixels counted (tasks/visible.h).
std::string passes_in_words(const console::Json& report);

}  // namespace footwall::commands
