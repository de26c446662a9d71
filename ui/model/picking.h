// Gestures: what a press, drag or key over a view does to pillars. One state machine for sections and scene;
// views say where the mouse is in the survey and what lies under it, and show hint(), cursor() and the
// provisional pillars.
//
// The set is OpendTect's without its conflicts: click adds a node, double-click or Enter ends the pillar,
// Shift+click starts a new one, Ctrl+click deletes a node, a drag moves a node, a drag on empty ground (more
// than 5 px, longer than 200 ms) draws a pillar free-hand, ` + drag makes a copy, Esc leaves with nothing
// changed, Space held navigates.
#pragma once
#include <QObject>
#include <QString>
#include <chrono>
#include <memory>
#include <optional>
#include <vector>

#include "ui/model/display.h"
#include "ui/model/document.h"
#include "ui/model/section.h"
#include "ui/model/selection.h"

namespace footwall::ui {

enum class Tool { kSelect, kPick, kMove };
enum class PointerShape { kArrow, kCross, kMoveNode, kAddNode, kDeleteNode, kPen, kHand };

// Where a view's mouse is.
struct Pointer {
  double x = 0, y = 0;       // pixels of the view
  survey::IndexPoint place;  // on the section, or the plane of the scene under the mouse; index space
  Section section;           // that plane
  bool on_section = false;   // false: over nothing that can be picked on
  bool on_frame = false;     // of a plane of the scene, by which a drag moves it
  Item under;                // node, pillar, face, isosurface or nothing, within the view's catch radius
  int segment = -1;          // of a pillar under the mouse: the segment (its first node's number)
  Qt::KeyboardModifiers modifiers;
  Qt::MouseButton button = Qt::NoButton;  // of a press or release
  std::chrono::milliseconds time{0};      // of the event
};

class Picking final : public QObject {
  Q_OBJECT

 public:
  Picking(Document& document, Selection& selection, Display& display, QObject* parent = nullptr);
  ~Picking() override;

  Tool tool() const;
  void set_tool(Tool tool);
  // The pillar that clicks add to; 0: the next click starts one.
  Id active_pillar() const;
  // Lines that X and Z move by: as the user set it, else 10 while picking and 1 otherwise.
  int step_lines() const;

  // Each returns whether it took the event; a view pans, orbits or selects with those it did not take.
  bool move(const Pointer& pointer);
  bool press(const Pointer& pointer);
  bool release(const Pointer& pointer);
  bool double_click(const Pointer& pointer);
  bool key_press(int key, Qt::KeyboardModifiers modifiers);
  bool key_release(int key);
  void leave();
  // The view lost the keyboard and hears no more of keys that are held.
  void let_keys_go();

  // What the next click would do, in a line.
  QString hint() const;
  PointerShape shape() const;
  bool is_dragging() const;
  // Index space: the free-hand stroke under way, for the view it began in.
  const std::vector<survey::IndexPoint>& stroke() const;

 Q_SIGNALS:
  void hint_changed();
  void tool_changed();
  void active_pillar_changed();
  void stroke_changed();
  // A pillar was ended; where the display says so, the section that it was picked on has moved on by
  // step_lines().
  void pillar_ended(footwall::ui::Id pillar);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace footwall::ui
