#include "ui/model/section_reader.h"

#include <QPointer>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <exception>
#include <map>
#include <mutex>
#include <thread>
#include <tuple>
#include <utility>

#include "storage/base/hash.h"
#include "storage/base/usable_memory.h"
#include "ui/model/section_source.h"

namespace footwall::ui {
namespace {

constexpr std::size_t kSectionBytes = std::size_t{128} << 20;
constexpr int kAhead = 2;  // sections

// A sixteenth of the memory: the chunks that a section and its neighbours pass through, where the survey is
// not huge.
std::size_t chunk_bytes() {
  constexpr std::int64_t kLeast = std::int64_t{256} << 20;
  constexpr std::int64_t kMost = std::int64_t{4} << 30;
  return static_cast<std::size_t>(std::clamp(usable_memory().bytes / 16, kLeast, kMost));
}

using SectionKey = std::tuple<Id, int, std::int64_t, double, double, double, double>;

SectionKey key_of(Id volume, const Section& s) {
  const bool line = s.kind == Section::Kind::kLine;
  if (!line) return {volume, static_cast<int>(s.kind), s.index, 0, 0, 0, 0};
  return {volume, static_cast<int>(s.kind), 0, s.from.i, s.from.j, s.to.i, s.to.j};
}

bool is_finite(const Section& s) {
  return std::isfinite(s.from.i) && std::isfinite(s.from.j) && std::isfinite(s.to.i) && std::isfinite(s.to.j);
}

// What the reading thread must know of a volume, since it may not ask the project.
struct Volume {
  std::string name;
  std::filesystem::path path;
  std::string checksum;
  survey::Index origin{};
  std::uint64_t number = 0;  // a new one when any of the others, or the survey, changed
};

}  // namespace

struct SectionReader::State {
  struct Request {
    const QObject* asker = nullptr;  // compared alone
    QPointer<QObject> alive;         // looked at in the window's thread alone
    Id volume = 0;
    Section section;
  };
  struct Opened {
    std::uint64_t number = 0;
    std::unique_ptr<SectionSource> source;
  };

  State(SectionReader& reader, Document& of) : owner(reader), document(of) {}

  SectionReader& owner;
  Document& document;

  // Under the mutex; the map of facts loses entries in the window's thread alone, so that pointers into it
  // hold there.
  mutable std::mutex mutex;
  std::condition_variable wake;
  bool stopping = false;
  std::optional<survey::Geometry> survey;
  std::map<Id, Volume> volumes;
  std::uint64_t last_number = 0;
  std::deque<Request> waiting;
  std::deque<Request> ahead;
  std::optional<Request> under_way;
  Lru<SectionKey, SectionSamples> sections{kSectionBytes};
  std::map<Id, VolumeFacts> facts;

  // The window's thread.
  std::map<const QObject*, std::pair<Id, Section>> last_asked;

  // The reading thread.
  ChunkCache chunks{chunk_bytes()};
  std::map<Id, Opened> opened;

  std::thread thread;

