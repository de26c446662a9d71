#include <QApplication>
#include <QInputDialog>
#include <QKeyEvent>
#include <algorithm>

#include "ui/window/action_groups.h"
#include "ui/window/line_dialog.h"
#include "ui/window/main_window.h"
#include "ui/window/saved_views.h"
#include "ui/window/view_area.h"
#include "ui/window/view_tile.h"

namespace footwall::ui {
namespace {

constexpr int kFarSteps = 10;
constexpr double kGainFactor = 1.25;
constexpr double kTallerFactor = 1.25;

Display& display(MainWindow& window) {
  return window.workbench()->display;
}

// The middle of the survey, or what the cursor points at.
template <Section::Kind kKind>
void add_section(MainWindow& window) {
  const survey::Geometry& survey = *window.workbench()->document.survey();
  const survey::Index dims = survey.dims();
  Section section{.kind = kKind};
  section.index = last_index(section, survey) / 2;
  if (const auto& cursor = display(window).cursor()) {
    section.index = std::llround(kKind == Section::Kind::kInline      ? cursor->i
                                 : kKind == Section::Kind::kCrossline ? cursor->j
                                                                      : cursor->k);
  }
  section.to = {static_cast<double>(dims[0] - 1), static_cast<double>(dims[1] - 1), 0};
  display(window).add_section(stepped(section, 0, survey));
}

const Display::ShownSection* shown_as(MainWindow& window, Id id) {
  const auto& all = display(window).sections();
  const auto found = std::ranges::find(all, id, &Display::ShownSection::id);
  return found == all.end() ? nullptr : &*found;
}

// The active view where it is a slice, else the first that is; null where there is none.
ViewTile* slice_of(MainWindow& window) {
  const auto is_slice = [&window](const ViewTile* tile) {
    const Display::ShownSection* shown = tile == nullptr ? nullptr : shown_as(window, tile->section());
    return shown != nullptr && shown->section.kind == Section::Kind::kSlice;
  };
  if (is_slice(window.views()->active())) return window.views()->active();
  const auto all = window.views()->tiles();
  const auto found = std::ranges::find_if(all, is_slice);
  return found == all.end() ? nullptr : *found;
}

// With a slice in view, on which its ends are said.
void draw_line(MainWindow& window) {
  LineDrawing& line = window.workbench()->line;
  if (line.is_active()) return line.end();
  ViewArea& views = *window.views();
  if (ViewTile* slice = slice_of(window)) {
    if (views.maximised() != nullptr && views.maximised() != slice) views.maximise(views.maximised());
    views.activate(slice);
    slice->view()->setFocus(Qt::ShortcutFocusReason);
  } else {
    add_section<Section::Kind::kSlice>(window);
  }
  line.begin();
}

void toggle_in_scene(MainWindow& window) {
  const Display::ShownSection* shown = shown_as(window, window.views()->active_section());
  if (shown == nullptr) return;
  Display::ShownSection changed = *shown;
  changed.in_scene = !changed.in_scene;
  display(window).change_section(changed);
}

bool is_in_scene(MainWindow& window) {
  const Display::ShownSection* shown = shown_as(window, window.views()->active_section());
  return shown != nullptr && shown->in_scene;
}

void set_fade_distance(MainWindow& window) {
  constexpr double kFarthest = 10000;
  bool ok = false;
  const double voxels = QInputDialog::getDouble(
      &window, QCoreApplication::translate("Actions", "Fade distance"),
      QCoreApplication::translate("Actions",
                                  "Pillars beside a section are drawn up to this many lines or samples "
                                  "away, paler with distance:"),
      display(window).fade_distance(), 0, kFarthest, 1, &ok);
  if (ok) display(window).set_fade_distance(voxels);
}

void step(MainWindow& window, int steps) {
  const Id id = window.views()->active_section();
  const Display::ShownSection* shown = shown_as(window, id);
  const auto& survey = window.workbench()->document.survey();
  if (shown == nullptr || !survey) return;
  display(window).move_section(
      id, stepped(shown->section, static_cast<std::int64_t>(steps) * window.workbench()->picking.step_lines(),
                  *survey));
}

// What each kind of view does in its own way goes to it as the key that it knows.
template <Qt::Key kKey>
void send_key(MainWindow& window) {
  QWidget* view = window.views()->active()->view();
  while (view->focusProxy() != nullptr) view = view->focusProxy();
  for (const QEvent::Type type : {QEvent::KeyPress, QEvent::KeyRelease}) {
    QKeyEvent event(type, kKey, Qt::NoModifier);
    QApplication::sendEvent(view, &event);
  }
}

void change_gain(MainWindow& window, double factor) {
  SampleLook look = display(window).samples();
  look.gain = std::clamp(look.gain * factor, 1e-3, 1e3);
  display(window).set_samples(look);
}

void toggle_interpolation(MainWindow& window) {
  SampleLook look = display(window).samples();
  look.interpolate = !look.interpolate.value_or(false);
  display(window).set_samples(look);
}

void toggle_wiggle(MainWindow& window) {
  SampleLook look = display(window).samples();
  look.wiggle = !look.wiggle;
  display(window).set_samples(look);
}

void toggle_edges(MainWindow& window) {
  FaceLook look = display(window).faces();
  look.edges = !look.edges;
  display(window).set_faces(look);
}

void colour_by(MainWindow& window, FaceColours colours, const char* statistic = nullptr) {
  FaceLook look = display(window).faces();
  look.colours = colours;
  if (statistic != nullptr && look.statistic != QLatin1String(statistic)) {
    look.statistic = QString::fromLatin1(statistic);
    look.colour_map.clear();
    look.low.reset();
    look.high.reset();
  }
  display(window).set_faces(look);
}

bool is_coloured_by(MainWindow& window, const char* statistic) {
  const FaceLook& look = display(window).faces();
  return look.colours == FaceColours::kStatistic && look.statistic == QLatin1String(statistic);
}

// The run selected in the project panel; where that is shown already, or none is selected, back to what is
// known now.
void toggle_run(MainWindow& window) {
  const Item& selected = window.workbench()->selection.current();
  const bool another = selected.kind == Item::Kind::kRun && selected.id != display(window).faces().run;
  display(window).show_run(another ? selected.id : 0);
}

bool is_run_shown(MainWindow& window) {
  const Item& selected = window.workbench()->selection.current();
  const Id shown = display(window).faces().run;
  return shown != 0 && (selected.kind != Item::Kind::kRun || selected.id == shown);
}

// In a time survey without a velocity offsets are known in voxels alone.
bool offsets_are_metric(MainWindow& window) {
  const Document& document = window.workbench()->document;
  if (!document.survey() || document.survey()->has_metric_depth()) return true;
  try {
    const auto velocity = document.project().setting("velocity");
    return velocity && QString::fromStdString(*velocity).toDouble() > 0;
  } catch (const Error& error) {
    window.tell_failure(QString::fromStdString(error.message()), QString::fromStdString(error.hint()));
    return false;
  }
}

// A row that colours the faces by a statistic.
template <const char* const& kStatistic>
ActionRow statistic_row(const char* id, const char* name, const char* key, const char* tip,
                        bool starts_group = false) {
  return {id,
          Menu::kView,
          name,
          key,
          "colours",
          tip,
          kProject,
          [](MainWindow& window) { colour_by(window, FaceColours::kStatistic, kStatistic); },
          [](MainWindow& window) { return is_coloured_by(window, kStatistic); },
          starts_group};
}

// A row that turns the scene.
template <ViewFactories::From kSide>
ActionRow look_row(const char* id, const char* name, const char* key, const char* tip,
                   bool starts_group = false) {
  return {id,
          Menu::kView,
          name,
          key,
          "look",
          tip,
          kProject | kScene,
          [](MainWindow& window) {
            const auto& look_from = window.views()->factories().look_from;
            if (look_from) look_from(*window.views()->scene()->view(), kSide);
          },
          nullptr,
          starts_group};
}

constexpr const char* kVariance = "variance";
constexpr const char* kContrast = "contrast";
constexpr const char* kOffset = "offset";
constexpr const char* kOffsetVoxels = "offset_voxels";
constexpr const char* kMean = "mean";
constexpr const char* kDip = "dip";
constexpr const char* kAzimuth = "dip_azimuth";

std::vector<ActionRow> place_actions() {
  using M = Menu;
  constexpr unsigned kSurveyed = kProject | kSurvey;
  return {
      {"view.inline", M::kView, QT_TRANSLATE_NOOP("Actions", "&Inline"), "Ctrl+1", "inline",
       QT_TRANSLATE_NOOP("Actions", "Another view of an inline"), kSurveyed,
       add_section<Section::Kind::kInline>},
      {"view.crossline", M::kView, QT_TRANSLATE_NOOP("Actions", "&Crossline"), "Ctrl+2", "crossline",
       QT_TRANSLATE_NOOP("Actions", "Another view of a crossline"), kSurveyed,
       add_section<Section::Kind::kCrossline>},
      {"view.slice", M::kView, QT_TRANSLATE_NOOP("Actions", "&Slice"), "Ctrl+3", "slice",
       QT_TRANSLATE_NOOP("Actions", "Another view of a time or depth slice"), kSurveyed,
       add_section<Section::Kind::kSlice>},
      {"view.line", M::kView, QT_TRANSLATE_NOOP("Actions", "&Line"), "Ctrl+4", "line",
       QT_TRANSLATE_NOOP("Actions",
                         "Another view along a line through two points, at first from corner to corner"),
       kSurveyed, add_section<Section::Kind::kLine>},
      {"view.draw-line", M::kView, QT_TRANSLATE_NOOP("Actions", "Draw line"), "Shift+L", "draw-line",
       QT_TRANSLATE_NOOP("Actions", "Another view along a line whose two ends are clicked on a slice"),
       kSurveyed, draw_line, [](MainWindow& window) { return window.workbench()->line.is_active(); }},
      {"view.line-ends", M::kView, QT_TRANSLATE_NOOP("Actions", "Ends of line…"), "Ctrl+Alt+N", "line-ends",
       QT_TRANSLATE_NOOP("Actions", "The two ends of the active line as inline and crossline numbers"),
       kSurveyed | kLine,
       [](MainWindow& window) {
         open_line_dialog(*window.workbench(), window.views()->active_section(), &window);
       }},
      {"view.scene", M::kView, QT_TRANSLATE_NOOP("Actions", "3&D scene"), "Ctrl+5", "scene",
       QT_TRANSLATE_NOOP("Actions", "Show or close the 3D scene"), kProject,
       [](MainWindow& window) { window.views()->show_scene(!window.views()->has_scene()); },
       [](MainWindow& window) { return window.views() != nullptr && window.views()->has_scene(); }},
      {"view.next", M::kView, QT_TRANSLATE_NOOP("Actions", "&Next line"), "X", "next",
       QT_TRANSLATE_NOOP("Actions", "The active section moves on by the step"), kSurveyed | kSection,
       [](MainWindow& window) { step(window, 1); }, nullptr, true},
      {"view.previous", M::kView, QT_TRANSLATE_NOOP("Actions", "&Previous line"), "Z", "previous",
       QT_TRANSLATE_NOOP("Actions", "The active section moves back by the step"), kSurveyed | kSection,
       [](MainWindow& window) { step(window, -1); }},
      {"view.next-far", M::kView, QT_TRANSLATE_NOOP("Actions", "Ten steps on"), "PgDown", "next-far",
       QT_TRANSLATE_NOOP("Actions", "The active section moves on by ten steps"), kSurveyed | kSection,
       [](MainWindow& window) { step(window, kFarSteps); }},
      {"view.previous-far", M::kView, QT_TRANSLATE_NOOP("Actions", "Ten steps back"), "PgUp", "previous-far",
       QT_TRANSLATE_NOOP("Actions", "The active section moves back by ten steps"), kSurveyed | kSection,
       [](MainWindow& window) { step(window, -kFarSteps); }},
      {"view.frame", M::kView, QT_TRANSLATE_NOOP("Actions", "&Frame selection"), "F", "frame",
       QT_TRANSLATE_NOOP("Actions", "The active view shows what is selected, large"), kView,
       send_key<Qt::Key_F>},
      {"view.fit", M::kView, QT_TRANSLATE_NOOP("Actions", "F&it"), "Home", "fit",
       QT_TRANSLATE_NOOP("Actions", "The active view shows everything"), kView, send_key<Qt::Key_Home>},
  };
}

std::vector<ActionRow> look_actions() {
  using M = Menu;
  return {
      {"view.in-scene", M::kView, QT_TRANSLATE_NOOP("Actions", "Plane in scene"), "Ctrl+Alt+P", "plane",
       QT_TRANSLATE_NOOP("Actions", "The active section is a plane of the scene, too"), kProject | kSection,
       toggle_in_scene, is_in_scene},
      {"view.fade", M::kView, QT_TRANSLATE_NOOP("Actions", "Fade distance…"), "Ctrl+Alt+F", "fade",
       QT_TRANSLATE_NOOP("Actions", "How far beside a section pillars are drawn on it"), kProject,
       set_fade_distance},
      look_row<ViewFactories::From::kOblique>(
          "view.from-oblique", QT_TRANSLATE_NOOP("Actions", "From &above"), "Ctrl+Shift+0",
          QT_TRANSLATE_NOOP("Actions", "The scene slantwise from above"), true),
      look_row<ViewFactories::From::kTop>("view.from-top", QT_TRANSLATE_NOOP("Actions", "From the &top"),
                                          "Ctrl+Shift+1",
                                          QT_TRANSLATE_NOOP("Actions", "The scene from straight above")),
      look_row<ViewFactories::From::kNorth>("view.from-north", QT_TRANSLATE_NOOP("Actions", "From the north"),
                                            "Ctrl+Shift+2",
                                            QT_TRANSLATE_NOOP("Actions", "The scene from the north")),
      look_row<ViewFactories::From::kEast>("view.from-east", QT_TRANSLATE_NOOP("Actions", "From the east"),
                                           "Ctrl+Shift+3",
                                           QT_TRANSLATE_NOOP("Actions", "The scene from the east")),
      look_row<ViewFactories::From::kSouth>("view.from-south", QT_TRANSLATE_NOOP("Actions", "From the south"),
                                            "Ctrl+Shift+4",
                                            QT_TRANSLATE_NOOP("Actions", "The scene from the south")),
      look_row<ViewFactories::From::kWest>("view.from-west", QT_TRANSLATE_NOOP("Actions", "From the west"),
                                           "Ctrl+Shift+5",
                                           QT_TRANSLATE_NOOP("Actions", "The scene from the west")),
      {"view.save", M::kView, QT_TRANSLATE_NOOP("Actions", "Save view…"), "Ctrl+B", "view",
       QT_TRANSLATE_NOOP("Actions", "Keep the camera, and what is shown and how, under a name"),
       kProject | kWriting | kScene, save_view},
      {"view.gain-up", M::kView, QT_TRANSLATE_NOOP("Actions", "More &gain"), "Ctrl++ Ctrl+=", "gain-up",
       QT_TRANSLATE_NOOP("Actions", "Sections show smaller amplitudes stronger"), kProject,
       [](MainWindow& window) { change_gain(window, kGainFactor); }, nullptr, true},
      {"view.gain-down", M::kView, QT_TRANSLATE_NOOP("Actions", "&Less gain"), "Ctrl+-", "gain-down",
       QT_TRANSLATE_NOOP("Actions", "Sections show amplitudes weaker"), kProject,
       [](MainWindow& window) { change_gain(window, 1 / kGainFactor); }},
      {"view.interpolate", M::kView, QT_TRANSLATE_NOOP("Actions", "S&mooth samples"), "I", "interpolate",
       QT_TRANSLATE_NOOP("Actions",
                         "Sections run smoothly from sample to sample instead of showing each as a cell"),
       kProject, toggle_interpolation,
       [](MainWindow& window) { return display(window).samples().interpolate.value_or(false); }},
      {"view.wiggle", M::kView, QT_TRANSLATE_NOOP("Actions", "&Wiggles"), "Shift+W", "wiggle",
       QT_TRANSLATE_NOOP("Actions", "Sections draw traces as curves, too"), kProject, toggle_wiggle,
       [](MainWindow& window) { return display(window).samples().wiggle; }},
      {"view.perspective", M::kView, QT_TRANSLATE_NOOP("Actions", "P&erspective"), "O", "perspective",
       QT_TRANSLATE_NOOP("Actions", "The scene in perspective, or parallel"), kProject,
       [](MainWindow& window) { display(window).set_perspective(!display(window).perspective()); },
       [](MainWindow& window) { return display(window).perspective(); }, true},
      {"view.edges", M::kView, QT_TRANSLATE_NOOP("Actions", "E&dges"), "E", "edges",
       QT_TRANSLATE_NOOP("Actions", "The scene draws the edges of the triangles"), kProject, toggle_edges,
       [](MainWindow& window) { return display(window).faces().edges; }},
      {"view.taller", M::kView, QT_TRANSLATE_NOOP("Actions", "&Taller"), "Ctrl+Up", "taller",
       QT_TRANSLATE_NOOP("Actions", "The scene exaggerates heights more"), kProject,
       [](MainWindow& window) {
         display(window).set_exaggeration(display(window).exaggeration() * kTallerFactor);
       }},
      {"view.lower", M::kView, QT_TRANSLATE_NOOP("Actions", "Lo&wer"), "Ctrl+Down", "lower",
       QT_TRANSLATE_NOOP("Actions", "The scene exaggerates heights less"), kProject,
       [](MainWindow& window) {
         display(window).set_exaggeration(display(window).exaggeration() / kTallerFactor);
       }},
      statistic_row<kVariance>("view.variance", QT_TRANSLATE_NOOP("Actions", "Amplitude &variance"), "V",
                               QT_TRANSLATE_NOOP("Actions", "Colour faces by amplitude variance"), true),
      statistic_row<kContrast>(
          "view.contrast", QT_TRANSLATE_NOOP("Actions", "&Contrast"), "C",
          QT_TRANSLATE_NOOP("Actions", "Colour faces by contrast: how well each sits on the fault")),
      {"view.offset", M::kView, QT_TRANSLATE_NOOP("Actions", "&Offset"), "B", "colours",
       QT_TRANSLATE_NOOP("Actions", "Colour faces by how far the fault seems to be beside them"), kProject,
       [](MainWindow& window) {
         colour_by(window, FaceColours::kStatistic, offsets_are_metric(window) ? kOffset : kOffsetVoxels);
       },
       [](MainWindow& window) {
         return is_coloured_by(window, kOffset) || is_coloured_by(window, kOffsetVoxels);
       }},
      statistic_row<kMean>("view.mean", QT_TRANSLATE_NOOP("Actions", "&Mean"), "N",
                           QT_TRANSLATE_NOOP("Actions", "Colour faces by mean amplitude")),
      statistic_row<kDip>("view.dip", QT_TRANSLATE_NOOP("Actions", "D&ip"), "D",
                          QT_TRANSLATE_NOOP("Actions", "Colour faces by dip")),
      statistic_row<kAzimuth>("view.azimuth", QT_TRANSLATE_NOOP("Actions", "&Azimuth"), "A",
                              QT_TRANSLATE_NOOP("Actions", "Colour faces by dip azimuth")),
      {"view.voxels", M::kView, QT_TRANSLATE_NOOP("Actions", "Vo&xel values"), "Shift+V", "voxels",
       QT_TRANSLATE_NOOP("Actions", "Colour faces by the samples that they cut"), kProject,
       [](MainWindow& window) { colour_by(window, FaceColours::kVoxels); },
       [](MainWindow& window) { return display(window).faces().colours == FaceColours::kVoxels; }},
      {"view.plain", M::kView, QT_TRANSLATE_NOOP("Actions", "P&lain"), "Shift+P", "plain",
       QT_TRANSLATE_NOOP("Actions", "Faces in the colour of their fault"), kProject,
       [](MainWindow& window) { colour_by(window, FaceColours::kPlain); },
       [](MainWindow& window) { return display(window).faces().colours == FaceColours::kPlain; }},
      {"view.run", M::kView, QT_TRANSLATE_NOOP("Actions", "Show &run"), "Shift+R", "run",
       QT_TRANSLATE_NOOP("Actions", "Faces show the numbers of the selected run, or those known now again"),
       kProject | kRun, toggle_run, is_run_shown},
  };
}

}  // namespace

std::vector<ActionRow> view_actions() {
  std::vector<ActionRow> all = place_actions();
  for (const ActionRow& row : look_actions()) all.push_back(row);
  return all;
}

}  // namespace footwall::ui
