#include "storage/project/project.h"

#include <fmt/format.h>

#include "storage/base/error.h"
#include "storage/project/detail/fault_table.h"
#include "storage/project/detail/mesh_table.h"
#include "storage/project/detail/names.h"
#include "storage/project/detail/project_state.h"
#include "storage/project/detail/run_table.h"
#include "storage/project/detail/surface_table.h"
#include "storage/project/detail/survey_table.h"
#include "storage/project/detail/view_table.h"
#include "storage/project/detail/volume_table.h"
#include "storage/survey/lattice.h"

namespace footwall::project {

using detail::FaultTable;
using detail::MeshTable;
using detail::RunTable;
using detail::SurfaceTable;
using detail::SurveyTable;
using detail::ViewTable;
using detail::VolumeTable;

const std::filesystem::path& Project::path() const {
  return state_->path;
}

std::filesystem::path Project::volumes_folder() const {
  std::filesystem::path folder = state_->path;
  folder += ".volumes";
  return folder;
}

bool Project::read_only() const {
  return !state_->lock || state_->lost;
}
std::vector<std::string> Project::notices() const {
  return state_->notices;
}
int Project::schema_version() const {
  return state_->version;
}

void check_name(std::string_view what, const std::string& name) {
  detail::check_name(what, name);
}

// Survey and settings.

std::optional<survey::Geometry> Project::survey() const {
  return SurveyTable(*state_->database).read();
}
std::string Project::survey_provenance() const {
  return SurveyTable(*state_->database).provenance();
}

void Project::set_survey(const survey::Geometry& geometry, const std::string& provenance) {
  geometry.validate();
  state_->write([&] {
    const auto present = SurveyTable(*state_->database).read();
    const bool moved =
        present && (present->inlines != geometry.inlines || present->crosslines != geometry.crosslines ||
                    present->samples != geometry.samples || present->z0 != geometry.z0 ||
                    present->interval != geometry.interval);
    if (moved && !VolumeTable(*state_->database).all().empty()) {
      throw Error(ErrorCode::kInvalid,
                  "the survey's lines and samples cannot change once the project has volumes in them",
                  "make a new project");
    }
    // Meshes made without a survey are imported surfaces in the units of their files.
    if (!present) MeshTable(*state_->database).remove_all();
    SurveyTable(*state_->database).write(geometry, provenance);
  });
}

std::optional<std::string> Project::setting(const std::string& name) const {
  return SurveyTable(*state_->database).setting(name);
}

void Project::set_setting(const std::string& name, const std::string& value) {
  detail::check_name("setting", name);
  detail::check_text("a setting", value);
  state_->write([&] { SurveyTable(*state_->database).set_setting(name, value); });
}

// Volumes.

std::vector<VolumeRecord> Project::volumes() const {
  return VolumeTable(*state_->database).all();
}
VolumeRecord Project::volume(const std::string& name) const {
  return VolumeTable(*state_->database).find(name);
}

std::filesystem::path Project::volume_path(const VolumeRecord& volume) const {
  return (volumes_folder() / volume.file).lexically_normal();
}

std::string Project::relative_file(const std::filesystem::path& file) const {
  const auto whole = std::filesystem::weakly_canonical(std::filesystem::absolute(file));
  const auto relative = whole.lexically_relative(volumes_folder());
  return (relative.empty() ? whole : relative).string();
}

std::int64_t Project::add_volume(const VolumeRecord& volume) {
  return state_->write([&] { return VolumeTable(*state_->database).add(volume); });
}

void Project::update_volume(const VolumeRecord& volume) {
  state_->write([&] { VolumeTable(*state_->database).update(volume); });
}

void Project::delete_volume(std::int64_t id) {
  state_->write([&] { VolumeTable(*state_->database).remove(id); });
}

namespace {
// Why the file cannot be the volume's; empty when it can.
std::string misfit(const std::filesystem::path& file, const VolumeRecord& volume) {
  std::error_code trouble;
  const auto size = std::filesystem::file_size(file, trouble);
  if (trouble) return "not there";
  if (static_cast<std::int64_t>(size) == volume.bytes) return {};
  return fmt::format("has {} bytes, expected {}", size, volume.bytes);
}
}  // namespace

std::vector<MissingFile> Project::missing() const {
  std::vector<MissingFile> missing;
  for (const VolumeRecord& volume : volumes()) {
    const auto file = volume_path(volume);
    if (auto reason = misfit(file, volume); !reason.empty())
      missing.push_back({volume.name, file, std::move(reason)});
  }
  return missing;
}

void Project::relink(const std::string& name, const std::filesystem::path& file,
                     const std::optional<std::string>& checksum) {
  VolumeRecord volume = this->volume(name);
  if (const auto reason = misfit(file, volume); !reason.empty()) {
    throw Error(reason == "not there" ? ErrorCode::kNotFound : ErrorCode::kInvalid,
                fmt::format("{} cannot be volume '{}': {}", file.string(), volume.name, reason));
  }
  if (checksum && *checksum != volume.checksum) {
    throw Error(ErrorCode::kInvalid, fmt::format("{} is not volume '{}': its checksum is {}, expected {}",
                                                 file.string(), volume.name, *checksum, volume.checksum));
  }
  volume.file = relative_file(file);
  update_volume(volume);
}

// The interpretation and the truth, read.

std::vector<FaultRecord> Project::faults() const {
  return FaultTable(*state_->database).all();
}
FaultRecord Project::fault(const std::string& name) const {
  return FaultTable(*state_->database).find(name);
}
FaultRecord Project::fault(std::int64_t id) const {
  return FaultTable(*state_->database).find(id);
}
std::vector<survey::Pillar> Project::pillars(std::int64_t fault) const {
  return FaultTable(*state_->database).pillars(fault);
}

std::vector<SurfaceRecord> Project::surfaces() const {
  return SurfaceTable(*state_->database, SurfaceTable::Family::kSurface).all();
}
std::optional<SurfaceRecord> Project::surface_of(std::int64_t fault) const {
  return SurfaceTable(*state_->database, SurfaceTable::Family::kSurface).of_fault(fault);
}
survey::Surface Project::surface(std::int64_t id) const {
  return SurfaceTable(*state_->database, SurfaceTable::Family::kSurface).read(id);
}

void Project::add_truth(const survey::Surface& surface, const std::string& kind) {
  state_->write([&] {
    const auto id = state_->database->integer("SELECT coalesce(max(id), 0) + 1 FROM truth");
    SurfaceRecord record;
    record.id = id;
    record.kind = kind;
    SurfaceTable(*state_->database, SurfaceTable::Family::kTruth).insert(surface, record);
  });
}

std::vector<survey::Surface> Project::truth() const {
  const SurfaceTable table(*state_->database, SurfaceTable::Family::kTruth);
  std::vector<survey::Surface> surfaces;
  for (const SurfaceRecord& record : table.all()) surfaces.push_back(table.read(record.id));
  return surfaces;
}

// Meshes.

void Project::store_mesh(std::int64_t fault, const MeshRecord& mesh) {
  state_->write([&] {
    FaultTable(*state_->database).find(fault);
    MeshTable(*state_->database).write(fault, mesh);
  });
}

std::optional<MeshRecord> Project::mesh(std::int64_t fault) const {
  return MeshTable(*state_->database).read(fault);
}

bool Project::mesh_is_stale(std::int64_t fault) const {
  const std::int64_t made_from = MeshTable(*state_->database).revision(fault);
  return made_from == 0 || made_from != FaultTable(*state_->database).revision(fault);
}

// Statistics and runs.

std::vector<StatisticRecord> Project::statistics() const {
  return RunTable(*state_->database).statistics();
}

void Project::register_statistics(std::span<const StatisticRecord> statistics) {
  state_->write([&] {
    for (const StatisticRecord& statistic : statistics) RunTable(*state_->database).put(statistic);
  });
}

std::int64_t Project::add_run(const RunRecord& run, std::span<const FaultRun> faults) {
  return state_->write([&] { return RunTable(*state_->database).add(run, faults); });
}

std::vector<RunRecord> Project::runs() const {
  return RunTable(*state_->database).all();
}

RunRecord Project::run(std::optional<std::int64_t> id) const {
  const auto all = runs();
  for (auto at = all.rbegin(); at != all.rend(); ++at) {
    if (!id || at->id == *id) return *at;
  }
  throw Error(ErrorCode::kNotFound, id ? fmt::format("there is no run {}", *id) : "the project has no run",
              "footwall extract makes one");
}

std::vector<std::int64_t> Project::run_faults(std::int64_t run) const {
  return RunTable(*state_->database).faults(run);
}
FaultRun Project::fault_statistics(std::int64_t run, std::int64_t fault) const {
  return RunTable(*state_->database).read(run, fault);
}
std::vector<FaceVoxels> Project::face_voxels(std::int64_t run, std::int64_t fault) const {
  return RunTable(*state_->database).voxels(run, fault);
}
void Project::rename_run(std::int64_t run, const std::string& name) {
  state_->write([&] { RunTable(*state_->database).rename(run, name); });
}

void Project::delete_run(std::int64_t run) {
  state_->write([&] { RunTable(*state_->database).remove(run); });
}

std::vector<bool> Project::stale_faces(std::int64_t run, std::int64_t fault) const {
  const FaultRun made = fault_statistics(run, fault);
  std::vector<bool> stale(made.panels.size(), true);
  const auto geometry = survey();
  if (!geometry || mesh_is_stale(fault)) return stale;
  const auto now = mesh(fault);
  if (!now) return stale;
  const survey::Lattice lattice(*geometry);
  std::map<std::pair<std::int64_t, std::int32_t>, survey::LatticeTriangle> faces;
  for (const MeshFace& face : now->faces) {
    survey::LatticeTriangle triangle;
    for (int corner = 0; corner < 3; ++corner) {
      triangle[corner] =
          lattice.from_world(now->vertices[static_cast<std::size_t>(face.vertices[corner])].position);
    }
    faces[{face.panel, face.n}] = triangle;
  }
  for (std::size_t f = 0; f < stale.size(); ++f) {
    const auto found = faces.find({made.panels[f], made.numbers[f]});
    stale[f] = found == faces.end() || found->second != made.lattice[f];
  }
  return stale;
}

// Views.

std::vector<ViewRecord> Project::views() const {
  return ViewTable(*state_->database).all();
}

ViewRecord Project::view(const std::string& name) const {
  std::string names;
  for (const ViewRecord& view : views()) {
    if (view.name == name) return view;
    names += names.empty() ? view.name : ", " + view.name;
  }
  throw Error(ErrorCode::kNotFound, fmt::format("there is no saved view '{}'", name),
              names.empty() ? "footwall render --save-view saves one" : "there are: " + names);
}

void Project::save_view(const ViewRecord& view) {
  state_->write([&] { ViewTable(*state_->database).put(view); });
}

void Project::delete_view(const std::string& name) {
  view(name);
  state_->write([&] { ViewTable(*state_->database).remove(name); });
}

// Integrity.

IntegrityReport Project::check() const {
  detail::Database& database = *state_->database;
  IntegrityReport report;
  const auto attempt = [&](const auto& read) {
    try {
      read();
    } catch (const Error& error) {
      report.problems.push_back(error.message());
    }
  };
  attempt([&] {
    detail::Query row(database, "PRAGMA integrity_check(20)");
    while (row.next()) {
      if (row.text(0) != "ok") report.problems.push_back(row.text(0));
    }
  });
  attempt([&] {
    detail::Query row(database, "PRAGMA foreign_key_check");
    while (row.next()) {
      report.problems.push_back(fmt::format("row {} of {} names a row of {} that is not there",
                                            row.integer(1), row.text(0), row.text(2)));
    }
  });
  attempt([&] { survey(); });
  attempt([&] {
    for (const FaultRecord& fault : faults()) {
      attempt([&] { pillars(fault.id); });
      attempt([&] { mesh(fault.id); });
    }
  });
  attempt([&] {
    for (const SurfaceRecord& record : surfaces()) attempt([&] { surface(record.id); });
  });
  attempt([&] { truth(); });
  attempt([&] {
    for (const RunRecord& record : runs()) {
      for (const std::int64_t fault : run_faults(record.id))
        attempt([&] { fault_statistics(record.id, fault); });
    }
  });
  return report;
}

}  // namespace footwall::project
