// A project: NAME.footwall (SQLite) and the folder NAME.footwall.volumes/ beside it (docs: design of the file
// in schema.cpp). One thread at a time; one writer at a time on all hosts, any number of readers.
//
// Every interpretation change goes through edit(): one transaction, one named step of the undo log, on disk
// when edit() returns. Meshes, runs and volumes are derived or imported: outside undo.
//
// Errors: kHeld when somebody else writes (message names host, process and since when); kFormat for a file
// that is no project or was tampered with; kCorrupt for a damaged one; kUnsupported for one made by a newer
// program; kNotFound, kInvalid, kIo as usual. Calls that write throw kInvalid on a project that is read-only.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "storage/base/job_context.h"
#include "storage/project/interpretation.h"
#include "storage/project/records.h"
#include "storage/survey/geometry.h"
#include "storage/survey/pillar.h"
#include "storage/survey/surface.h"

namespace footwall::project {

enum class OpenMode : std::uint8_t { kRead, kWrite };
enum class FileSystem : std::uint8_t { kLocal, kNetwork, kReadOnly };

// One numbered step from schema version to - 1 to `to`. Tables under undo may only get columns appended; any
// other change to them sets ends_history.
struct Migration {
  int to = 2;
  std::string name;
  std::string sql;
  bool ends_history = false;
  // For a reader, who changes nothing: temporary views that show the older tables as the newer ones; empty
  // where that cannot be done, and a file so old is then refused to readers.
  std::string for_readers = {};
};

struct OpenOptions {
  std::optional<FileSystem> file_system;  // unset: asked from the operating system
  std::vector<Migration> migrations;      // after the program's own; for tests
  std::string edit_socket;                // written into the lock, for those who find the project held
};

// Positions for interpolated pillars whose parents moved: one polyline per child, with any number of nodes
// >= 1. pillars: all of the fault, with the parents' new positions.
using Regenerator = std::function<std::vector<std::vector<survey::WorldPoint>>(
    const FaultRecord& fault, std::span<const survey::Pillar> pillars,
    std::span<const survey::Pillar> children)>;

class Project {
 public:
  // Refuses an existing file. The new project is open for writing.
  static Project create(const std::filesystem::path& path, const std::optional<survey::Geometry>& survey,
                        const OpenOptions& options = {});
  // kWrite takes the writer's lock and brings an older file up to date after a backup copy beside it. kRead
  // never writes; on read-only media the file is opened immutable.
  static Project open(const std::filesystem::path& path, OpenMode mode, const OpenOptions& options = {});
  Project(Project&&) noexcept;
  Project& operator=(Project&&) noexcept;
  // Closes; errors are logged. close() throws them.
  ~Project();
  // Another connection to the same file, for another thread of this program: it sees what is committed, and
  // writes under the same lock where this one may. One transaction at a time: whoever comes second waits
  // until the first has ended. A program must not open() a project twice instead: looking at the file closes
  // it again, and with that the process loses the POSIX locks that keep other programs from ending SQLite's
  // log. Throws what open() throws for a file that is gone.
  Project beside() const;
  // Folds the write-ahead log into the file and frees the lock; nothing else may be called afterwards.
  void close();

  const std::filesystem::path& path() const;
  std::filesystem::path volumes_folder() const;  // NAME.footwall.volumes, not created by this
  bool read_only() const;
  // What the user should see: network file system, a lock taken over, an upgrade done.
  std::vector<std::string> notices() const;
  int schema_version() const;
  // Writes a copy of the database alone, as of one moment, also while somebody else writes: a whole file that
  // does not exist before, closed cleanly. Throws kIo; kInvalid where `copy` exists. Cancelled it leaves
  // nothing.
  void copy_database(const std::filesystem::path& copy, const JobContext& job) const;

  // The survey. set_survey refuses (kInvalid) to change index space once volumes exist; the first one makes
  // the meshes stale that were made without.
  std::optional<survey::Geometry> survey() const;
  std::string survey_provenance() const;  // JSON
  void set_survey(const survey::Geometry& geometry, const std::string& provenance = "{}");
  // Small named facts about the project, e.g. "velocity" in m/s. Not under undo.
  std::optional<std::string> setting(const std::string& name) const;
  void set_setting(const std::string& name, const std::string& value);

  // Volumes, in the order they were added.
  std::vector<VolumeRecord> volumes() const;
  // An empty name means the only (or the first) one; kNotFound lists the names.
  VolumeRecord volume(const std::string& name) const;
  std::filesystem::path volume_path(const VolumeRecord& volume) const;
  // The file's name as VolumeRecord::file wants it.
  std::string relative_file(const std::filesystem::path& file) const;
  std::int64_t add_volume(const VolumeRecord& volume);
  void update_volume(const VolumeRecord& volume);  // by id
  void delete_volume(std::int64_t id);             // the row, not the file
  // Compares existence and size; checksums are the volume reader's business.
  std::vector<MissingFile> missing() const;
  // Points a volume to where its file went; refuses a file of another size, and of another checksum where
  // given.
  void relink(const std::string& volume, const std::filesystem::path& file,
              const std::optional<std::string>& checksum = {});

