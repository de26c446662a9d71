#include "ui/model/surfaces.h"

#include <QTimer>
#include <algorithm>
#include <cmath>
#include <deque>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine/extract/face_geometry.h"
#include "engine/render/colour_map.h"
#include "engine/tasks/statistics.h"
#include "storage/base/log.h"
#include "ui/model/engine_link.h"
#include "ui/model/face_values.h"
#include "ui/model/fault_commands.h"
#include "ui/model/surface_worker.h"

namespace footwall::ui {
namespace {

// "velocity" of the project, in m/s; nothing where it is not known.
std::optional<double> velocity_of(const project::Project& project) {
  const auto text = project.setting("velocity");
  if (!text) return std::nullopt;
  const double velocity = QString::fromStdString(*text).toDouble();
  return velocity > 0 && std::isfinite(velocity) ? std::optional(velocity) : std::nullopt;
}

constexpr std::array kOffsets{"offset", "offset_voxels", "offset_score"};

constexpr double kSignedPercentile = 98;  // of |value|

bool diverges(const std::string& colour_map) {
  const auto all = render::ColourMap::all();
  const auto found = std::ranges::find(all, std::string_view(colour_map), &render::ColourMap::name);
  return found != all.end() && found->kind() == render::ColourMapKind::kDiverging;
}

pillars::Options options_of(const project::MeshRecord& mesh) {
  pillars::Options options;
  const auto json = nlohmann::json::parse(mesh.parameters, nullptr, false);
  if (!json.is_object()) return options;
  const auto take = [&json](const char* name, double& into) {
    const auto found = json.find(name);
    if (found != json.end() && found->is_number() && found->get<double>() > 0) into = found->get<double>();
  };
  take("detail", options.detail);
  take("max_edge", options.max_edge);
  take("tie", options.tie_tolerance);
  return options;
}

}  // namespace

bool comes_late(const QString& statistic) {
  return std::ranges::any_of(kOffsets, [&](const char* one) { return statistic == QLatin1String(one); });
}

struct Surfaces::State {
  // What is known of one fault.
  struct Entry {
    std::shared_ptr<const FaultSurface> surface;
    QString problem;
    FaceValues values;
    pillars::Options options;
    project::Bytes chart;        // of its last mesh
    std::uint64_t asked = 0;     // the newest triangulation asked for; 0: none yet
    std::uint64_t made = 0;      // the newest that came
    std::uint64_t edit = 0;      // under which the engine has its surface; 0: it has not
    std::map<QString, std::shared_ptr<const FaceNumbers>> numbers;  // made when asked for
  };

  State(Surfaces& owner, Document& d, EngineLink* link) : self(owner), document(d), engine(link) {}

  Surfaces& self;
  Document& document;
  EngineLink* engine;
  std::unique_ptr<SurfaceWorker> worker;
  std::map<Id, Entry> entries;
  std::deque<Id> to_load;  // stored meshes not read yet
  QTimer loading;
  std::uint64_t last_request = 0;
  std::vector<project::StatisticRecord> statistics;
  std::optional<double> velocity;
  struct KeptRange {
    std::set<Id> faults;
    QString statistic;
    std::optional<std::pair<double, double>> range;
  };
  mutable std::optional<KeptRange> kept_range;

  void start_worker() {
    worker.reset();
    if (!document.survey()) return;
    worker = std::make_unique<SurfaceWorker>(*document.survey(), [this](MadeSurface made) {
      // The worker ends before this object does, and the receiver takes its waiting events along.
      QMetaObject::invokeMethod(
          &self, [this, made = std::move(made)]() mutable { take(std::move(made)); }, Qt::QueuedConnection);
    });
  }

  // ---- surfaces ----

  void load_next() {
    if (to_load.empty() || worker == nullptr) {
      loading.stop();
      return;
    }
    const Id id = to_load.front();
    to_load.pop_front();
    const Fault* fault = document.fault(id);
    if (fault == nullptr || entries[id].asked != 0) return;
    try {
      load(*fault, entries[id]);
    } catch (const Error& error) {
      entries[id].problem = QString::fromStdString(error.message());
    }
    Q_EMIT self.surfaces_changed({id});
  }

