#include "ui/model/shown_numbers.h"

#include <QCoreApplication>
#include <QDateTime>
#include <algorithm>
#include <cmath>
#include <vector>

namespace footwall::ui {
namespace {

QString time_of(const project::RunRecord& run) {
  return QDateTime::fromString(QString::fromStdString(run.when), Qt::ISODate)
      .toLocalTime()
      .toString(QStringLiteral("yyyy-MM-dd HH:mm"));
}

}  // namespace

QString name_of(const project::RunRecord& run) {
  if (!run.name.empty()) return QString::fromStdString(run.name);
  return run.live ? QCoreApplication::translate("Runs", "live")
                  : QCoreApplication::translate("Runs", "run %1").arg(run.id);
}

QString words_for(const project::RunRecord& run) {
  QString name = name_of(run);
  // As runs are called that got no name.
  if (name.startsWith(QLatin1String("run "))) return name;
  return QCoreApplication::translate("Runs", "run %1").arg(name);
}

ShownNumbers::ShownNumbers(Document& document, Display& display, const Surfaces& surfaces, QObject* parent)
    : QObject(parent), document_(document), display_(display), surfaces_(surfaces) {
  connect(&display, &Display::faces_changed, this, &ShownNumbers::follow_display);
  connect(&surfaces, &Surfaces::surfaces_changed, this, [this](const std::set<Id>& faults) {
    // While a hand is on it the colours keep their meaning.
    if (std::ranges::none_of(faults, [this](Id fault) { return document_.is_provisional(fault); }))
      kept_range_.reset();
  });
  connect(&document, &Document::runs_changed, this, &ShownNumbers::follow_name);
  follow_display();
}

ShownNumbers::~ShownNumbers() {
  reader_.reset();  // it calls this
}

void ShownNumbers::follow_display() {
  const Id wanted = display_.faces().run;
  if (wanted == (run_ ? run_->id : 0)) return;
  entries_.clear();
  kept_range_.reset();
  run_.reset();
  reading_ = false;
  if (reader_ != nullptr) reader_->stop();
  try {
    if (wanted != 0) {
      run_ = document_.project().run(wanted);
      start_reading();
    }
  } catch (const Error& error) {
    give_up(error);
  }
  Q_EMIT run_changed();
}

void ShownNumbers::follow_name() {
  if (!run_) return;
  try {
    const auto runs = document_.project().runs();
    const auto now = std::ranges::find(runs, run_->id, &project::RunRecord::id);
    if (now == runs.end() || now->name == run_->name) return;
    run_->name = now->name;
  } catch (const Error& error) {
    return give_up(error);
  }
  Q_EMIT run_changed();
}

// Half a run would be taken for the whole.
void ShownNumbers::give_up(const Error& error) {
  entries_.clear();
  kept_range_.reset();
  run_.reset();
  reading_ = false;
  Q_EMIT document_.failed(QString::fromStdString(error.message()), QString::fromStdString(error.hint()));
  display_.show_run(0);
}

void ShownNumbers::start_reading() {
  if (reader_ == nullptr) {
    RunReader::Events events;
    events.came = [this](std::uint64_t request, std::shared_ptr<const FaultOfRun> fault) {
      QMetaObject::invokeMethod(
          this, [this, request, fault = std::move(fault)] { came(request, fault); }, Qt::QueuedConnection);
    };
    events.ended = [this](std::uint64_t request, const std::optional<Error>& failure) {
      QMetaObject::invokeMethod(
          this, [this, request, failure] { ended(request, failure); }, Qt::QueuedConnection);
    };
    reader_ = std::make_unique<RunReader>(document_.project().beside(), std::move(events));
  }
  request_ = reader_->read(run_->id);
  reading_ = true;
}

void ShownNumbers::came(std::uint64_t request, const std::shared_ptr<const FaultOfRun>& fault) {
  if (!run_ || request != request_) return;
  const Id id = fault->numbers.fault;
  entries_[id] = {.run = fault, .surface = nullptr, .values = {}, .numbers = {}};
  kept_range_.reset();
  Q_EMIT numbers_changed({id});
}

void ShownNumbers::ended(std::uint64_t request, const std::optional<Error>& failure) {
  if (!run_ || request != request_) return;
  reading_ = false;
  if (!failure) {
    Q_EMIT numbers_changed({});
  } else if (failure->code() == ErrorCode::kNotFound) {
    display_.show_run(0);  // it has been deleted meanwhile
  } else {
    give_up(*failure);
    Q_EMIT run_changed();
  }
}

bool ShownNumbers::is_of_run(const QString& statistic) const {
  // All surfaces have the same statistics of their own.
  const auto& faults = document_.faults();
  const auto any = std::ranges::find_if(
      faults, [this](const Fault& fault) { return surfaces_.surface(fault.record.id) != nullptr; });
  return run_ && (any == faults.end() || is_of_run(any->record.id, statistic));
}

bool ShownNumbers::is_of_run(Id fault, const QString& statistic) const {
  if (!run_) return false;
  const auto surface = surfaces_.surface(fault);
  return surface == nullptr || !surface->geometry.contains(statistic.toStdString());
}

QStringList ShownNumbers::origin() const {
  if (!run_) return {};
  QStringList lines{words_for(*run_), time_of(*run_)};
  const auto& volumes = document_.volumes();
  const auto shown = std::ranges::find(volumes, display_.volume(), &project::VolumeRecord::id);
  if (shown == volumes.end() || shown->checksum != run_->volume_checksum)
    lines.append(tr("of %1").arg(QString::fromStdString(run_->volume)));
  return lines;
}

ShownNumbers::Entry* ShownNumbers::placed(Id fault) const {
  const auto found = entries_.find(fault);
  const auto surface = surfaces_.surface(fault);
  if (found == entries_.end() || surface == nullptr) return nullptr;
  Entry& entry = found->second;
  if (entry.surface == surface) return &entry;
  // From the run anew: a face that comes back to where it stood is of the run again.
  entry.surface = surface;
  entry.numbers.clear();
  entry.values = {};
  entry.values.set_surface(surface);
  return &entry;
}

// Column by column, since most of them nobody looks at.
void ShownNumbers::take(const std::string& statistic, Entry& entry) {
  const project::FaultRun& run = entry.run->numbers;
  std::map<std::string, std::vector<double>> columns;
  for (const std::string& name : {statistic, std::string("count")}) {
    const auto found = run.statistics.find(name);
    if (found != run.statistics.end() && !entry.values.is_known(name)) columns.insert(*found);
  }
  if (columns.empty()) return;
  entry.values.set(run.panels, run.numbers, run.lattice, columns);
  // An offset is along the normal, whose side is the whole surface's.
  if (entry.run->side != entry.surface->side) entry.values.mark_stale("offset");
}

std::shared_ptr<const FaceNumbers> ShownNumbers::numbers(Id fault, const QString& statistic) const {
  if (!is_of_run(fault, statistic)) return surfaces_.numbers(fault, statistic);
  Entry* entry = placed(fault);
  if (entry == nullptr) return nullptr;
  auto& kept = entry->numbers[statistic];
  if (kept != nullptr) return kept;
  take(statistic.toStdString(), *entry);
  const auto of_run = entry->values.numbers(statistic.toStdString());
  if (of_run == nullptr) return nullptr;
  auto numbers = std::make_shared<FaceNumbers>(*of_run);
  for (std::size_t f = 0; f < numbers->values.size(); ++f) {
    if (std::isnan(numbers->values[f])) numbers->stale[f] = 0;  // nothing that could be old
    if (numbers->stale[f] != 0) numbers->hatched[f] = 1;
  }
  return kept = numbers;
}

Freshness ShownNumbers::freshness(Id fault, const QString& statistic) const {
  if (!is_of_run(fault, statistic)) return surfaces_.freshness(fault, statistic);
  const auto known = numbers(fault, statistic);
  if (known == nullptr) return Freshness::kPlain;
  return std::ranges::count(known->stale, 1) == 0 ? Freshness::kKept : Freshness::kStale;
}

std::optional<std::pair<double, double>> ShownNumbers::range(const std::set<Id>& faults,
                                                             const QString& statistic) const {
  if (!is_of_run(statistic)) return surfaces_.range(faults, statistic);
  if (kept_range_ && kept_range_->faults == faults && kept_range_->statistic == statistic)
    return kept_range_->range;
  std::vector<std::shared_ptr<const FaceNumbers>> known;
  for (const Id fault : faults) {
    if (auto of_fault = numbers(fault, statistic)) known.push_back(std::move(of_fault));
  }
  kept_range_ = {faults, statistic, surfaces_.range_of(known, statistic)};
  return kept_range_->range;
}

}  // namespace footwall::ui
