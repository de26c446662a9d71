#include "ui/model/mouse_bindings.h"

#include <QSettings>
#include <QTest>
#include <set>

#include "ui/test_class.h"

namespace footwall::ui {

class MouseBindingsTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void no_preset_takes_the_hand_from_the_left_button();
  void every_preset_pans_turns_and_zooms();
  void modifiers_choose_and_others_are_ignored();
  void the_choice_is_remembered();
};

void MouseBindingsTest::no_preset_takes_the_hand_from_the_left_button() {
  for (const MousePreset& preset : mouse_presets()) {
    for (const auto* bindings : {&preset.section, &preset.scene}) {
      QCOMPARE(action_of(*bindings, Qt::LeftButton, {}), MouseAction::kNone);
      QCOMPARE(action_of(*bindings, Qt::LeftButton, Qt::ShiftModifier), MouseAction::kNone);
      QCOMPARE(action_of(*bindings, Qt::LeftButton, Qt::ControlModifier), MouseAction::kNone);
    }
  }
}

void MouseBindingsTest::every_preset_pans_turns_and_zooms() {
  std::set<std::string> names;
  for (const MousePreset& preset : mouse_presets()) {
    QVERIFY2(names.insert(preset.name).second, preset.name);
    std::set<MouseAction> section, scene;
    std::set<std::pair<int, int>> taken;
    for (const DragBinding& one : preset.section) section.insert(one.action);
    for (const DragBinding& one : preset.scene) {
      scene.insert(one.action);
      QVERIFY2(taken.insert({one.button, one.modifiers.toInt()}).second, preset.name);
    }
    QVERIFY2(section.contains(MouseAction::kPan) && !section.contains(MouseAction::kOrbit), preset.name);
    QVERIFY2(scene.contains(MouseAction::kPan) && scene.contains(MouseAction::kOrbit), preset.name);
    QVERIFY2(scene.contains(MouseAction::kZoom), preset.name);
  }
  QCOMPARE(names.size(), std::size_t{4});
}

void MouseBindingsTest::modifiers_choose_and_others_are_ignored() {
  const auto& scene = mouse_presets()[0].scene;
  QCOMPARE(action_of(scene, Qt::MiddleButton, {}), MouseAction::kOrbit);
  QCOMPARE(action_of(scene, Qt::MiddleButton, Qt::ShiftModifier), MouseAction::kPan);
  QCOMPARE(action_of(scene, Qt::MiddleButton, Qt::AltModifier), MouseAction::kOrbit);
  QCOMPARE(action_of(scene, Qt::RightButton, {}), MouseAction::kNone);
}

void MouseBindingsTest::the_choice_is_remembered() {
  QSettings().remove(QStringLiteral("mouse"));
  {
    MouseChoice mouse;
    QCOMPARE(QString::fromLatin1(mouse.preset().name), QStringLiteral("Footwall"));
    mouse.choose(QStringLiteral("Landmark"));
    mouse.choose(QStringLiteral("none such"));
    QVERIFY(mouse.preset().wheel_steps);
  }
  QCOMPARE(QString::fromLatin1(MouseChoice().preset().name), QStringLiteral("Landmark"));
  QSettings().remove(QStringLiteral("mouse"));
}

static const RegisterTest<MouseBindingsTest> kRegistered;

}  // namespace footwall::ui

#include "mouse_bindings_test.moc"
