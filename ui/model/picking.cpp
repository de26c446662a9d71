#include "ui/model/picking.h"

namespace footwall::ui {
struct Picking::State { Tool tool = Tool::kSelect; std::vector<survey::IndexPoint> stroke; };
Picking::Picking(Document&, Selection&, Display&, QObject* parent) : QObject(parent), state_(std::make_unique<State>()) {}
Picking::~Picking() = default;
Tool Picking::tool() const { return state_->tool; }
void Picking::set_tool(Tool tool) { state_->tool = tool; Q_EMIT tool_changed(); }
Id Picking::active_pillar() const { return 0; }
bool Picking::snaps_to_section() const { return true; }
bool Picking::snaps_to_lattice() const { return false; }
void Picking::set_snapping(bool, bool) {}
bool Picking::move(const Pointer&) { return false; }
bool Picking::press(const Pointer&) { return false; }
bool Picking::release(const Pointer&) { return false; }
bool Picking::double_click(const Pointer&) { return false; }
bool Picking::key_press(int, Qt::KeyboardModifiers) { return false; }
bool Picking::key_release(int) { return false; }
void Picking::leave() {}
QString Picking::hint() const { return {}; }
PointerShape Picking::shape() const { return PointerShape::kArrow; }
bool Picking::is_dragging() const { return false; }
const std::vector<survey::IndexPoint>& Picking::stroke() const { return state_->stroke; }
}  // namespace footwall::ui
