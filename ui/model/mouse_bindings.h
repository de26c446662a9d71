// Which button and wheel move the view, as one of a few named sets. The left button without a modifier is in
// none of them: it picks, moves and selects, whatever else is chosen. Alt or Space held with it navigates in
// all.
#pragma once
#include <QString>
#include <Qt>
#include <span>
#include <vector>

namespace footwall::ui {

enum class MouseAction { kNone, kPan, kOrbit, kZoom };

struct DragBinding {
  Qt::MouseButton button = Qt::NoButton;
  Qt::KeyboardModifiers modifiers{};
  MouseAction action = MouseAction::kNone;
};

struct MousePreset {
  const char* name;  // "OpendTect"; as the menu and the settings have it
  std::vector<DragBinding> section, scene;
  bool wheel_steps = false;  // over a section: from line to line; else it zooms. With Ctrl the other.
};

std::span<const MousePreset> mouse_presets();  // the first is the default

// The one with these modifiers, else the button's without any.
MouseAction action_of(std::span<const DragBinding> bindings, Qt::MouseButton button,
                      Qt::KeyboardModifiers modifiers);

// The set in use: the user's, for all projects (QSettings "mouse").
class MouseChoice {
 public:
  MouseChoice();
  const MousePreset& preset() const { return *preset_; }
  // Remembers it. Names that there are not change nothing.
  void choose(const QString& name);

 private:
  const MousePreset* preset_;
};

}  // namespace footwall::ui
