#include "ui/model/face_voxels.h"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "storage/base/error.h"
#include "storage/base/hash.h"
#include "ui/model/section_source.h"

namespace footwall::ui {
namespace {

constexpr std::size_t kBrickBytes = VoxelBricks::kSamples * sizeof(float);

// What the reading thread must know of the volume, since it may not ask the project.
struct Source {
  Id volume = 0;
  std::string name;
  std::filesystem::path path;
  std::string checksum;
  survey::Index origin{};
  survey::Geometry survey;
  friend bool operator==(const Source&, const Source&) = default;
};

}  // namespace

struct FaceVoxels::State {
  struct Wanted {
    std::shared_ptr<const FaultSurface> surface;
    bool is_there = false;
  };

  State(FaceVoxels& of, Document& project) : owner(of), document(project) {}

  FaceVoxels& owner;
  Document& document;

  // The window's thread.
  std::map<Id, std::shared_ptr<const VoxelBricks>> known;
  std::optional<SectionReader::VolumeFacts> facts;

  // Under the mutex.
  std::mutex mutex;
  std::condition_variable wake;
  bool stopping = false;
  std::uint64_t round = 0;  // another one for another volume
  std::optional<Source> source;
  std::map<Id, Wanted> wanted;
  std::map<Id, std::shared_ptr<const VoxelBricks>> read_before;
  std::size_t most = 1;  // bricks of a fault
  int on_their_way = 0;  // bricks that were read and not yet taken

  // The reading thread.
  std::unique_ptr<volume::VolumeReader> reader;
  std::uint64_t reader_round = 0;

  std::thread thread;

