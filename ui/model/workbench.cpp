#include "ui/model/workbench.h"

#include <QJsonDocument>
#include <utility>

#include "storage/base/log.h"

namespace footwall::ui {
namespace {

constexpr const char* kDisplaySetting = "studio.display";

// What a new project shows: the middle inline, crossline and slice.
void show_middle_sections(const Document& document, Display& display) {
  if (!document.survey()) return;
  const survey::Index dims = document.survey()->dims();
  display.add_section({.kind = Section::Kind::kInline, .index = dims[0] / 2});
  display.add_section({.kind = Section::Kind::kCrossline, .index = dims[1] / 2});
  display.add_section({.kind = Section::Kind::kSlice, .index = dims[2] / 2});
}

}  // namespace

Workbench::Workbench(project::Project opened, const EngineLink::Options& engine_options)
    : document(std::move(opened)),
      selection(document),
      display(document),
      picking(document, selection, display),
      sections(document),
      engine(document, engine_options),
      surfaces(document, &engine) {
  const auto stored = document.project().setting(kDisplaySetting);
  if (stored) display.from_json(QJsonDocument::fromJson(QByteArray::fromStdString(*stored)).object());
  if (display.sections().empty()) show_middle_sections(document, display);
}

Workbench::~Workbench() {
  if (document.read_only()) return;
  try {
    const QByteArray json = QJsonDocument(display.to_json()).toJson(QJsonDocument::Compact);
    document.store().set_setting(kDisplaySetting, json.toStdString());
  } catch (const Error& error) {
    log::warn("what was shown could not be stored: " + error.message());
  }
}

std::unique_ptr<Workbench> open_workbench(const std::filesystem::path& path, const EngineLink::Options& engine,
                                          QString* held) {
  held->clear();
  try {
    return std::make_unique<Workbench>(project::Project::open(path, project::OpenMode::kWrite), engine);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kHeld) throw;
    *held = QString::fromStdString(error.message());
  }
  return std::make_unique<Workbench>(project::Project::open(path, project::OpenMode::kRead), engine);
}

}  // namespace footwall::ui
