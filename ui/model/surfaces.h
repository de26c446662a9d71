// The triangle surface and colours of every fault, kept in step with the pillars: while a node is dragged as
// well as after an edit. Triangulates on a thread of its own; colours come from the engine (engine_link.h) or
// from the runs of the project.
#pragma once
#include <QObject>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "engine/pillars/triangulate.h"
#include "storage/survey/lattice.h"
#include "ui/model/document.h"

namespace footwall::ui {

// One triangulation, never changed after it was made. Vertices and faces go together: faces[f].vertices are
// numbers of vertices, lattice[f] the same corners as the engine has them.
struct FaultSurface {
  Id fault = 0;
  std::int64_t revision = 0;  // FaultRecord::revision of its pillars
  bool provisional = false;   // of pillars that are shown, not stored
  std::vector<survey::WorldPoint> vertices;
  std::vector<survey::IndexPoint> places;  // of the same vertices, in voxels, as they are (not rounded)
  std::vector<Id> pillars;  // of the same vertices: the pillar on whose line each stands; 0: between pillars
  std::vector<project::MeshFace> faces;
  std::vector<survey::LatticeTriangle> lattice;
  int side = 1;  // 1 or -1: windings' normals times this point to the fault's side, as offsets count
  // What needs no voxels, by statistic, one value a face: area, dip ...
  std::map<std::string, std::vector<double>> geometry;
  std::vector<std::uint32_t> by_name;  // numbers of faces by rising (panel, n); empty: they stand so already

  // The face of that name, looked for at `guess` first; faces.size() where there is none.
  std::size_t place_of(Id panel, std::int32_t n, std::size_t guess) const;
};

// How much its colours are worth: four states of what is known now, and kKept of a stored run (ShownNumbers)
// whose faces stand where they did.
enum class Freshness { kFresh, kFollowing, kKept, kStale, kPlain };

// A statistic of the faces of one surface, in its order.
struct FaceNumbers {
  std::vector<double> values;         // NaN: undefined, or not known yet
  std::vector<std::uint8_t> stale;    // 1: the value is that of the face before it moved
  std::vector<std::uint8_t> hatched;  // 1: under 30 samples, left out of rankings
};

// Whether the engine tells this statistic (an offset) only when nothing else is to be done.
bool comes_late(const QString& statistic);
// The engine's numbers as a run of the project, which takes the place of the former live one of the volume.
struct LiveRun {
  project::RunRecord run;
  std::vector<project::FaultRun> faults;
};
// Throws what the project refuses. May run on any thread that the project belongs to.
void store(project::Project& project, const LiveRun& live);

class EngineLink;

class Surfaces final : public QObject {
  Q_OBJECT

 public:
  // engine: may be null; colours then come from stored runs.
  Surfaces(Document& document, EngineLink* engine, QObject* parent = nullptr);
  ~Surfaces() override;

  // The newest surface of the fault; null where it has none (fewer than two pillars, or see problem()).
  std::shared_ptr<const FaultSurface> surface(Id fault) const;
  // Why the fault has no surface, or what the user should know about it; empty where all is well.
  QString problem(Id fault) const;
  // What is known now, also while views show a stored run (ShownNumbers).
  // name: of the project's statistics. Null where nothing of it is known.
  std::shared_ptr<const FaceNumbers> numbers(Id fault, const QString& statistic) const;
  Freshness freshness(Id fault, const QString& statistic) const;
  // Names, ranges and colour maps, as the project registers them.
  const std::vector<project::StatisticRecord>& statistics() const;
  // 2nd to 98th percentile over all faults given, of values that are not stale; of a statistic with a sign (a
  // diverging colour map) the 98th of |value| and its opposite. Nothing where there are none.
  std::optional<std::pair<double, double>> range(const std::set<Id>& faults, const QString& statistic) const;
  // The same of these numbers.
  std::optional<std::pair<double, double>> range_of(
      std::span<const std::shared_ptr<const FaceNumbers>> numbers, const QString& statistic) const;

  // Detail of a fault's triangulation, kept with its mesh. The surface is made anew.
  pillars::Options options(Id fault) const;
  void set_options(Id fault, const pillars::Options& options);
  // Nothing is being triangulated, and no answer of the engine is awaited. Offsets are not waited for: they
  // take long, and come fault by fault while nothing else is to be done.
  bool is_settled() const;
  // What is known now of the engine's volume, of those faults that are wholly fresh; nothing where nothing is
  // known.
  std::optional<LiveRun> live_run() const;
  // Keeps it in the document's project, at once. Throws what the project refuses.
  void store_live_run();

 Q_SIGNALS:
  void surfaces_changed(const std::set<footwall::ui::Id>& faults);
  void numbers_changed(const std::set<footwall::ui::Id>& faults);
  // Of the statistics alone that comes_late() names: they come one fault after the other, and mostly nobody
  // looks.
  void offsets_changed(const std::set<footwall::ui::Id>& faults);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace footwall::ui
