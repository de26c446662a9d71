// The one way in which an interpretation changes, and the way back.
#include <fmt/format.h>

#include "storage/base/error.h"
#include "storage/base/log.h"
#include "storage/project/detail/edit_state.h"
#include "storage/project/detail/names.h"
#include "storage/project/detail/project_state.h"
#include "storage/project/detail/undo_log.h"

namespace footwall::project {
namespace {

// Set while the caller's function runs, also when it leaves by an exception.
class Flag {
 public:
  explicit Flag(bool& flag) : flag_(flag) { flag_ = true; }
  ~Flag() { flag_ = false; }
  Flag(const Flag&) = delete;
  Flag& operator=(const Flag&) = delete;

 private:
  bool& flag_;
};

}  // namespace

EditResult Project::edit(const std::string& name, const std::function<void(Interpretation&)>& change) {
  detail::check_name("step", name);
  return state_->write([&] {
    const Flag editing(state_->editing);
    detail::Database& database = *state_->database;
    const detail::ChangeRecorder recorder(database);
    detail::EditState edit(database);
    EditResult result;

    // 1. What the caller wants, and what follows from it.
    Interpretation interpretation(edit);
    change(interpretation);
    edit.require_open();
    edit.regenerate(state_->regenerator);
    edit.close();

    // 2. Date and revisions, only where something differs: they alone would make a step of nothing.
    if (!recorder.changeset().empty()) {
      edit.stamp(result);
      result.changed = true;
      result.step = detail::UndoLog(database).add(name, recorder.changeset());
    }

    // 3. Ids that were handed out stay used, whatever became of them.
    edit.ids.flush();
    return result;
  });
}

void Project::set_regenerator(Regenerator regenerator) {
  state_->regenerator = std::move(regenerator);
}

std::optional<std::string> Project::undo() {
  return state_->write([&] { return detail::UndoLog(*state_->database).undo(); });
}

std::optional<std::string> Project::redo() {
  return state_->write([&] { return detail::UndoLog(*state_->database).redo(); });
}

std::int64_t Project::go_to_step(std::int64_t step, const JobContext& job) {
  return state_->write([&] {
    detail::UndoLog log(*state_->database);
    std::int64_t undos = 0, redos = 0;
    for (const HistoryStep& one : log.steps(0)) {
      if (one.id > step && !one.undone) ++undos;
      if (one.id <= step && one.undone) ++redos;
    }
    const std::int64_t all = undos + redos;
    std::int64_t taken = 0;
    const auto tell = [&] {
      job.report(static_cast<double>(taken) / static_cast<double>(all), "history",
                 fmt::format("{} of {} steps", taken, all));
    };
    for (; undos > 0 && log.undo(); --undos) ++taken, tell();
    for (; redos > 0 && log.redo(); --redos) ++taken, tell();
    return taken;
  });
}

HistorySize Project::history_size(const std::optional<std::string>& before) const {
  return detail::UndoLog(*state_->database).size(before);
}

HistorySize Project::trim_history(const std::string& before) {
  const HistorySize dropped = state_->write([&] { return detail::UndoLog(*state_->database).trim(before); });
  if (dropped.steps == 0) return dropped;
  try {
    state_->database->vacuum();
  } catch (const Error& error) {
    log::warn(std::string("the room of the dropped steps is kept for later edits: ") + error.what());
  }
  return dropped;
}

std::vector<HistoryStep> Project::history(std::int64_t first) const {
  return detail::UndoLog(*state_->database).steps(first);
}

}  // namespace footwall::project
