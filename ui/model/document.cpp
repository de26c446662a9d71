#include "ui/model/document.h"

#include <algorithm>
#include <cmath>
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

}  // namespace

Document::Document(project::Project project, QObject* parent) : QObject(parent), project_(std::move(project)) {
  if (!project_.read_only()) tasks::follow_parents(project_);
  survey_ = project_.survey();
  velocity_ = stored_velocity(project_);
  volumes_ = project_.volumes();
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
  const auto last = std::find_if(history_.rbegin(), history_.rend(), [](const auto& step) { return !step.undone; });
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
    changed = project_.edit(name.toStdString(), change).changed;
  } catch (const Error& error) {
    report(error);
  }
  if (changed) {
    reload_interpretation();
  } else {
    end_provisional();
  }
  return changed;
}

bool Document::step(const std::function<std::optional<std::string>()>& one) {
  bool stepped = false;
  try {
    stepped = one().has_value();
  } catch (const Error& error) {
    report(error);
  }
  if (stepped) reload_interpretation();
  return stepped;
}

bool Document::undo() {
  return step([this] { return project_.undo(); });
}

bool Document::redo() {
  return step([this] { return project_.redo(); });
}

bool Document::go_to_step(Id id) {
  const auto is_later = [&](const project::HistoryStep& one) { return one.id > id; };
  const auto undos = std::ranges::count_if(history_, [&](const auto& one) { return is_later(one) && !one.undone; });
  const auto redos = std::ranges::count_if(history_, [&](const auto& one) { return !is_later(one) && one.undone; });
  return step([&, this]() -> std::optional<std::string> {
    std::optional<std::string> last;
    for (std::int64_t n = 0; n < undos; ++n) last = project_.undo();
    for (std::int64_t n = 0; n < redos; ++n) last = project_.redo();
    return last;
  });
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
    const auto same = [](const project::VolumeRecord& a, const project::VolumeRecord& b) {
      return a.id == b.id && a.name == b.name && a.file == b.file && a.bytes == b.bytes && a.checksum == b.checksum &&
             a.role == b.role;
    };
    if (!std::ranges::equal(volumes_, project_.volumes(), same) || stored_velocity(project_) != velocity_ ||
        survey_ != project_.survey()) {
      reload_volumes();
    }
    reload_interpretation(std::move(already));
  } catch (const Error& error) {
    report(error);
  }
}

void Document::refresh_interpretation() {
  try {
    reload_interpretation();
  } catch (const Error& error) {
    report(error);
  }
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

void Document::find_again(const Fault& fault) {
  for (const survey::Pillar& pillar : fault.pillars) {
    fault_of_pillar_[pillar.id] = fault.record.id;
    for (const survey::PillarNode& node : pillar.nodes) fault_of_node_[node.id] = fault.record.id;
  }
}

void Document::forget(const Fault& fault) {
  for (const survey::Pillar& pillar : fault.pillars) {
    fault_of_pillar_.erase(pillar.id);
    for (const survey::PillarNode& node : pillar.nodes) fault_of_node_.erase(node.id);
  }
}

// Reads the pillars of those faults alone whose revision differs from what is kept.
void Document::reload_interpretation(std::map<Id, Fault> already) {
  std::set<Id> reshaped;
  for (const auto& [fault, pillars] : std::exchange(provisional_, {})) reshaped.insert(fault);
  std::vector<Fault> now;
  std::set<Id> gone, read;
  for (const Fault& fault : faults_) gone.insert(fault.record.id);
  for (project::FaultRecord& record : project_.faults()) {
    gone.erase(record.id);
    Fault fault;
    const auto known = place_of_fault_.find(record.id);
    const auto given = already.find(record.id);
    if (known != place_of_fault_.end() && faults_[known->second].record.revision == record.revision) {
      fault.pillars = std::move(faults_[known->second].pillars);
    } else if (given != already.end() && given->second.record.revision == record.revision) {
      fault.pillars = std::move(given->second.pillars);
      read.insert(record.id);
    } else {
      fault.pillars = project_.pillars(record.id);
      read.insert(record.id);
    }
    fault.record = std::move(record);
    now.push_back(std::move(fault));
  }
  // All of them first: a pillar may have gone over from one to another.
  for (const Fault& fault : faults_) {
    if (gone.contains(fault.record.id) || read.contains(fault.record.id)) forget(fault);
  }
  const auto same_facts = [](const Fault& a, const Fault& b) {
    return a.record.id == b.record.id && a.record.name == b.record.name && a.record.colour == b.record.colour &&
           a.record.status == b.record.status && a.record.locked == b.record.locked &&
           a.record.interpreter == b.record.interpreter && a.record.note == b.record.note;
  };
  const bool facts_differ = !std::ranges::equal(faults_, now, same_facts);
  faults_ = std::move(now);
  place_of_fault_.clear();
  for (std::size_t place = 0; place < faults_.size(); ++place) {
    place_of_fault_[faults_[place].record.id] = place;
    if (read.contains(faults_[place].record.id)) find_again(faults_[place]);
  }
  reshaped.merge(gone);
  reshaped.merge(read);
  history_ = project_.history();
  if (facts_differ) Q_EMIT faults_changed();
  if (!reshaped.empty()) Q_EMIT shapes_changed(reshaped);
  Q_EMIT history_changed();
}

void Document::report(const Error& error) {
  Q_EMIT failed(QString::fromStdString(error.message()), QString::fromStdString(error.hint()));
}

}  // namespace footwall::ui