  void take_volumes();
  void plan_ahead(const Request& request);
  void run();
  bool is_outdated(const Request& request, bool wanted) const;
  SectionSource& source_of(Id volume, const Volume& facts_of_volume);
  void answer(const Request& request, std::shared_ptr<const SectionSamples> samples);
  void answer_failure(const Request& request, const QString& message, const QString& hint);
  void serve(const Request& request, bool wanted);
};

void SectionReader::State::take_volumes() {
  const std::scoped_lock lock(mutex);
  const bool other_survey = survey != document.survey();
  survey = document.survey();
  std::map<Id, Volume> now;
  for (const project::VolumeRecord& record : document.volumes()) {
    Volume volume{.name = record.name,
                  .path = document.project().volume_path(record),
                  .checksum = record.checksum,
                  .origin = record.origin};
    const auto known = volumes.find(record.id);
    const bool same = !other_survey && known != volumes.end() && known->second.path == volume.path &&
                      known->second.checksum == volume.checksum && known->second.origin == volume.origin;
    volume.number = same ? known->second.number : ++last_number;
    if (!same) facts.erase(record.id);
    now.emplace(record.id, std::move(volume));
  }
  const auto differs = [&](Id id) {
    const auto before = volumes.find(id);
    const auto after = now.find(id);
    return before == volumes.end() || after == now.end() || before->second.number != after->second.number;
  };
  sections.drop_if([&](const SectionKey& key) { return differs(std::get<0>(key)); });
  std::erase_if(facts, [&](const auto& entry) { return !now.contains(entry.first); });
  volumes = std::move(now);
  ahead.clear();
}

// The neighbours that the asker's last step leads to next. The mutex is held.
void SectionReader::State::plan_ahead(const Request& request) {
  const auto last = last_asked.find(request.asker);
  ahead.clear();
  if (last != last_asked.end() && survey && request.section.kind != Section::Kind::kLine &&
      last->second.first == request.volume && last->second.second.kind == request.section.kind) {
    const std::int64_t step = request.section.index - last->second.second.index;
    for (int n = 1; n <= kAhead && step != 0; ++n) {
      Request next = request;
      next.section.index += n * step;
      if (next.section != stepped(next.section, 0, *survey)) break;
      if (!sections.contains(key_of(next.volume, next.section))) ahead.push_back(std::move(next));
    }
  }
}

bool SectionReader::State::is_outdated(const Request& request, bool wanted) const {
  const std::scoped_lock lock(mutex);
  if (stopping) return true;
  if (!wanted) return !waiting.empty();
  return std::ranges::find(waiting, request.asker, &Request::asker) != waiting.end();
}

SectionSource& SectionReader::State::source_of(Id id, const Volume& volume) {
  Opened& one = opened[id];
  if (one.source == nullptr || one.number != volume.number) {
    one.source.reset();
    chunks.drop_if([&](const auto& key) { return key.first == one.number; });
    one.source = std::make_unique<SectionSource>(volume.path, volume.number, volume.origin, chunks);
    one.number = volume.number;
    if (!volume.checksum.empty() && to_hex(one.source->info().checksum) != volume.checksum) {
      one.source.reset();
      throw Error(ErrorCode::kCorrupt,
                  volume.path.string() + " is not the file that the project knows as " + volume.name,
                  "bring the right file back, or point the project to it with relink");
    }
    VolumeFacts known = facts_of(one.source->info().statistics);
    const std::scoped_lock lock(mutex);
    const auto current = volumes.find(id);
    if (current != volumes.end() && current->second.number == volume.number)
      facts.emplace(id, std::move(known));
  }
  return *one.source;
}

void SectionReader::State::answer(const Request& request, std::shared_ptr<const SectionSamples> samples) {
  QMetaObject::invokeMethod(
      &owner,
      [this, asker = request.alive, samples = std::move(samples)] {
        if (asker) Q_EMIT owner.ready(asker, samples);
      },
      Qt::QueuedConnection);
}

void SectionReader::State::answer_failure(const Request& request, const QString& message,
                                          const QString& hint) {
  QMetaObject::invokeMethod(
      &owner,
      [this, request, message, hint] {
        // What was asked for before is of no interest any more.
        const auto last = last_asked.find(request.asker);
        const bool is_newest =
            last != last_asked.end() && last->second == std::pair(request.volume, request.section);
        if (request.alive && is_newest) Q_EMIT owner.failed(request.alive, message, hint);
      },
      Qt::QueuedConnection);
}

// One request, without the mutex.
void SectionReader::State::serve(const Request& request, bool wanted) {
  Volume volume;
  survey::Geometry geometry;
  {
    const std::scoped_lock lock(mutex);
    const auto found = volumes.find(request.volume);
    if (found == volumes.end() || !survey) {
      if (wanted) answer_failure(request, tr("The project has no such volume."), tr("Choose another one."));
      return;
    }
    volume = found->second;
    geometry = *survey;
    std::erase_if(opened, [&](const auto& entry) { return !volumes.contains(entry.first); });
    if (auto kept = sections.find(key_of(request.volume, request.section))) {
      if (wanted) answer(request, std::move(kept));
      return;
    }
  }
  auto read = source_of(request.volume, volume).read(request.volume, request.section, geometry, [&] {
    return is_outdated(request, wanted);
  });
  const std::scoped_lock lock(mutex);
  if (!read) {
    // Told to stop for a newer request that was taken back since: then this one is the newest again.
    const bool lost =
        wanted && !stopping && std::ranges::find(waiting, request.asker, &Request::asker) == waiting.end();
    if (lost) waiting.push_back(request);
    return;
  }
  auto samples = std::make_shared<const SectionSamples>(std::move(*read));
  const auto current = volumes.find(request.volume);
  if (current == volumes.end() || current->second.number != volume.number) {
    if (wanted && std::ranges::find(waiting, request.asker, &Request::asker) == waiting.end())
      waiting.push_back(request);
    return;
  }
  sections.add(key_of(request.volume, request.section), samples, samples->values.size() * sizeof(float));
  if (wanted) answer(request, std::move(samples));
}

void SectionReader::State::run() {
  std::unique_lock lock(mutex);
  for (;;) {
    wake.wait(lock, [this] { return stopping || !waiting.empty() || !ahead.empty(); });
    if (stopping) return;
    const bool wanted = !waiting.empty();
    std::deque<Request>& from = wanted ? waiting : ahead;
    const Request request = std::move(from.front());
    from.pop_front();
    if (wanted) under_way = request;
    lock.unlock();
    // What was not asked for yet fails when it is.
    try {
      serve(request, wanted);
    } catch (const Error& error) {
      if (wanted)
        answer_failure(request, QString::fromStdString(error.message()),
                       QString::fromStdString(error.hint()));
    } catch (const std::exception& error) {
      if (wanted) answer_failure(request, QString::fromUtf8(error.what()), {});
    }
    lock.lock();
    under_way.reset();
  }
}

SectionReader::SectionReader(Document& document, QObject* parent)
    : QObject(parent), state_(std::make_unique<State>(*this, document)) {
  state_->take_volumes();
  connect(&document, &Document::volumes_changed, this, [this] { state_->take_volumes(); });
  connect(&document, &Document::survey_changed, this, [this] { state_->take_volumes(); });
  state_->thread = std::thread([this] { state_->run(); });
}

SectionReader::~SectionReader() {
  {
    const std::scoped_lock lock(state_->mutex);
    state_->stopping = true;
  }
  state_->wake.notify_one();
  state_->thread.join();
}

void SectionReader::ask(QObject* asker, Id volume, const Section& section) {
  if (!is_finite(section)) {
    Q_EMIT failed(asker, tr("The line has no end."), tr("Draw one within the survey."));
    return;
  }
  if (!state_->last_asked.contains(asker)) {
    connect(asker, &QObject::destroyed, this, [this](QObject* gone) { state_->last_asked.erase(gone); });
  }
  const State::Request request{asker, asker, volume, section};
  std::shared_ptr<const SectionSamples> kept;
  {
    const std::scoped_lock lock(state_->mutex);
    kept = state_->sections.find(key_of(volume, section));
    state_->plan_ahead(request);
    const auto waits = std::ranges::find(state_->waiting, asker, &State::Request::asker);
    const bool is_read = state_->under_way && state_->under_way->asker == asker &&
                         state_->under_way->volume == volume && state_->under_way->section == section;
    if (kept || is_read) {
      if (waits != state_->waiting.end()) state_->waiting.erase(waits);
    } else if (waits != state_->waiting.end()) {
      *waits = request;
    } else {
      state_->waiting.push_back(request);
    }
  }
  state_->last_asked[asker] = {volume, section};
  state_->wake.notify_one();
  if (kept) Q_EMIT ready(asker, kept);
}

std::shared_ptr<const SectionSamples> SectionReader::kept(Id volume, const Section& section) const {
  if (!is_finite(section)) return nullptr;
  const std::scoped_lock lock(state_->mutex);
  return state_->sections.find(key_of(volume, section));
}

const SectionReader::VolumeFacts* SectionReader::facts(Id volume) const {
  const std::scoped_lock lock(state_->mutex);
  const auto found = state_->facts.find(volume);
  return found == state_->facts.end() ? nullptr : &found->second;
}

}  // namespace footwall::ui
