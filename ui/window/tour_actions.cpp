// From face to face in the order of how badly each sits on the fault, and Enter to mend it.
#include <QCoreApplication>
#include <algorithm>
#include <cmath>

#include "ui/model/accept_shift.h"
#include "ui/model/tour.h"
#include "ui/model/walk.h"
#include "ui/window/action_groups.h"
#include "ui/window/main_window.h"
#include "ui/window/view_area.h"
#include "ui/window/view_tile.h"

namespace footwall::ui {
namespace {

enum class Tour { kContrast, kOffset };

// What a view shows around a face, in every direction: voxels at least, and the face's size so often.
constexpr double kAround = 24;
constexpr double kFacesAround = 4;

QString translated(const char* text) {
  return QCoreApplication::translate("Actions", text);
}

Id fault_of_tour(const Selection& selection) {
  if (selection.current().kind == Item::Kind::kFace) return selection.current().id;
  if (selection.active_fault() != 0) return selection.active_fault();
  return selection.faults().empty() ? 0 : *selection.faults().begin();
}

std::vector<TourStop> stops_of(const Workbench& bench, Id fault, Tour tour) {
  const auto surface = bench.surfaces.surface(fault);
  // What is known now, also while the views show a run: the way leads to faces as they are. In voxels, which
  // are known in a time survey without a velocity, too.
  const auto numbers = bench.surfaces.numbers(
      fault, tour == Tour::kContrast ? QStringLiteral("contrast") : QStringLiteral("offset_voxels"));
  if (!surface || !numbers) return {};
  return tour == Tour::kContrast ? worst_faces(*surface, *numbers) : farthest_faces(*surface, *numbers);
}

// The face, in the middle of every view.
void show_stop(MainWindow& window, const TourStop& stop) {
  Workbench& bench = *window.workbench();
  bench.selection.select(stop.face);
  bring_sections_to(bench.display, *bench.document.survey(), stop.place);
  bench.display.show_place(stop.place, std::max(kAround, kFacesAround * stop.reach));
  // Where Enter accepts what the status line says.
  if (ViewTile* tile = window.views()->active()) tile->view()->setFocus(Qt::ShortcutFocusReason);
}

template <Tour kTour, int kBy>
void go_on(MainWindow& window) {
  Workbench& bench = *window.workbench();
  const std::vector<TourStop> stops = stops_of(bench, fault_of_tour(bench.selection), kTour);
  if (const TourStop* stop = next_stop(stops, bench.selection.current(), kBy))
    return show_stop(window, *stop);
  if (kTour == Tour::kContrast) {
    window.tell_failure(translated("the contrast of no face of this fault is known"),
                        translated("Compute > Update all computes them"));
  } else {
    window.tell_failure(translated("no face of this fault is known to lie beside it"),
                        translated("offsets come from the engine while nothing else is to be done"));
  }
}

}  // namespace

std::vector<ActionRow> tour_actions() {
  using M = Menu;
  constexpr unsigned kTour = kProject | kSurvey | kFault;
  return {
      {"fault.worst", M::kFault, QT_TRANSLATE_NOOP("Actions", "&Worst next"), "W", "worst",
       QT_TRANSLATE_NOOP(
           "Actions", "Go to the face that sits worst on the fault, then to the next: lowest contrast first"),
       kTour, go_on<Tour::kContrast, 1>, nullptr, true},
      {"fault.worst-previous", M::kFault, QT_TRANSLATE_NOOP("Actions", "Worst previous"), "Q",
       "worst-previous", QT_TRANSLATE_NOOP("Actions", "Back to the face before, of lower contrast"), kTour,
       go_on<Tour::kContrast, -1>},
      {"fault.farthest", M::kFault, QT_TRANSLATE_NOOP("Actions", "Largest offset ne&xt"), "Shift+B",
       "farthest",
       QT_TRANSLATE_NOOP("Actions",
                         "Go to the face that the fault seems to lie farthest beside, then to the next"),
       kTour, go_on<Tour::kOffset, 1>},
      {"fault.farthest-previous", M::kFault, QT_TRANSLATE_NOOP("Actions", "Largest offset previous"),
       "Shift+Q", "farthest-previous",
       QT_TRANSLATE_NOOP("Actions", "Back to the face before, of larger offset"), kTour,
       go_on<Tour::kOffset, -1>},
      {"fault.accept-shift", M::kFault, QT_TRANSLATE_NOOP("Actions", "Accept sh&ift"), "Return Enter",
       "accept-shift",
       QT_TRANSLATE_NOOP("Actions",
                         "The selected face or pillars move along the normal to where the offset says"),
       kProject | kSurvey | kShiftable,
       [](MainWindow& window) {
         Workbench& bench = *window.workbench();
         accept_shift(bench.document, bench.surfaces, bench.selection);
       }},
  };
}

}  // namespace footwall::ui
