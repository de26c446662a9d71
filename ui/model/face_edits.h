// What an engine has to be told so that its faces of a fault become those of a newer surface.
#pragma once
#include "engine/service/engine.pb.h"
#include "ui/model/surfaces.h"

namespace footwall::ui {

// before: what it was told last; null: nothing yet, or it may hold anything. after: null: the fault is gone.
// Appends no edit where nothing differs. Returns how many faces the edits name.
std::size_t append_edits(Id fault, const FaultSurface* before, const FaultSurface* after,
                         v1::EditBatch& batch);

}  // namespace footwall::ui
