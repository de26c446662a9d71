#include "engine/session/launch.h"
#include "engine/session/launcher.h"
#include "storage/base/cores.h"

namespace footwall::session {

int usable_cores() {
  return footwall::usable_cores();
}

int default_ranks() {
  return current_allocation().tasks.value_or(std::min(4, usable_cores()));
}

int default_threads() {
  return current_allocation().cpus_per_task.value_or(1);
}

}  // namespace footwall::session
