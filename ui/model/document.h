// The open project as the editor sees it: the interpretation kept in memory, every gesture one edit on disk,
// and signals for those who show it. Lives in the window's thread.
//
// Nothing here throws into Qt's event loop: what a project refuses comes as the signal failed().
#pragma once
#include <QObject>
#include <QString>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <unordered_map>
#include <vector>

#include "storage/base/error.h"
#include "storage/project/project.h"

namespace footwall::ui {

using Id = std::int64_t;  // of a fault, pillar, node, volume or run: the project's

// A fault and its pillars as they are stored.
struct Fault {
  project::FaultRecord record;
  std::vector<survey::Pillar> pillars;  // by id
};

class Document final : public QObject {
  Q_OBJECT

 public:
  // project: open; for reading alone where read_only().
  explicit Document(project::Project project, QObject* parent = nullptr);
  ~Document() override;

  const project::Project& project() const { return project_; }
  // For what is derived or about the project: meshes, runs, volumes, views, settings. Who changes those says
  // so with the signals below. The interpretation is changed by edit() alone.
  project::Project& store() { return project_; }
  bool read_only() const { return project_.read_only(); }
  const std::optional<survey::Geometry>& survey() const { return survey_; }
  // Of the survey, in m/s, for metres in a time survey; nothing where it is not known.
  const std::optional<double>& velocity() const { return velocity_; }
  void set_velocity(double velocity);

  const std::vector<Fault>& faults() const { return faults_; }  // in the order they were made
  const Fault* fault(Id fault) const;                           // null where there is none
  const Fault* fault_of_pillar(Id pillar) const;
  const survey::Pillar* pillar(Id pillar) const;
  const Fault* fault_of_node(Id node) const;
  const std::vector<project::VolumeRecord>& volumes() const { return volumes_; }
  const std::vector<project::HistoryStep>& history() const { return history_; }
  bool can_undo() const;
  bool can_redo() const;

  // What views and live colours show: the stored pillars, or while a gesture is under way the provisional
  // ones.
  const std::vector<survey::Pillar>& shown_pillars(Id fault) const;
  bool is_provisional(Id fault) const { return provisional_.contains(fault); }
  // Replaces what is shown of the fault until end_provisional() or the next edit; stores nothing.
  void show_provisionally(Id fault, std::vector<survey::Pillar> pillars);
  void end_provisional();

  // One gesture: one step of the history, on disk when this returns. False where the project refused it
  // (failed() has said why) or nothing differed.
  bool edit(const QString& name, const std::function<void(project::Interpretation&)>& change);
  bool undo();
  bool redo();
  // To the state after the step of this number (0: before the first), in one transaction. Many steps take
  // their time: history_jump.h.
  bool go_to_step(Id step);

  // Reads again what others may have changed: for a project that somebody else writes, or a job of this
  // program beside(). already: faults that were read on the way, by id; they are not read a second time where
  // they are the stored ones still.
  void refresh(std::map<Id, Fault> already = {});
  // The same of the interpretation and its history alone: after an edit that was made in store().
  void refresh_interpretation();

 Q_SIGNALS:
  // Pillars of these faults differ, in what is stored or shown; faults that are gone are among them.
  void shapes_changed(const std::set<footwall::ui::Id>& faults);
  // Names, colours, order or number of faults differ.
  void faults_changed();
  void history_changed();
  // There is one now, or its velocity differs.
  void survey_changed();
  void volumes_changed();
  void meshes_changed(const std::set<footwall::ui::Id>& faults);
  void runs_changed();
  void views_changed();
  // Another program took the project over: it can only be read from now on.
  void became_read_only();
  // One line of what happened, one of how to mend it (may be empty).
  void failed(const QString& message, const QString& hint);

 public Q_SLOTS:
  // After volumes were added, removed or relinked in store().
  void reload_volumes();

 private:
  // Work in proportion to what differs, whatever the length of the history and the size of the faults that
  // stay.
  void reload_interpretation(std::map<Id, Fault> already = {});
  void follow_change();
  void report(const Error& error);
  bool step(bool (Document::*one)());
  bool take_back();
  bool bring_back();

  project::Project project_;
  std::optional<survey::Geometry> survey_;
  std::optional<double> velocity_;
  std::vector<Fault> faults_;
  std::vector<project::VolumeRecord> volumes_;
  std::vector<project::HistoryStep> history_;
  std::vector<std::string> runs_, views_;  // those that were told of
  bool was_read_only_ = false;
  std::map<Id, std::size_t> place_of_fault_;
  std::unordered_map<Id, Id> fault_of_pillar_;
  std::unordered_map<Id, Id> fault_of_node_;
  std::map<Id, std::vector<survey::Pillar>> provisional_;
};

}  // namespace footwall::ui