  void load(const Fault& fault, Entry& entry) {
    const auto mesh = document.project().mesh(fault.record.id);
    if (mesh) {
      entry.options = options_of(*mesh);
      entry.chart = mesh->chart;
    }
    if (!mesh || document.project().mesh_is_stale(fault.record.id)) {
      ask(fault, entry, false);
      return;
    }
    entry.asked = entry.made = ++last_request;
    set_surface(entry, surface_of(*document.survey(), fault.record, *mesh, false));
    take_stored_numbers(fault.record.id, entry);
  }

  void ask(const Fault& fault, Entry& entry, bool urgent) {
    if (worker == nullptr) return;
    const auto& pillars = document.shown_pillars(fault.record.id);
    if (is_unassigned(fault) || (pillars.size() < 2 && !has_surface_file(fault))) {
      entry.asked = entry.made = ++last_request;
      entry.problem.clear();
      worker->forget(fault.record.id);
      set_surface(entry, nullptr);
      Q_EMIT self.surfaces_changed({fault.record.id});
      return;
    }
    if (has_surface_file(fault)) {
      adopt_surface_file(fault, entry);
      return;
    }
    SurfaceRequest request;
    request.number = entry.asked = ++last_request;
    request.fault = fault.record;
    request.pillars = pillars;
    // A frame found from the first picks would stay with the fault for good: it is settled by the fourth pillar.
    constexpr std::size_t kSettled = 4;
    request.chart = fault.record.chart;
    if (request.chart.empty() && pillars.size() >= kSettled) request.chart = entry.chart;
    request.options = {.detail = entry.options.detail, .max_edge = entry.options.max_edge,
                       .tie = entry.options.tie_tolerance};
    request.provisional = document.is_provisional(fault.record.id);
    request.urgent = urgent;
    worker->ask(std::move(request));
  }

  bool has_surface_file(const Fault& fault) const {
    return fault.pillars.empty() && document.project().surface_of(fault.record.id).has_value();
  }

  // A fault that is an imported surface: its triangles as they are.
  void adopt_surface_file(const Fault& fault, Entry& entry) {
    entry.asked = entry.made = ++last_request;
    try {
      std::vector<std::string> notes;
      const project::MeshRecord mesh = tasks::mesh_of_fault(document.project(), fault.record, {}, {}, &notes);
      if (!document.read_only()) document.store().store_mesh(fault.record.id, mesh);
      set_surface(entry, surface_of(*document.survey(), fault.record, mesh, false));
    } catch (const Error& error) {
      entry.problem = QString::fromStdString(error.message());
    }
    Q_EMIT self.surfaces_changed({fault.record.id});
  }

  void take(MadeSurface made) {
    const auto found = entries.find(made.fault);
    const Fault* fault = document.fault(made.fault);
    if (found == entries.end() || fault == nullptr) return;
    Entry& entry = found->second;
    if (made.number <= entry.made) return;
    entry.made = made.number;
    entry.problem = QString::fromStdString(made.problem);
    if (made.surface != nullptr) {
      if (entry.chart.empty() || !made.surface->provisional) entry.chart = made.mesh.chart;
      if (!made.surface->provisional && !document.read_only() && made.mesh.revision == fault->record.revision) {
        try {
          document.store().store_mesh(made.fault, made.mesh);
          Q_EMIT document.meshes_changed({made.fault});
        } catch (const Error& error) {
          Q_EMIT document.failed(QString::fromStdString(error.message()), QString::fromStdString(error.hint()));
        }
      }
    }
    // While a hand is on it, the last surface stays where the pillars cannot make one for a moment.
    const bool keeps_last = made.surface == nullptr && document.is_provisional(made.fault);
    if (!keeps_last) set_surface(entry, made.surface);
    Q_EMIT self.surfaces_changed({made.fault});
  }

