#include "ui/model/surfaces.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "engine/render/colour_map.h"
#include "engine/tasks/statistics.h"
#include "ui/model/engine_link.h"
#include "ui/model/face_values.h"
#include "ui/model/fault_commands.h"
#include "ui/model/surface_worker.h"

namespace footwall::ui {
namespace {

tasks::TriangulateOptions task_options(const pillars::Options& options) {
  return {.detail = options.detail, .max_edge = options.max_edge, .tie = options.tie_tolerance};
}

pillars::Options pillar_options(const tasks::TriangulateOptions& options) {
  return {.detail = options.detail, .max_edge = options.max_edge, .tie_tolerance = options.tie};
}

constexpr std::array kOffsets{"offset", "offset_voxels", "offset_score"};

constexpr double kSignedPercentile = 98;  // of |value|

bool diverges(const std::string& colour_map) {
  const auto all = render::ColourMap::all();
  const auto found = std::ranges::find(all, std::string_view(colour_map), &render::ColourMap::name);
  return found != all.end() && found->kind() == render::ColourMapKind::kDiverging;
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
    std::optional<pillars::Options> options;  // none: not known yet, those of its stored mesh
    project::Bytes chart;                     // of its last mesh
    std::uint64_t asked = 0;                  // the newest triangulation asked for; 0: none yet
    std::uint64_t made = 0;                   // the newest that came
    bool wants_run = false;                   // the last run's numbers are to be taken
    std::uint64_t edit = 0;                   // under which the engine has its surface; 0: it has not
    std::map<QString, std::shared_ptr<const FaceNumbers>> numbers;  // made when asked for
  };

  State(Surfaces& owner, Document& d, EngineLink* link) : self(owner), document(d), engine(link) {}

  Surfaces& self;
  Document& document;
  EngineLink* engine;
  std::unique_ptr<SurfaceWorker> worker;
  std::map<Id, Entry> entries;
  std::uint64_t last_request = 0;
  std::vector<project::StatisticRecord> statistics;
  std::optional<std::string> volume;  // that the values are of: its checksum
  struct KeptRange {
    std::set<Id> faults;
    QString statistic;
    std::optional<std::pair<double, double>> range;
  };
  mutable std::optional<KeptRange> kept_range;

  void start_worker() {
    worker.reset();
    if (!document.survey()) return;
    worker = std::make_unique<SurfaceWorker>(
        document.project().beside(), *document.survey(), [this](MadeSurface made) {
          // The worker ends before this object does, and the receiver takes its waiting events along.
          QMetaObject::invokeMethod(
              &self, [this, made = std::move(made)]() mutable { take(std::move(made)); },
              Qt::QueuedConnection);
        });
  }

  // ---- surfaces ----

  // stored: the mesh and the numbers that the project has will do, where they are fresh.
  void ask(const Fault& fault, Entry& entry, bool urgent, bool stored) {
    if (worker == nullptr) return;
    const auto& pillars = document.shown_pillars(fault.record.id);
    const bool is_file = is_surface_file(fault);
    if (is_unassigned(fault) || (pillars.size() < 2 && !is_file)) {
      entry.asked = entry.made = ++last_request;
      entry.problem.clear();
      worker->forget(fault.record.id);
      set_surface(entry, nullptr);
      Q_EMIT self.surfaces_changed({fault.record.id});
      return;
    }
    SurfaceRequest request;
    request.number = entry.asked = ++last_request;
    request.fault = fault.record;
    request.pillars = pillars;
    // A frame found from the first picks would stay with the fault for good: it is settled by the fourth
    // pillar.
    constexpr std::size_t kSettled = 4;
    request.chart = fault.record.chart;
    if (request.chart.empty() && pillars.size() >= kSettled) request.chart = entry.chart;
    if (entry.options) request.options = task_options(*entry.options);
    request.velocity = document.velocity();
    request.volume = engine_volume();
    request.provisional = document.is_provisional(fault.record.id);
    request.urgent = urgent;
    request.stored = is_file || (stored && !request.provisional);  // a file's triangles are as they are
    worker->ask(std::move(request));
  }

  // Its checksum; nothing without an engine.
  std::optional<std::string> engine_volume() const {
    if (engine == nullptr) return std::nullopt;
    const auto found = std::ranges::find(document.volumes(), engine->volume(), &project::VolumeRecord::id);
    return found == document.volumes().end() ? std::nullopt : std::optional(found->checksum);
  }

  bool is_surface_file(const Fault& fault) const {
    if (!fault.pillars.empty()) return false;
    try {
      return document.project().surface_of(fault.record.id).has_value();
    } catch (const Error& error) {
      Q_EMIT document.failed(QString::fromStdString(error.message()), QString::fromStdString(error.hint()));
      return false;
    }
  }

