#include "ui/model/document.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "engine/tasks/triangulate.h"

namespace footwall::ui {
namespace {

constexpr const char* kVelocitySetting = "velocity";

std::optional<double> stored_velocity(const project::Project& project) {
  const auto text = project.setting(kVelocitySetting);
  if (!text) return std::nullopt;
  const double velocity = QString::fromStdString(*text).toDouble();
  return velocity > 0 && std::isfinite(velocity) ? std::optional(velocity) : std::nullopt;
}

// One text a run or view, which differs where it does.
std::vector<std::string> marks_of(const std::vector<project::RunRecord>& runs) {
  std::vector<std::string> marks;
  for (const project::RunRecord& run : runs) marks.push_back(std::to_string(run.id) + " " + run.name);
  return marks;
}

std::vector<std::string> marks_of(const std::vector<project::ViewRecord>& views) {
  std::vector<std::string> marks;
  for (const project::ViewRecord& view : views) marks.push_back(view.when + " " + view.name);
  return marks;
}

}  // namespace

Document::Document(project::Project project, QObject* parent)
    : QObject(parent), project_(std::move(project)) {
  if (!project_.read_only()) tasks::follow_parents(project_);
  survey_ = project_.survey();
  velocity_ = stored_velocity(project_);
  volumes_ = project_.volumes();
  history_ = project_.history();
  was_read_only_ = project_.read_only();
  runs_ = marks_of(project_.runs());
  views_ = marks_of(project_.views());
  reload_interpretation();
}

Document::~Document() = default;

const Fault* Document::fault(Id fault) const {
  const auto found = place_of_fault_.find(fault);
  return found == place_of_fault_.end() ? nullptr : &faults_[found->second];
}

const Fault* Document::fault_of_pillar(Id pillar) const {
  const auto found = fault_of_pillar_.find(pillar);
  return found == fault_of_pillar_.end() ? nullptr : fault(found->second);
}

const survey::Pillar* Document::pillar(Id pillar) const {
  const Fault* owner = fault_of_pillar(pillar);
  if (owner == nullptr) return nullptr;
  const auto found = std::ranges::find(owner->pillars, pillar, &survey::Pillar::id);
  return found == owner->pillars.end() ? nullptr : &*found;
}

const Fault* Document::fault_of_node(Id node) const {
  const auto found = fault_of_node_.find(node);
  return found == fault_of_node_.end() ? nullptr : fault(found->second);
}

bool Document::can_undo() const {
  const auto last =
      std::find_if(history_.rbegin(), history_.rend(), [](const auto& step) { return !step.undone; });
  return !read_only() && last != history_.rend() && !last->barrier;
}

bool Document::can_redo() const {
  return !read_only() && !history_.empty() && history_.back().undone;
}

const std::vector<survey::Pillar>& Document::shown_pillars(Id id) const {
  static const std::vector<survey::Pillar> kNone;
  const auto found = provisional_.find(id);
  if (found != provisional_.end()) return found->second;
  const Fault* stored = fault(id);
  return stored == nullptr ? kNone : stored->pillars;
}

void Document::show_provisionally(Id fault, std::vector<survey::Pillar> pillars) {
  provisional_[fault] = std::move(pillars);
  Q_EMIT shapes_changed({fault});
}

void Document::end_provisional() {
  std::set<Id> faults;
  for (const auto& [fault, pillars] : std::exchange(provisional_, {})) faults.insert(fault);
  if (!faults.empty()) Q_EMIT shapes_changed(faults);
}

bool Document::edit(const QString& name, const std::function<void(project::Interpretation&)>& change) {
  bool changed = false;
  try {
    const project::EditResult result = project_.edit(name.toStdString(), change);
    changed = result.changed;
    if (changed) {
      while (!history_.empty() && history_.back().undone) history_.pop_back();
      std::ranges::move(project_.history(result.step), std::back_inserter(history_));
    }
  } catch (const Error& error) {
    report(error);
  }
  if (changed) {
    follow_change();
  } else {
    end_provisional();
  }
  return changed;
}

bool Document::step(bool (Document::*one)()) {
  bool stepped = false;
  try {
    stepped = (this->*one)();
  } catch (const Error& error) {
    report(error);
  }
  if (stepped) follow_change();
  return stepped;
}

// The list kept here follows; it is read anew where it was not the one that the project has.
bool Document::take_back() {
  const std::optional<std::string> name = project_.undo();
  if (!name) return false;
  const auto last =
      std::find_if(history_.rbegin(), history_.rend(), [](const auto& step) { return !step.undone; });
  if (last != history_.rend() && last->name == *name) {
    last->undone = true;
  } else {
    history_ = project_.history();
  }
  return true;
}

bool Document::bring_back() {
  const std::optional<std::string> name = project_.redo();
  if (!name) return false;
  const auto done =
      std::find_if(history_.rbegin(), history_.rend(), [](const auto& step) { return !step.undone; });
  const auto first = done.base();  // the step after it
  if (first != history_.end() && first->name == *name) {
    first->undone = false;
  } else {
    history_ = project_.history();
  }
  return true;
}

bool Document::undo() {
  return step(&Document::take_back);
}

bool Document::redo() {
  return step(&Document::bring_back);
}

bool Document::go_to_step(Id id) {
  std::int64_t taken = 0;
  try {
    taken = project_.go_to_step(id, JobContext());
    if (taken > 0) history_ = project_.history();
  } catch (const Error& error) {
    report(error);
  }
  if (taken > 0) follow_change();
  return taken > 0;
}

void Document::set_velocity(double velocity) {
  try {
    project_.set_setting(kVelocitySetting, QString::number(velocity, 'g', 17).toStdString());
  } catch (const Error& error) {
    return report(error);
  }
  reload_volumes();
}

void Document::refresh(std::map<Id, Fault> already) {
  try {
    // Views read their samples again after reload_volumes().
    const auto same = [](const project::VolumeRecord& a, const project::VolumeRecord& b) {
      return a.id == b.id && a.name == b.name && a.file == b.file && a.bytes == b.bytes &&
             a.checksum == b.checksum && a.role == b.role;
    };
    if (!std::ranges::equal(project_.volumes(), volumes_, same) || stored_velocity(project_) != velocity_ ||
        survey_ != project_.survey()) {
      reload_volumes();
    }
    history_ = project_.history();
    reload_interpretation(std::move(already));
    Q_EMIT history_changed();
    if (std::vector<std::string> runs = marks_of(project_.runs()); std::exchange(runs_, runs) != runs)
      Q_EMIT runs_changed();
    if (std::vector<std::string> views = marks_of(project_.views()); std::exchange(views_, views) != views)
      Q_EMIT views_changed();
  } catch (const Error& error) {
    report(error);
  }
}

void Document::refresh_interpretation() {
  try {
    history_ = project_.history();
  } catch (const Error& error) {
    report(error);
  }
  follow_change();
}

void Document::reload_volumes() {
  try {
    const bool had_survey = survey_.has_value();
    const std::optional<double> former = std::exchange(velocity_, stored_velocity(project_));
    survey_ = project_.survey();
    volumes_ = project_.volumes();
    if (survey_.has_value() != had_survey || velocity_ != former) Q_EMIT survey_changed();
    Q_EMIT volumes_changed();
  } catch (const Error& error) {
    report(error);
  }
}

// Reads the pillars of those faults alone whose revision differs from what is kept; nothing kept changes
// before all of that is read.
void Document::reload_interpretation(std::map<Id, Fault> already) {
  std::vector<project::FaultRecord> records = project_.faults();
  std::map<Id, std::vector<survey::Pillar>> read;
  for (const project::FaultRecord& record : records) {
    const Fault* known = fault(record.id);
    if (known != nullptr && known->record.revision == record.revision) continue;
    const auto given = already.find(record.id);
    const bool is_read = given != already.end() && given->second.record.revision == record.revision;
    read[record.id] = is_read ? std::move(given->second.pillars) : project_.pillars(record.id);
  }

  // 1. What differs, and whose pillars and nodes are no longer whose they were.
  std::set<Id> reshaped;
  for (const auto& [fault, pillars] : std::exchange(provisional_, {})) reshaped.insert(fault);
  for (const auto& [fault, pillars] : read) reshaped.insert(fault);
  std::set<Id> stays;
  for (const project::FaultRecord& record : records) stays.insert(record.id);
  for (const Fault& before : faults_) {
    const bool is_gone = !stays.contains(before.record.id);
    if (is_gone) reshaped.insert(before.record.id);
    if (!is_gone && !read.contains(before.record.id)) continue;
    for (const survey::Pillar& pillar : before.pillars) {
      fault_of_pillar_.erase(pillar.id);
      for (const survey::PillarNode& node : pillar.nodes) fault_of_node_.erase(node.id);
    }
  }
  for (const auto& [fault, pillars] : read) {
    for (const survey::Pillar& pillar : pillars) {
      fault_of_pillar_[pillar.id] = fault;
      for (const survey::PillarNode& node : pillar.nodes) fault_of_node_[node.id] = fault;
    }
  }

  // 2. The faults as they are now.
  std::vector<Fault> now;
  for (project::FaultRecord& record : records) {
    const auto found = read.find(record.id);
    std::vector<survey::Pillar>& pillars =
        found != read.end() ? found->second : faults_[place_of_fault_.at(record.id)].pillars;
    now.push_back({std::move(record), std::move(pillars)});
  }
  const auto same_facts = [](const Fault& a, const Fault& b) {
    return a.record.id == b.record.id && a.record.name == b.record.name &&
           a.record.colour == b.record.colour && a.record.status == b.record.status &&
           a.record.locked == b.record.locked && a.record.interpreter == b.record.interpreter &&
           a.record.note == b.record.note;
  };
  const bool facts_differ = !std::ranges::equal(faults_, now, same_facts);
  faults_ = std::move(now);
  place_of_fault_.clear();
  for (std::size_t place = 0; place < faults_.size(); ++place)
    place_of_fault_[faults_[place].record.id] = place;
  if (facts_differ) Q_EMIT faults_changed();
  if (!reshaped.empty()) Q_EMIT shapes_changed(reshaped);
}

// After a change that is on disk: the rest of the window follows it.
void Document::follow_change() {
  try {
    reload_interpretation();
  } catch (const Error& error) {
    report(error);
  }
  Q_EMIT history_changed();
}

void Document::report(const Error& error) {
  Q_EMIT failed(QString::fromStdString(error.message()), QString::fromStdString(error.hint()));
  if (std::exchange(was_read_only_, project_.read_only()) != project_.read_only()) Q_EMIT became_read_only();
}

}  // namespace footwall::ui
