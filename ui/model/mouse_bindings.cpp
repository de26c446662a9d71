#include "ui/model/mouse_bindings.h"

#include <QSettings>
#include <algorithm>

namespace footwall::ui {
namespace {

constexpr const char* kSetting = "mouse";

const MousePreset* preset_named(const QString& name) {
  const auto all = mouse_presets();
  const auto found =
      std::ranges::find_if(all, [&](const MousePreset& one) { return name == QLatin1String(one.name); });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace

std::span<const MousePreset> mouse_presets() {
  using A = MouseAction;
  constexpr auto kMiddle = Qt::MiddleButton;
  constexpr auto kRight = Qt::RightButton;
  static const std::vector<MousePreset> all{
      {"Footwall",
       {{kMiddle, {}, A::kPan}, {kMiddle, Qt::ControlModifier, A::kZoom}},
       {{kMiddle, {}, A::kOrbit},
        {kMiddle, Qt::ShiftModifier, A::kPan},
        {kMiddle, Qt::ControlModifier, A::kZoom}}},
      {"OpendTect",
       {{kMiddle, {}, A::kPan}, {kMiddle, Qt::ControlModifier, A::kZoom}},
       {{kMiddle, {}, A::kPan}, {kMiddle, Qt::ControlModifier, A::kZoom}, {kRight, {}, A::kOrbit}}},
      {"Petrel-like",
       {{kMiddle, {}, A::kPan}, {kRight, {}, A::kPan}, {kRight, Qt::ControlModifier, A::kZoom}},
       {{kMiddle, {}, A::kPan}, {kRight, {}, A::kOrbit}, {kRight, Qt::ControlModifier, A::kZoom}}},
      {"Landmark",
       {{kMiddle, {}, A::kPan}, {kRight, {}, A::kZoom}},
       {{kMiddle, {}, A::kOrbit}, {kMiddle, Qt::ShiftModifier, A::kPan}, {kRight, {}, A::kZoom}},
       true}};
  return all;
}

MouseAction action_of(std::span<const DragBinding> bindings, Qt::MouseButton button,
                      Qt::KeyboardModifiers modifiers) {
  const Qt::KeyboardModifiers held = modifiers & (Qt::ShiftModifier | Qt::ControlModifier | Qt::AltModifier);
  const auto with = [&](Qt::KeyboardModifiers wanted) {
    return std::ranges::find_if(
        bindings, [&](const DragBinding& one) { return one.button == button && one.modifiers == wanted; });
  };
  auto found = with(held);
  if (found == bindings.end()) found = with({});
  return found == bindings.end() ? MouseAction::kNone : found->action;
}

MouseChoice::MouseChoice() : preset_(preset_named(QSettings().value(QLatin1String(kSetting)).toString())) {
  if (preset_ == nullptr) preset_ = &mouse_presets().front();
}

void MouseChoice::choose(const QString& name) {
  const MousePreset* wanted = preset_named(name);
  if (wanted == nullptr) return;
  preset_ = wanted;
  QSettings().setValue(QLatin1String(kSetting), name);
}

}  // namespace footwall::ui