  void take(MadeSurface made) {
    const auto found = entries.find(made.fault);
    const Fault* fault = document.fault(made.fault);
    if (found == entries.end() || fault == nullptr) return;
    Entry& entry = found->second;
    if (made.number <= entry.made) return;
    entry.made = made.number;
    entry.problem = QString::fromStdString(made.problem);
    if (!entry.options) entry.options = pillar_options(made.options);
    if (made.surface != nullptr && (entry.chart.empty() || !made.surface->provisional))
      entry.chart = made.chart;
    if (made.kept) Q_EMIT document.meshes_changed({made.fault});
    // While a hand is on it, the last surface stays where the pillars cannot make one for a moment.
    const bool keeps_last = made.surface == nullptr && document.is_provisional(made.fault);
    if (!keeps_last) set_surface(entry, made.surface);
    if (made.run && entry.surface != nullptr && std::exchange(entry.wants_run, false))
      take_run(*made.run, entry);
    Q_EMIT self.surfaces_changed({made.fault});
  }

  void set_surface(Entry& entry, std::shared_ptr<const FaultSurface> surface) {
    const Id fault = surface != nullptr         ? surface->fault
                     : entry.surface != nullptr ? entry.surface->fault
                                                : 0;
    const bool turned =
        surface != nullptr && entry.surface != nullptr && surface->side != entry.surface->side;
    entry.surface = std::move(surface);
    entry.values.set_surface(entry.surface);
    if (turned) entry.values.mark_stale("offset");
    entry.numbers.clear();
    entry.values.scale("offset", "offset_voxels", "metres_along_normal");
    if (engine == nullptr || fault == 0) return;
    if (entry.surface != nullptr) {
      entry.edit = engine->put_fault(entry.surface);
    } else {
      engine->remove_fault(fault);
      entry.edit = 0;
    }
  }

  // ---- numbers ----

  void take_run(const project::FaultRun& run, Entry& entry) {
    entry.values.set(run.panels, run.numbers, run.lattice, run.statistics);
    entry.values.scale("offset", "offset_voxels", "metres_along_normal");
    entry.numbers.clear();
  }

