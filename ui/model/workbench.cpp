#include "ui/model/workbench.h"

#include <QJsonDocument>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "storage/base/log.h"

namespace footwall::ui {
namespace {

constexpr auto kStoreAfter = std::chrono::milliseconds(1000);
constexpr const char* kDisplaySetting = "studio.display";

// Heights are drawn so that the survey is a third as high as it is wide, in whole steps; true where it is
// already.
double fitting_exaggeration(const survey::Geometry& survey) {
  const auto corner = [&](double i, double j) { return survey.world_of({i, j, 0}); };
  const survey::Index dims = survey.dims();
  const survey::WorldPoint a = corner(0, 0);
  const survey::WorldPoint b = corner(static_cast<double>(dims[0] - 1), static_cast<double>(dims[1] - 1));
  const double width = survey.horizontal_metres(std::hypot(b.x - a.x, b.y - a.y));
  constexpr double kVelocity = 2000;  // m/s: a millisecond is a metre, as in the scene without a velocity
  const double height =
      std::abs(survey.vertical_metres(static_cast<double>(dims[2]) * survey.interval, kVelocity));
  if (!(width > 0) || !(height > 0)) return 1;
  return std::clamp(std::round(width / (3 * height)), 1.0, 20.0);
}

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
      line(document, display, picking),
      sections(document),
      engine(document, engine_options),
      surfaces(document, &engine),
      shown_numbers(document, display, surfaces) {
  const auto stored = document.project().setting(kDisplaySetting);
  if (stored) display.from_json(QJsonDocument::fromJson(QByteArray::fromStdString(*stored)).object());
  if (!stored && document.survey()) display.set_exaggeration(fitting_exaggeration(*document.survey()));
  if (display.sections().empty()) show_middle_sections(document, display);
  QObject::connect(&display, &Display::samples_changed, &engine, [this] {
    if (display.volume() != engine.volume()) engine.set_volume(display.volume());
  });
  display_changed_.setSingleShot(true);
  display_changed_.setInterval(kStoreAfter);
  QObject::connect(&display, &Display::changed, &display_changed_, qOverload<>(&QTimer::start));
  QObject::connect(&display_changed_, &QTimer::timeout, &display_changed_, [this] { store_display(); });
  if (display.volume() != 0) engine.set_volume(display.volume());
  if (engine_options.starts_at_once && display.volume() != 0) engine.start();
}

Workbench::~Workbench() {
  if (document.read_only()) return;
  try {
    surfaces.store_live_run();
  } catch (const Error& error) {
    log::warn("the live colours could not be stored: " + error.message());
  }
  store_display();
}

void Workbench::store_display() {
  if (document.read_only()) return;
  try {
    const QByteArray json = QJsonDocument(display.to_json()).toJson(QJsonDocument::Compact);
    document.store().set_setting(kDisplaySetting, json.toStdString());
  } catch (const Error& error) {
    log::warn("what was shown could not be stored: " + error.message());
  }
}

std::unique_ptr<Workbench> open_workbench(const std::filesystem::path& path,
                                          const EngineLink::Options& engine, QString* held) {
  held->clear();
  std::unique_ptr<EditSocket> edits;
  project::OpenOptions options;
  try {
    edits = std::make_unique<EditSocket>();
    options.edit_socket = edits->path();
  } catch (const Error& error) {
    log::warn("no edits are taken from other programs: " + error.message());
  }
  try {
    auto workbench =
        std::make_unique<Workbench>(project::Project::open(path, project::OpenMode::kWrite, options), engine);
    if (edits) edits->serve(workbench->document);
    workbench->edits = std::move(edits);
    return workbench;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kHeld) throw;
    *held = QString::fromStdString(error.message());
  }
  return std::make_unique<Workbench>(project::Project::open(path, project::OpenMode::kRead), engine);
}

}  // namespace footwall::ui