  void set_surface(Entry& entry, std::shared_ptr<const FaultSurface> surface) {
    const Id fault = surface != nullptr ? surface->fault : entry.surface != nullptr ? entry.surface->fault : 0;
    const bool turned =
        surface != nullptr && entry.surface != nullptr && surface->side != entry.surface->side;
    entry.surface = std::move(surface);
    entry.values.set_surface(entry.surface);
    if (turned) {
      for (const char* offset : kOffsets) entry.values.mark_stale(offset);
    }
    entry.numbers.clear();
    if (entry.surface != nullptr) set_geometry(entry);
    if (engine == nullptr || fault == 0) return;
    if (entry.surface != nullptr) {
      entry.edit = engine->put_fault(entry.surface);
      entry.values.tell_moved(entry.edit);
    } else {
      engine->remove_fault(fault);
      entry.edit = 0;
    }
  }

  // What needs no voxels is known at once.
  void set_geometry(Entry& entry) const {
    const FaultSurface& surface = *entry.surface;
    std::map<std::string, std::vector<double>> columns;
    const auto column = [&](const char* name) -> std::vector<double>& {
      columns[name].reserve(surface.faces.size());
      return columns[name];
    };
    auto &area_voxels = column("area_voxels"), &area = column("area"), &dip = column("dip"),
         &azimuth = column("dip_azimuth"), &metres = column("metres_along_normal");
    for (const survey::LatticeTriangle& triangle : surface.lattice) {
      const extract::FaceGeometry geometry = extract::face_geometry(*document.survey(), triangle, velocity);
      area_voxels.push_back(geometry.area_voxels);
      area.push_back(geometry.area);
      dip.push_back(geometry.dip);
      azimuth.push_back(geometry.dip_azimuth);
      metres.push_back(geometry.metres_along_normal);
    }
    for (auto& [name, values] : columns) entry.values.set_geometry(name, std::move(values));
  }

  // ---- numbers ----

  // Of the last run that has the fault.
  void take_stored_numbers(Id fault, Entry& entry) {
    if (entry.surface == nullptr) return;
    const auto runs = document.project().runs();
    for (auto run = runs.rbegin(); run != runs.rend(); ++run) {
      const auto faults = document.project().run_faults(run->id);
      if (std::ranges::find(faults, fault) == faults.end()) continue;
      const project::FaultRun stored = document.project().fault_statistics(run->id, fault);
      for (const auto& [statistic, values] : stored.statistics) {
        if (entry.values.is_geometry(statistic)) continue;
        for (std::size_t f = 0; f < values.size(); ++f) {
          entry.values.set(stored.panels[f], stored.numbers[f], stored.lattice[f], statistic, values[f]);
        }
      }
      break;
    }
    entry.numbers.clear();
  }

  void take_answer(const EngineNumbers& answer) {
    std::map<Id, std::vector<std::size_t>> rows;
    for (std::size_t n = 0; n < answer.faults.size(); ++n) rows[answer.faults[n]].push_back(n);
    std::set<Id> changed;
    for (const auto& [fault, of_fault] : rows) {
      changed.insert(fault);
      const auto found = entries.find(fault);
      const auto known = answer.known.find(fault);
      if (found == entries.end() || known == answer.known.end()) continue;
      found->second.values.take(answer.panels, answer.face_numbers, answer.statistics, of_fault, known->second);
    }
    for (const Id fault : changed) {
      const auto found = entries.find(fault);
      if (found == entries.end()) continue;
      found->second.values.scale("offset", "offset_voxels", "metres_along_normal");
      found->second.numbers.clear();
    }
    if (!document_is_provisional()) kept_range.reset();
    const bool is_late = std::ranges::all_of(
        answer.statistics, [](const auto& entry) { return comes_late(QString::fromStdString(entry.first)); });
    if (is_late && !answer.statistics.empty()) {
      Q_EMIT self.offsets_changed(changed);
    } else {
      Q_EMIT self.numbers_changed(changed);
    }
  }

