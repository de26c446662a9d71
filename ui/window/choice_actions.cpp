// What the tool bar lets choose, for the keyboard: each opens the choice's menu there.
#include "ui/window/action_groups.h"
#include "ui/window/main_window.h"
#include "ui/window/tool_bar.h"

namespace footwall::ui {
namespace {

template <ToolBar::Choice kChoice>
void choose(MainWindow& window) {
  window.tool_bar()->open(kChoice);
}

}  // namespace

std::vector<ActionRow> choice_actions() {
  using M = Menu;
  using C = ToolBar::Choice;
  return {
      {"choose.colours", M::kView, QT_TRANSLATE_NOOP("Actions", "Colours of sections…"), "Ctrl+Alt+M",
       "palette", QT_TRANSLATE_NOOP("Actions", "Choose the colour map of the sections' samples"), kProject,
       choose<C::kColours>, nullptr, true},
      {"choose.clip", M::kView, QT_TRANSLATE_NOOP("Actions", "Clip of sections…"), "Ctrl+Alt+K", "gain-up",
       QT_TRANSLATE_NOOP("Actions", "Choose the percentile beyond which samples get the last colour"),
       kProject, choose<C::kClip>},
      {"choose.statistic", M::kView, QT_TRANSLATE_NOOP("Actions", "Colours of faces…"), "Ctrl+Alt+A",
       "colours",
       QT_TRANSLATE_NOOP("Actions", "Choose the statistic, the voxel values or the plain colour for faces"),
       kProject, choose<C::kStatistic>},
  };
}

}  // namespace footwall::ui