  std::optional<Source> source_of(Id volume) const;
  void run();
  void open(const Source& from, std::uint64_t of_round);
  void take(std::uint64_t of_round, Id fault, std::shared_ptr<const VoxelBricks> bricks);
  void give_up(std::uint64_t of_round, const QString& message, const QString& hint);
};

std::optional<Source> FaceVoxels::State::source_of(Id volume) const {
  const auto& volumes = document.volumes();
  const auto found = std::ranges::find(volumes, volume, &project::VolumeRecord::id);
  if (found == volumes.end() || !document.survey()) return {};
  return Source{.volume = volume,
                .name = found->name,
                .path = document.project().volume_path(*found),
                .checksum = found->checksum,
                .origin = found->origin,
                .survey = *document.survey()};
}

void FaceVoxels::State::open(const Source& from, std::uint64_t of_round) {
  if (reader != nullptr && reader_round == of_round) return;
  reader.reset();
  auto opened = std::make_unique<volume::VolumeReader>(from.path);
  if (!from.checksum.empty() && to_hex(opened->info().checksum) != from.checksum) {
    throw Error(ErrorCode::kCorrupt,
                from.path.string() + " is not the file that the project knows as " + from.name,
                "bring the right file back, or point the project to it with relink");
  }
  SectionReader::VolumeFacts now = facts_of(opened->info().statistics);
  QMetaObject::invokeMethod(
      &owner,
      [this, of_round, now = std::move(now)] {
        {
          const std::scoped_lock lock(mutex);
          if (of_round != round) return;
        }
        facts = now;
      },
      Qt::QueuedConnection);
  reader = std::move(opened);
  reader_round = of_round;
}

void FaceVoxels::State::take(std::uint64_t of_round, Id fault, std::shared_ptr<const VoxelBricks> bricks) {
  {
    const std::scoped_lock lock(mutex);
    --on_their_way;
    if (of_round != round || !wanted.contains(fault)) return;
  }
  known[fault] = std::move(bricks);
  Q_EMIT owner.changed({fault});
}

void FaceVoxels::State::give_up(std::uint64_t of_round, const QString& message, const QString& hint) {
  QMetaObject::invokeMethod(
      &owner,
      [this, of_round, message, hint] {
        {
          const std::scoped_lock lock(mutex);
          if (of_round != round) return;
        }
        Q_EMIT owner.failed(message, hint);
      },
      Qt::QueuedConnection);
}

void FaceVoxels::State::run() {
  std::unique_lock lock(mutex);
  const auto next = [this] {
    return std::ranges::find_if(wanted, [](const auto& entry) { return !entry.second.is_there; });
  };
  for (;;) {
    wake.wait(lock, [&] { return stopping || (source && next() != wanted.end()); });
    if (stopping) return;
    const Id fault = next()->first;
    const std::shared_ptr<const FaultSurface> surface = next()->second.surface;
    const Source from = *source;
    const std::uint64_t of_round = round;
    const std::shared_ptr<const VoxelBricks> before = read_before[fault];
    const std::size_t room = most;
    lock.unlock();
    std::optional<VoxelBricks> bricks;
    bool failed = false;
    const auto outdated = [&] {
      const std::scoped_lock look(mutex);
      const auto now = wanted.find(fault);
      return stopping || round != of_round || now == wanted.end() || now->second.surface != surface;
    };
    try {
      open(from, of_round);
      bricks =
          read_bricks(*reader, from.volume, from.origin, from.survey, *surface, room, before.get(), outdated);
    } catch (const Error& error) {
      failed = true;
      give_up(of_round, QString::fromStdString(error.message()), QString::fromStdString(error.hint()));
    } catch (const std::exception& error) {
      failed = true;
      give_up(of_round, QString::fromUtf8(error.what()), {});
    }
    lock.lock();
    if (round != of_round) continue;
    if (failed) {  // one message, not one for each fault
      for (auto& [id, one] : wanted) one.is_there = true;
      continue;
    }
    const auto now = wanted.find(fault);
    if (!bricks || now == wanted.end()) continue;
    now->second.is_there = now->second.surface == surface;
    auto made = std::make_shared<const VoxelBricks>(std::move(*bricks));
    read_before[fault] = made;
    ++on_their_way;
    QMetaObject::invokeMethod(
        &owner, [this, of_round, fault, made = std::move(made)] { take(of_round, fault, made); },
        Qt::QueuedConnection);
  }
}

FaceVoxels::FaceVoxels(Document& document, QObject* parent)
    : QObject(parent), state_(std::make_unique<State>(*this, document)) {
  state_->thread = std::thread([this] { state_->run(); });
}

FaceVoxels::~FaceVoxels() {
  {
    const std::scoped_lock lock(state_->mutex);
    state_->stopping = true;
  }
  state_->wake.notify_one();
  state_->thread.join();
}

void FaceVoxels::want(Id volume, const std::vector<std::shared_ptr<const FaultSurface>>& surfaces) {
  const std::optional<Source> source = state_->source_of(volume);
  std::set<Id> gone;
  {
    const std::scoped_lock lock(state_->mutex);
    if (source != state_->source) {
      state_->source = source;
      ++state_->round;
      state_->wanted.clear();
      state_->read_before.clear();
      state_->facts.reset();
      for (const auto& [fault, bricks] : std::exchange(state_->known, {})) gone.insert(fault);
    }
    std::set<Id> here;
    for (const auto& surface : source ? surfaces : std::vector<std::shared_ptr<const FaultSurface>>()) {
      here.insert(surface->fault);
      State::Wanted& one = state_->wanted[surface->fault];
      if (std::exchange(one.surface, surface) != surface) one.is_there = false;
    }
    std::erase_if(state_->wanted, [&](const auto& entry) { return !here.contains(entry.first); });
    std::erase_if(state_->read_before, [&](const auto& entry) { return !here.contains(entry.first); });
    std::erase_if(state_->known, [&](const auto& entry) {
      if (!here.contains(entry.first)) gone.insert(entry.first);
      return !here.contains(entry.first);
    });
    const std::size_t share = kMostBytes / std::max<std::size_t>(1, here.size());
    const std::size_t most = std::max<std::size_t>(1, std::min(share, kMostBytesOfOne) / kBrickBytes);
    // Another share is of all faults: a smaller one so that their sum stays bounded, a larger one to see
    // more.
    for (auto& [fault, one] : state_->wanted) {
      const auto before = state_->read_before.find(fault);
      if (most == state_->most || before == state_->read_before.end() || before->second == nullptr) continue;
      if (before->second->count() > most || (most > state_->most && before->second->step > 1))
        one.is_there = false;
    }
    state_->most = most;
  }
  state_->wake.notify_one();
  if (!gone.empty()) Q_EMIT changed(gone);
}

std::shared_ptr<const VoxelBricks> FaceVoxels::bricks(Id fault) const {
  const auto found = state_->known.find(fault);
  return found == state_->known.end() ? nullptr : found->second;
}

const SectionReader::VolumeFacts* FaceVoxels::facts() const {
  return state_->facts ? &*state_->facts : nullptr;
}

bool FaceVoxels::is_settled() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->on_their_way == 0 &&
         std::ranges::all_of(state_->wanted, [](const auto& entry) { return entry.second.is_there; });
}

}  // namespace footwall::ui