  // What is known is of the volume before.
  void volume_changed() {
    std::set<Id> faults;
    for (auto& [fault, entry] : entries) {
      entry.values.mark_all_stale();
      entry.numbers.clear();
      faults.insert(fault);
    }
    kept_range.reset();
    Q_EMIT self.numbers_changed(faults);
  }

  bool document_is_provisional() const {
    return std::ranges::any_of(entries, [this](const auto& entry) { return document.is_provisional(entry.first); });
  }

  // ---- what the document says ----

  void shapes_changed(const std::set<Id>& faults) {
    for (const Id id : faults) {
      const Fault* fault = document.fault(id);
      if (fault == nullptr) {
        if (worker != nullptr) worker->forget(id);
        if (engine != nullptr) engine->remove_fault(id);
        entries.erase(id);
        Q_EMIT self.surfaces_changed({id});
        continue;
      }
      ask(*fault, entries[id], true);
    }
  }

  void start_over() {
    start_worker();
    entries.clear();
    kept_range.reset();
    velocity = velocity_of(document.project());
    statistics = tasks::known_statistics(document.project());
    to_load.clear();
    for (const Fault& fault : document.faults()) to_load.push_back(fault.record.id);
    loading.start(0);
  }
};

Surfaces::Surfaces(Document& document, EngineLink* engine, QObject* parent)
    : QObject(parent), state_(std::make_unique<State>(*this, document, engine)) {
  connect(&state_->loading, &QTimer::timeout, this, [this] { state_->load_next(); });
  connect(&document, &Document::shapes_changed, this,
          [this](const std::set<Id>& faults) { state_->shapes_changed(faults); });
  connect(&document, &Document::survey_changed, this, [this] { state_->start_over(); });
  connect(&document, &Document::runs_changed, this, [this] {
    state_->statistics = tasks::known_statistics(state_->document.project());
  });
  if (engine != nullptr) {
    connect(engine, &EngineLink::numbers, this, [this](const EngineNumbers& answer) { state_->take_answer(answer); });
    connect(engine, &EngineLink::state_changed, this, [this] { Q_EMIT numbers_changed({}); });
    connect(engine, &EngineLink::volume_changed, this, [this] { state_->volume_changed(); });
  }
  state_->start_over();
}

Surfaces::~Surfaces() {
  state_->worker.reset();
}

std::shared_ptr<const FaultSurface> Surfaces::surface(Id fault) const {
  const auto found = state_->entries.find(fault);
  return found == state_->entries.end() ? nullptr : found->second.surface;
}

QString Surfaces::problem(Id fault) const {
  const auto found = state_->entries.find(fault);
  return found == state_->entries.end() ? QString() : found->second.problem;
}

std::shared_ptr<const FaceNumbers> Surfaces::numbers(Id fault, const QString& statistic) const {
  const auto found = state_->entries.find(fault);
  if (found == state_->entries.end() || found->second.surface == nullptr) return nullptr;
  auto& kept = found->second.numbers[statistic];
  if (kept == nullptr) kept = found->second.values.numbers(statistic.toStdString());
  return kept;
}

Freshness Surfaces::freshness(Id fault, const QString& statistic) const {
  const auto found = state_->entries.find(fault);
  if (found == state_->entries.end()) return Freshness::kPlain;
  const State::Entry& entry = found->second;
  if (!entry.values.is_known(statistic.toStdString())) return Freshness::kPlain;
  if (entry.values.is_geometry(statistic.toStdString())) {
    return state_->document.is_provisional(fault) ? Freshness::kFollowing : Freshness::kFresh;
  }
  const bool follows = state_->document.is_provisional(fault) || entry.asked != entry.made ||
                       (state_->engine != nullptr && entry.edit > state_->engine->answered());
  const bool any_stale = entry.values.any_stale(statistic.toStdString());
  if (!any_stale && !state_->document.is_provisional(fault)) return Freshness::kFresh;
  const bool engine_runs = state_->engine != nullptr && (state_->engine->state() == EngineLink::State::kReady ||
                                                         state_->engine->state() == EngineLink::State::kBusy);
  return (follows || comes_late(statistic)) && engine_runs ? Freshness::kFollowing : Freshness::kStale;
}

const std::vector<project::StatisticRecord>& Surfaces::statistics() const {
  return state_->statistics;
}

std::optional<std::pair<double, double>> Surfaces::range(const std::set<Id>& faults, const QString& statistic) const {
  auto& kept = state_->kept_range;
  if (kept && kept->faults == faults && kept->statistic == statistic) return kept->range;
  std::vector<double> values;
  for (const Id fault : faults) {
    const auto known = numbers(fault, statistic);
    if (known == nullptr) continue;
    for (std::size_t f = 0; f < known->values.size(); ++f) {
      if (known->stale[f] == 0 && std::isfinite(known->values[f])) values.push_back(known->values[f]);
    }
  }
  const auto record =
      std::ranges::find(state_->statistics, statistic.toStdString(), &project::StatisticRecord::name);
  const bool is_signed = record != state_->statistics.end() && diverges(record->colour_map);
  // As pictures have them: zero in the middle of what has a sign.
  const std::optional<render::Range> range =
      is_signed ? render::symmetric_range(std::vector<float>(values.begin(), values.end()), kSignedPercentile)
                : render::percentile_range(values);
  kept = {faults, statistic, range ? std::optional(std::pair(range->lo, range->hi)) : std::nullopt};
  return kept->range;
}

pillars::Options Surfaces::options(Id fault) const {
  const auto found = state_->entries.find(fault);
  return found == state_->entries.end() ? pillars::Options{} : found->second.options;
}

void Surfaces::set_options(Id id, const pillars::Options& options) {
  const Fault* fault = state_->document.fault(id);
  if (fault == nullptr) return;
  State::Entry& entry = state_->entries[id];
  entry.options = options;
  state_->ask(*fault, entry, true);
}

bool Surfaces::is_settled() const {
  if (!state_->to_load.empty()) return false;
  const bool engine_answers = state_->engine != nullptr && state_->engine->state() != EngineLink::State::kOff &&
                              state_->engine->state() != EngineLink::State::kLost;
  return std::ranges::all_of(state_->entries, [&](const auto& entry) {
    const bool answered = !engine_answers || entry.second.edit <= state_->engine->answered();
    return entry.second.asked == entry.second.made && answered;
  });
}

void Surfaces::store_live_run() {
  Document& document = state_->document;
  if (state_->engine == nullptr || document.read_only()) return;
  const Id volume_id = state_->engine->volume();
  const auto volume = std::ranges::find(document.volumes(), volume_id, &project::VolumeRecord::id);
  if (volume == document.volumes().end()) return;
  project::RunRecord run;
  run.name = "live";
  run.live = true;
  run.volume = volume->name;
  run.volume_checksum = volume->checksum;
  run.parameters = R"({"strategy":"live"})";
  std::vector<project::FaultRun> faults;
  for (const auto& [id, entry] : state_->entries) {
    const Fault* fault = document.fault(id);
    if (fault == nullptr || entry.surface == nullptr || entry.surface->provisional) continue;
    if (!entry.values.is_known("count") || entry.values.any_stale("count")) continue;
    project::FaultRun& one = faults.emplace_back();
    one.fault = id;
    one.fault_name = fault->record.name;
    one.revision = entry.surface->revision;
    one.lattice = entry.surface->lattice;
    for (const project::MeshFace& face : entry.surface->faces) {
      one.panels.push_back(face.panel);
      one.numbers.push_back(face.n);
    }
    for (const project::StatisticRecord& statistic : state_->statistics) {
      const auto values = entry.values.values().find(statistic.name);
      if (values == entry.values.values().end() || entry.values.any_stale(statistic.name)) continue;
      one.statistics[statistic.name] = values->second;
    }
  }
  if (faults.empty()) return;
  try {
    document.store().register_statistics(tasks::stored_statistics());
    document.store().add_run(run, faults);
  } catch (const Error& error) {
    log::warn("the live colours could not be stored: " + error.message());
  }
}

}  // namespace footwall::ui