  void take_answer(const EngineNumbers& answer) {
    std::map<Id, std::vector<std::size_t>> rows;
    for (std::size_t n = 0; n < answer.faults.size(); ++n) rows[answer.faults[n]].push_back(n);
    std::set<Id> changed;
    for (const auto& [fault, of_fault] : rows) {
      changed.insert(fault);
      const auto found = entries.find(fault);
      const auto computed_on = answer.computed_on.find(fault);
      if (found == entries.end() || computed_on == answer.computed_on.end() || computed_on->second == nullptr)
        continue;
      found->second.values.take(answer.panels, answer.face_numbers, answer.statistics, of_fault,
                                *computed_on->second);
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

  bool document_is_provisional() const {
    return std::ranges::any_of(entries,
                               [this](const auto& entry) { return document.is_provisional(entry.first); });
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
      ask(*fault, entries[id], true, false);
    }
  }

  void start_over() {
    try {
      start_worker();
      statistics = tasks::known_statistics(document.project());
    } catch (const Error& error) {
      Q_EMIT document.failed(QString::fromStdString(error.message()), QString::fromStdString(error.hint()));
    }
    entries.clear();
    kept_range.reset();
    volume = engine_volume();
    for (const Fault& fault : document.faults()) {
      entries[fault.record.id].wants_run = true;
      ask(fault, entries[fault.record.id], false, true);
    }
  }

  // A run that was added is shown where the engine has said nothing newer.
  void runs_changed() {
    statistics = tasks::known_statistics(document.project());
    for (const Fault& fault : document.faults()) {
      const auto found = entries.find(fault.record.id);
      if (found == entries.end() || found->second.surface == nullptr) continue;
      Entry& entry = found->second;
      if (entry.values.is_known("count") && !entry.values.any_stale("count")) continue;
      entry.wants_run = true;
      ask(fault, entry, false, true);
    }
  }

  void volume_changed() {
    const auto former = std::exchange(volume, engine_volume());
    if (former == volume) return;  // two rows may be of the same samples
    std::set<Id> faults;
    for (auto& [id, entry] : entries) {
      const Fault* fault = document.fault(id);
      if (fault == nullptr) continue;
      entry.values.mark_all_stale();
      entry.numbers.clear();
      entry.wants_run = true;
      ask(*fault, entry, false, true);
      faults.insert(id);
    }
    kept_range.reset();
    Q_EMIT self.numbers_changed(faults);
  }

  // Another velocity: what is known of the faces stays, areas and dips follow.
  void survey_changed() {
    if (worker == nullptr) return start_over();
    kept_range.reset();
    for (const Fault& fault : document.faults()) ask(fault, entries[fault.record.id], false, true);
  }
};

Surfaces::Surfaces(Document& document, EngineLink* engine, QObject* parent)
    : QObject(parent), state_(std::make_unique<State>(*this, document, engine)) {
  connect(&document, &Document::shapes_changed, this,
          [this](const std::set<Id>& faults) { state_->shapes_changed(faults); });
  connect(&document, &Document::survey_changed, this, [this] { state_->survey_changed(); });
  connect(&document, &Document::runs_changed, this, [this] { state_->runs_changed(); });
  if (engine != nullptr) {
    connect(engine, &EngineLink::numbers, this,
            [this](const EngineNumbers& answer) { state_->take_answer(answer); });
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
  const bool engine_runs =
      state_->engine != nullptr && (state_->engine->state() == EngineLink::State::kReady ||
                                    state_->engine->state() == EngineLink::State::kBusy);
  return (follows || comes_late(statistic)) && engine_runs ? Freshness::kFollowing : Freshness::kStale;
}

const std::vector<project::StatisticRecord>& Surfaces::statistics() const {
  return state_->statistics;
}

std::optional<std::pair<double, double>> Surfaces::range(const std::set<Id>& faults,
                                                         const QString& statistic) const {
  auto& kept = state_->kept_range;
  if (kept && kept->faults == faults && kept->statistic == statistic) return kept->range;
  std::vector<std::shared_ptr<const FaceNumbers>> known;
  for (const Id fault : faults) {
    if (auto of_fault = numbers(fault, statistic)) known.push_back(std::move(of_fault));
  }
  kept = {faults, statistic, range_of(known, statistic)};
  return kept->range;
}

std::optional<std::pair<double, double>> Surfaces::range_of(
    std::span<const std::shared_ptr<const FaceNumbers>> numbers, const QString& statistic) const {
  std::vector<double> values;
  for (const auto& known : numbers) {
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
  return range ? std::optional(std::pair(range->lo, range->hi)) : std::nullopt;
}

pillars::Options Surfaces::options(Id fault) const {
  const auto found = state_->entries.find(fault);
  return found == state_->entries.end() ? pillars::Options{}
                                        : found->second.options.value_or(pillars::Options{});
}

void Surfaces::set_options(Id id, const pillars::Options& options) {
  const Fault* fault = state_->document.fault(id);
  if (fault == nullptr) return;
  State::Entry& entry = state_->entries[id];
  entry.options = options;
  state_->ask(*fault, entry, true, false);
}

bool Surfaces::is_settled() const {
  const bool engine_answers = state_->engine != nullptr &&
                              state_->engine->state() != EngineLink::State::kOff &&
                              state_->engine->state() != EngineLink::State::kLost;
  return std::ranges::all_of(state_->entries, [&](const auto& entry) {
    const bool answered = !engine_answers || entry.second.edit <= state_->engine->answered();
    return entry.second.asked == entry.second.made && answered;
  });
}

std::optional<LiveRun> Surfaces::live_run() const {
  const Document& document = state_->document;
  if (state_->engine == nullptr) return std::nullopt;
  const Id volume_id = state_->engine->volume();
  const auto volume = std::ranges::find(document.volumes(), volume_id, &project::VolumeRecord::id);
  if (volume == document.volumes().end()) return std::nullopt;
  LiveRun live;
  live.run.name = "live";
  live.run.live = true;
  live.run.volume = volume->name;
  live.run.volume_checksum = volume->checksum;
  live.run.parameters = R"({"strategy":"live"})";
  for (const auto& [id, entry] : state_->entries) {
    const Fault* fault = document.fault(id);
    if (fault == nullptr || entry.surface == nullptr || entry.surface->provisional) continue;
    if (!entry.values.is_known("count") || entry.values.any_stale("count")) continue;
    project::FaultRun& one = live.faults.emplace_back();
    one.fault = id;
    one.fault_name = fault->record.name;
    one.revision = entry.surface->revision;
    one.lattice = entry.surface->lattice;
    for (const project::MeshFace& face : entry.surface->faces) {
      one.panels.push_back(face.panel);
      one.numbers.push_back(face.n);
    }
    for (const project::StatisticRecord& statistic : state_->statistics) {
      const std::vector<double>* values = entry.values.find(statistic.name);
      if (values != nullptr && !entry.values.any_stale(statistic.name))
        one.statistics[statistic.name] = *values;
    }
  }
  return live.faults.empty() ? std::nullopt : std::optional(std::move(live));
}

void Surfaces::store_live_run() {
  if (const auto live = live_run()) store(state_->document.store(), *live);
}

void store(project::Project& project, const LiveRun& live) {
  project.register_statistics(tasks::stored_statistics());
  project.add_run(live.run, live.faults);
}

}  // namespace footwall::ui
