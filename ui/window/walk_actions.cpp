// Pillars and nodes selected by keys: along the fault with Alt and the arrows to the sides, along the pillar
// with those up and down.
#include <QCoreApplication>

#include "ui/model/walk.h"
#include "ui/window/action_groups.h"
#include "ui/window/main_window.h"

namespace footwall::ui {
namespace {

using Next = Item (*)(const Document& document, const Selection& selection, int by);

// Selects what comes next, or adds it, and brings the sections there.
template <Next kNext, int kBy, bool kAdds>
void walk(MainWindow& window) {
  Workbench& bench = *window.workbench();
  const Item item = kNext(bench.document, bench.selection, kBy);
  if (!item) {
    return window.tell_failure(QCoreApplication::translate("Actions", "this fault has no pillars yet"),
                               QCoreApplication::translate("Actions", "the Pick tool (P) makes them"));
  }
  if (kAdds) {
    bench.selection.add(item);
  } else {
    bench.selection.select(item);
  }
  if (const auto place = place_of(bench.document, item))
    bring_sections_to(bench.display, *bench.document.survey(), *place);
}

template <Next kNext, int kBy, bool kAdds = false>
ActionRow row(const char* id, const char* name, const char* keys, const char* icon, const char* tip,
              bool starts_group = false) {
  constexpr unsigned kWalk = kProject | kSurvey | kFault;
  return {id,
          Menu::kEdit,
          name,
          keys,
          icon,
          tip,
          kWalk,
          walk<kNext, kBy, kAdds>,
          nullptr,
          starts_group,
          QT_TRANSLATE_NOOP("Actions", "Pillars and nodes by keys")};
}

}  // namespace

std::vector<ActionRow> walk_actions() {
  return {
      row<next_pillar, 1>(
          "walk.next-pillar", QT_TRANSLATE_NOOP("Actions", "Next pillar"), "Alt+Right", "pillar-next",
          QT_TRANSLATE_NOOP("Actions", "Select the next pillar along the fault, and go there")),
      row<next_pillar, -1>(
          "walk.previous-pillar", QT_TRANSLATE_NOOP("Actions", "Previous pillar"), "Alt+Left",
          "pillar-previous",
          QT_TRANSLATE_NOOP("Actions", "Select the pillar before along the fault, and go there")),
      row<next_node, 1>("walk.next-node", QT_TRANSLATE_NOOP("Actions", "Next node"), "Alt+Down", "node-next",
                        QT_TRANSLATE_NOOP("Actions", "Select the next node of the pillar, and go there")),
      row<next_node, -1>("walk.previous-node", QT_TRANSLATE_NOOP("Actions", "Previous node"), "Alt+Up",
                         "node-previous",
                         QT_TRANSLATE_NOOP("Actions", "Select the node before on the pillar, and go there")),
      row<next_pillar, 1, true>(
          "walk.add-next-pillar", QT_TRANSLATE_NOOP("Actions", "Next pillar, too"), "Alt+Shift+Right",
          "pillar-next-add",
          QT_TRANSLATE_NOOP("Actions", "Add the next pillar along the fault to what is selected")),
      row<next_pillar, -1, true>(
          "walk.add-previous-pillar", QT_TRANSLATE_NOOP("Actions", "Previous pillar, too"), "Alt+Shift+Left",
          "pillar-previous-add",
          QT_TRANSLATE_NOOP("Actions", "Add the pillar before along the fault to what is selected")),
      row<next_node, 1, true>(
          "walk.add-next-node", QT_TRANSLATE_NOOP("Actions", "Next node, too"), "Alt+Shift+Down",
          "node-next-add",
          QT_TRANSLATE_NOOP("Actions", "Add the next node of the pillar to what is selected")),
      row<next_node, -1, true>(
          "walk.add-previous-node", QT_TRANSLATE_NOOP("Actions", "Previous node, too"), "Alt+Shift+Up",
          "node-previous-add",
          QT_TRANSLATE_NOOP("Actions", "Add the node before on the pillar to what is selected")),
  };
}

}  // namespace footwall::ui
