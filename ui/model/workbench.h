// Everything that one window works on. Widgets hold a reference and live shorter.
#pragma once
#include <QTimer>
#include <memory>

#include "ui/model/display.h"
#include "ui/model/document.h"
#include "ui/model/edit_socket.h"
#include "ui/model/engine_link.h"
#include "ui/model/jobs.h"
#include "ui/model/line_drawing.h"
#include "ui/model/mouse_bindings.h"
#include "ui/model/picking.h"
#include "ui/model/section_reader.h"
#include "ui/model/selection.h"
#include "ui/model/shown_numbers.h"
#include "ui/model/surfaces.h"

namespace footwall::ui {

struct Workbench {
  // engine: nothing starts until it is needed.
  Workbench(project::Project project, const EngineLink::Options& engine);
  // Stores what is shown (Display) in the project; that also happens a moment after each change, so that a
  // program that is killed loses none of it.
  ~Workbench();

  Document document;
  Selection selection;
  Display display;
  Picking picking;
  LineDrawing line;
  SectionReader sections;
  EngineLink engine;
  Surfaces surfaces;           // what is known now
  ShownNumbers shown_numbers;  // what views show of it, or of a run
  Jobs jobs;
  std::unique_ptr<EditSocket> edits;  // null where none are taken
  MouseChoice mouse;

 private:
  void store_display();
  QTimer display_changed_;
};

// A project by path. For writing; where somebody else writes it, for reading, and
// `held` then says who (empty otherwise). Throws Error.
std::unique_ptr<Workbench> open_workbench(const std::filesystem::path& path,
                                          const EngineLink::Options& engine, QString* held);

}  // namespace footwall::ui