  // The interpretation, read. Faults and surfaces in the order they were made; pillars by id.
  std::vector<FaultRecord> faults() const;
  FaultRecord fault(const std::string& name) const;  // kNotFound lists the names
  FaultRecord fault(std::int64_t id) const;
  std::vector<survey::Pillar> pillars(std::int64_t fault) const;
  std::vector<SurfaceRecord> surfaces() const;
  // The imported surface that is this fault's shape; nothing for a fault of pillars.
  std::optional<SurfaceRecord> surface_of(std::int64_t fault) const;
  survey::Surface surface(std::int64_t id) const;

  // The interpretation, written: only here. An exception from `change` rolls everything back and passes
  // through; an edit that changes nothing records nothing; a new edit drops what could be redone. Not
  // reentrant.
  EditResult edit(const std::string& name, const std::function<void(Interpretation&)>& change);
  void set_regenerator(Regenerator regenerator);
  // The step's name; nothing when there is no step (left).
  std::optional<std::string> undo();
  std::optional<std::string> redo();
  // Takes back all later steps, or brings back this one and all before it, in one transaction; a barrier ends
  // it. Cancelled it changes nothing. Returns how many steps it took.
  std::int64_t go_to_step(std::int64_t step, const JobContext& job);
  // Oldest first; those of this number and later ones.
  std::vector<HistoryStep> history(std::int64_t first = 0) const;
  // Steps of the history and the bytes of what they hold; of those alone that trim_history(before) would
  // drop.
  HistorySize history_size(const std::optional<std::string>& before = {}) const;
  // Drops the oldest steps, up to the first that was made at `before` (UTC, as HistoryStep::when) or later,
  // or could be redone: what they did stays, but can no longer be undone. Notes it among the project's events
  // and gives the room back to the disk where nobody else reads. Returns what was dropped.
  HistorySize trim_history(const std::string& before);

  // Meshes. Stale: there is none, or the fault's shape changed since (undo makes it fresh again).
  void store_mesh(std::int64_t fault, const MeshRecord& mesh);
  std::optional<MeshRecord> mesh(std::int64_t fault) const;
  bool mesh_is_stale(std::int64_t fault) const;

  // The true surfaces of a synthetic survey; never among the faults.
  void add_truth(const survey::Surface& surface, const std::string& kind);
  std::vector<survey::Surface> truth() const;

  // Statistics that runs may hold; registering again updates the row.
  std::vector<StatisticRecord> statistics() const;
  void register_statistics(std::span<const StatisticRecord> statistics);

  // Runs, oldest first. add_run writes everything in one transaction; statistics must be registered.
  std::int64_t add_run(const RunRecord& run, std::span<const FaultRun> faults);
  std::vector<RunRecord> runs() const;
  RunRecord run(std::optional<std::int64_t> id) const;  // unset: the last one
  std::vector<std::int64_t> run_faults(std::int64_t run) const;
  FaultRun fault_statistics(std::int64_t run, std::int64_t fault) const;
  // What the run kept of the fault's voxels, by codec; empty where nothing. Throws kCorrupt.
  std::vector<FaceVoxels> face_voxels(std::int64_t run, std::int64_t fault) const;
  // An empty name: "run N", with its id.
  void rename_run(std::int64_t run, const std::string& name);
  void delete_run(std::int64_t run);
  // One entry per face of the run: true where the present mesh has no face of that id at those lattice
  // positions, or the fault is gone or edited and not yet triangulated again.
  std::vector<bool> stale_faces(std::int64_t run, std::int64_t fault) const;

  // Saved views, by name. Saving under a name that is there replaces it; view() and delete_view() throw
  // kNotFound, listing the names.
  std::vector<ViewRecord> views() const;
  ViewRecord view(const std::string& name) const;
  void save_view(const ViewRecord& view);
  void delete_view(const std::string& name);

  // integrity_check, foreign keys, and every stored blob against the counts that describe it.
  IntegrityReport check() const;

 private:
  struct State;
  explicit Project(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

// The socket on which whoever writes this project takes edits (OpenOptions::edit_socket); empty where nobody
// does, or takes none.
std::string edit_socket_of(const std::filesystem::path& project);

// Throws kInvalid for what cannot be the name of a `what`, "volume" or "run": empty, over 200 bytes, control
// characters, bytes that are not UTF-8, or blanks at an end.
void check_name(std::string_view what, const std::string& name);

}  // namespace footwall::project
