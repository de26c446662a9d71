#include "storage/project/detail/view_table.h"

#include <cmath>

#include "storage/project/detail/clock.h"
#include "storage/project/detail/names.h"

namespace footwall::project::detail {

std::vector<ViewRecord> ViewTable::all() const {
  std::vector<ViewRecord> views;
  Query row(database_, "SELECT name, camera, exaggeration, made FROM view ORDER BY name");
  while (row.next()) views.push_back({row.text(0), row.text(1), row.real(2), row.text(3)});
  return views;
}

void ViewTable::put(const ViewRecord& view) {
  check_name("view", view.name);
  check_text("a camera", view.camera);
  if (!std::isfinite(view.exaggeration) || view.exaggeration < 0) {
    throw Error(ErrorCode::kInvalid, "the exaggeration of a view is not a number from 0 on");
  }
  Query(database_,
        "INSERT INTO view(name, camera, exaggeration, made) VALUES(?1, ?2, ?3, ?4)"
        " ON CONFLICT(name) DO UPDATE SET camera = ?2, exaggeration = ?3, made = ?4",
        view.name, view.camera, view.exaggeration, now_text())
      .run();
}

void ViewTable::remove(const std::string& name) {
  Query(database_, "DELETE FROM view WHERE name = ?", name).run();
}

}  // namespace footwall::project::detail
