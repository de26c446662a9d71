#include <QFileDialog>
#include <QInputDialog>
#include <algorithm>

#include "ui/window/action_groups.h"
#include "ui/window/docks.h"
#include "ui/window/main_window.h"

namespace footwall::ui {
namespace {

constexpr double kUsualVelocity = 2400;

QString translated(const char* text) {
  return QCoreApplication::translate("Actions", text);
}

void show_survey(MainWindow& window) {
  window.docks().open(Panel::kInspector, true);
  window.workbench()->selection.select({.kind = Item::Kind::kSurvey});
}

void set_velocity(MainWindow& window) {
  Document& document = window.workbench()->document;
  bool ok = false;
  const double metres =
      QInputDialog::getDouble(&window, translated("Velocity"),
                              translated("Velocity of the survey in m/s, for areas and dips in metres:"),
                              document.velocity().value_or(kUsualVelocity), 100, 10000, 0, &ok);
  if (ok) document.set_velocity(metres);
}

void relink(MainWindow& window) {
  const QString file = QFileDialog::getOpenFileName(&window, translated("Where is the volume now?"), {},
                                                    translated("Volumes (*.h5);;All files (*)"));
  if (!file.isEmpty()) window.relink(QString(), file);
}

void next_volume(MainWindow& window) {
  const auto& volumes = window.workbench()->document.volumes();
  Display& display = window.workbench()->display;
  const auto here = std::ranges::find(volumes, display.volume(), &project::VolumeRecord::id);
  const bool last = here == volumes.end() || here + 1 == volumes.end();
  display.set_volume(last ? volumes.front().id : (here + 1)->id);
}

}  // namespace

std::vector<ActionRow> survey_actions() {
  using M = Menu;
  return {
      {"survey.properties", M::kSurvey, QT_TRANSLATE_NOOP("Actions", "&Properties"), "Ctrl+Alt+S", "survey",
       QT_TRANSLATE_NOOP("Actions", "The inspector shows the survey: lines, samples, units, coordinates"),
       kProject | kSurvey, show_survey},
      {"survey.velocity", M::kSurvey, QT_TRANSLATE_NOOP("Actions", "&Velocity…"), "Ctrl+Alt+V", "velocity",
       QT_TRANSLATE_NOOP("Actions", "Velocity of a time survey, which areas and dips in metres need"),
       kProject | kWriting | kSurvey, set_velocity},
      {"survey.next-volume", M::kSurvey, QT_TRANSLATE_NOOP("Actions", "&Next volume"), "Ctrl+]", "volume",
       QT_TRANSLATE_NOOP("Actions", "Sections show the next volume of the project"), kProject | kVolume,
       next_volume},
      {"survey.relink", M::kSurvey, QT_TRANSLATE_NOOP("Actions", "&Relink volume…"), "Ctrl+Alt+R", "relink",
       QT_TRANSLATE_NOOP("Actions", "Tell the project where the file of a volume went"),
       kProject | kWriting | kVolume, relink},
  };
}

}  // namespace footwall::ui
