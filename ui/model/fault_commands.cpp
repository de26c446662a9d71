#include "ui/model/fault_commands.h"

namespace footwall::ui {
bool is_unassigned(const Fault& fault) { return fault.record.name == kUnassigned; }
}  // namespace footwall::ui
