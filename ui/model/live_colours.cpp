#include "ui/model/live_colours.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <string_view>
#include <utility>

#include "engine/service/client/engine_client.h"
#include "engine/service/client/local_engine.h"
#include "storage/base/error.h"
#include "ui/model/face_edits.h"

namespace footwall::ui {
namespace {

using namespace std::chrono_literals;

// Of one batch; the rest of many changed faults follows in the next ones.
constexpr std::size_t kFacesInBatch = 50000;
// How often an idle engine is asked whether it is still there.
constexpr auto kLook = 1s;

// A wait after the last change, so that offsets are not begun between two gestures.
constexpr auto kRest = 200ms;

// What faces are asked for while they move; offsets come by themselves.
constexpr std::array kLive{"count", "mean", "variance", "min", "max", "discontinuity", "contrast"};
constexpr std::array kWithOffset{"offset_voxels", "offset_score"};

template <class Names>
bool holds(const Names& names, std::string_view name) {
  return std::ranges::any_of(names, [&](const char* one) { return name == one; });
}

// Adds the numbers to those that are there already. The engine fills all columns, those that were not asked
// for with NaN: these are left out.
template <class Names>
void append(const v1::FaceNumbers& of, const Names& asked, EngineNumbers& to) {
  to.faults.insert(to.faults.end(), of.faces().faults().begin(), of.faces().faults().end());
  to.panels.insert(to.panels.end(), of.faces().owners().begin(), of.faces().owners().end());
  to.face_numbers.insert(to.face_numbers.end(), of.faces().numbers().begin(), of.faces().numbers().end());
  const auto take = [&](const char* name, const auto& column) {
    if (column.size() != of.faces().faults_size()) return;
    std::vector<double>& values = to.statistics[name];
    values.insert(values.end(), column.begin(), column.end());
  };
  const auto take_asked = [&](const char* name, const auto& column) {
    if (holds(asked, name)) take(name, column);
  };
  if (holds(asked, "count")) {
    take("nulls", of.nulls());
    take("outside", of.outside());
  }
  take_asked("count", of.count());
  take_asked("mean", of.mean());
  take_asked("variance", of.variance());
  take_asked("min", of.min());
  take_asked("max", of.max());
  take_asked("discontinuity", of.discontinuity());
  take_asked("contrast", of.contrast());
  take_asked("offset_voxels", of.offset_voxels());
  take_asked("offset_score", of.offset_score());
}

EngineNumbers plain(const v1::LiveReply& reply) {
  EngineNumbers numbers;
  numbers.edit = reply.edit();
  append(reply.numbers(), kLive, numbers);
  return numbers;
}

// Found from the back: the newest is asked for first.
void put_last(std::vector<Id>& faults, Id fault) {
  std::erase(faults, fault);
  faults.push_back(fault);
}

}  // namespace

// One stretch with one engine and one volume.
struct LiveColours::Session {
  std::map<Id, std::shared_ptr<const FaultSurface>> told;
  std::uint64_t sent = 0;      // the newest edit told
  std::uint64_t answered = 0;  // guarded by mutex_
  std::uint64_t engine_edit = 0;
  // Guarded by mutex_, by the engine's number of an edit: our number where it told all there was, and the
  // faults that it told.
  std::map<std::uint64_t, std::uint64_t> ours;
  std::map<std::uint64_t, std::map<Id, std::shared_ptr<const FaultSurface>>> batches;
  std::map<Id, std::shared_ptr<const FaultSurface>> known;  // of what was answered
};

LiveColours::LiveColours(std::optional<service::Connection> connection, int ranks, Events events)
    : given_(std::move(connection)), ranks_(ranks), events_(std::move(events)), thread_([this] { work(); }) {}

LiveColours::~LiveColours() {
  {
    const std::scoped_lock lock(mutex_);
    ends_ = true;
    job_.cancel();
    offsets_job_.cancel();
  }
  wake_.notify_all();
  thread_.join();
}

void LiveColours::start() {
  {
    const std::scoped_lock lock(mutex_);
    wanted_ = true;
  }
  wake_.notify_all();
}

void LiveColours::stop() {
  {
    const std::scoped_lock lock(mutex_);
    wanted_ = false;
    job_.cancel();
    offsets_job_.cancel();
  }
  wake_.notify_all();
}

void LiveColours::set_volume(const std::optional<EngineVolume>& volume) {
  {
    const std::scoped_lock lock(mutex_);
    volume_ = volume;
    offsets_job_.cancel();
  }
  wake_.notify_all();
}

std::uint64_t LiveColours::put(const std::shared_ptr<const FaultSurface>& surface) {
  std::uint64_t edit = 0;
  {
    const std::scoped_lock lock(mutex_);
    edit = ++edit_;
    surfaces_[surface->fault] = surface;
    dirty_.insert(surface->fault);
    put_last(offsets_due_, surface->fault);
    offsets_job_.cancel();
  }
  wake_.notify_all();
  return edit;
}

std::uint64_t LiveColours::remove(Id fault) {
  std::uint64_t edit = 0;
  {
    const std::scoped_lock lock(mutex_);
    surfaces_.erase(fault);
    dirty_.insert(fault);
    std::erase(offsets_due_, fault);
    offsets_job_.cancel();
    edit = ++edit_;
  }
  wake_.notify_all();
  return edit;
}

std::optional<service::Connection> LiveColours::connection() const {
  const std::scoped_lock lock(mutex_);
  return reached_;
}

void LiveColours::say(EngineLink::State state, const std::string& text) {
  events_.state(state, text);
}

void LiveColours::work() {
  std::unique_ptr<service::LocalEngine> local;
  for (;;) {
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [this] { return ends_ || wanted_; });
    if (ends_) return;
    job_ = JobContext();
    const JobContext job = job_;
    lock.unlock();
    bool served = false;
    const auto serve_with = [&](service::EngineClient& client, const service::Connection& connection) {
      const int ranks = client.status().ranks();
      {
        const std::scoped_lock guard(mutex_);
        reached_ = connection;
      }
      served = true;
      say(EngineLink::State::kReady, fmt::format("{} rank{}", ranks, ranks == 1 ? "" : "s"));
      try {
        serve(client);
      } catch (const Error& error) {
        forget_connection();
        // Dead, or so it seems: it is started again unless the local engine gives up.
        if (error.code() == ErrorCode::kEngine && !given_) say(EngineLink::State::kStarting);
        throw;
      }
    };
    try {
      say(EngineLink::State::kStarting);
      if (given_) {
        service::EngineClient client(*given_);
        serve_with(client, *given_);
      } else {
        session::LaunchOptions launch;
        launch.ranks = ranks_;
        if (local == nullptr)
          local = std::make_unique<service::LocalEngine>(launch, service::LocalEngine::Replay{});
        local->with_engine([&](service::EngineClient& client) { serve_with(client, local->connection()); },
                           job);
      }
      forget_connection();
      local.reset();
      say(EngineLink::State::kOff);
    } catch (const Error& error) {
      forget_connection();
      lock.lock();
      const bool told_to = ends_ || !wanted_;
      // LocalEngine starts one that died again, and gives up after three deaths in a minute. One that still
      // runs, but broke the connection, is asked once more.
      const bool again =
          !told_to && served && local != nullptr && local->is_running() && error.code() == ErrorCode::kEngine;
      if (!told_to && !again) wanted_ = false;
      lock.unlock();
      if (again) continue;
      local.reset();
      say(told_to ? EngineLink::State::kOff : EngineLink::State::kLost,
          told_to ? std::string() : error.message());
      if (!told_to) events_.failed(error.message(), error.hint());
    }
  }
}

void LiveColours::forget_connection() {
  const std::scoped_lock lock(mutex_);
  reached_.reset();
}

bool LiveColours::has_work() const {
  return !dirty_.empty();
}

bool LiveColours::may_ask_offsets(const Session& session) const {
  return !offsets_due_.empty() && !has_work() && session.answered >= session.sent &&
         std::ranges::none_of(surfaces_, [](const auto& entry) { return entry.second->provisional; });
}

void LiveColours::ask_offsets(service::EngineClient& client, const std::string& volume, Session& session,
                              std::unique_lock<std::mutex>& lock) {
  const Id fault = offsets_due_.back();
  const std::shared_ptr<const FaultSurface> surface = session.told[fault];
  if (surface == nullptr || surface->faces.empty()) {
    offsets_due_.pop_back();
    return;
  }
  offsets_job_ = JobContext();
  const JobContext job = offsets_job_;
  EngineNumbers numbers;
  numbers.edit = edit_;  // all of it has been told and answered
  numbers.computed_on[fault] = surface;
  lock.unlock();
  v1::ExtractRequest request;
  request.set_volume(volume);
  request.mutable_options()->add_compute("offset");
  for (const project::MeshFace& face : surface->faces) {
    request.mutable_only()->add_faults(fault);
    request.mutable_only()->add_owners(face.panel);
    request.mutable_only()->add_numbers(face.n);
  }
  bool done = false;
  try {
    client.extract(
        request, [&](const v1::FaceNumbers& piece) { append(piece, kWithOffset, numbers); }, job);
    done = true;
  } catch (const Error& error) {
    if (error.code() == ErrorCode::kEngine) throw;  // it is gone
    if (error.code() != ErrorCode::kCancelled) {
      events_.failed(error.message(), error.hint());
      done = true;  // not again before it changes
    }
  }
  lock.lock();
  // Where it changed meanwhile it waits again, and this is of faces that are gone.
  if (!done || session.told[fault] != surface || dirty_.contains(fault)) return;
  std::erase(offsets_due_, fault);
  if (numbers.faults.empty()) return;
  lock.unlock();
  events_.numbers(std::move(numbers));
  lock.lock();
}

void LiveColours::serve(service::EngineClient& client) {
  for (;;) {  // one round for each volume
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [this] { return ends_ || !wanted_ || volume_.has_value(); });
    if (ends_ || !wanted_) return;
    const EngineVolume volume = *volume_;
    const JobContext job = job_;
    for (const auto& [fault, surface] : surfaces_) {
      dirty_.insert(fault);
      // Those that wait already keep their place.
      if (std::ranges::find(offsets_due_, fault) == offsets_due_.end())
        offsets_due_.insert(offsets_due_.begin(), fault);
    }
    lock.unlock();

    v1::VolumeName name;
    name.set_checksum(volume.checksum);
    name.set_path(volume.path);
    const std::string opened = client.open_volume(name, job).volume();
    const auto session = std::make_shared<Session>();
    session->engine_edit = client.status().edit();
    v1::EditBatch clear;
    clear.set_edit(++session->engine_edit);
    clear.add_edits()->set_clear(true);
    client.edit(clear);

    v1::ExtractOptions options;
    for (const char* one : kLive) options.add_compute(one);
    auto live = client.live(opened, options, [this, session](const v1::LiveReply& reply) {
      EngineNumbers numbers = plain(reply);
      {
        const std::scoped_lock guard(mutex_);
        session->answered = std::max(session->answered, reply.edit());
        const auto found = session->ours.upper_bound(reply.edit());
        numbers.edit = found == session->ours.begin() ? 0 : std::prev(found)->second;
        session->ours.erase(session->ours.begin(), found == session->ours.begin() ? found : std::prev(found));
        while (!session->batches.empty() && session->batches.begin()->first <= reply.edit()) {
          for (auto& [fault, surface] : session->batches.begin()->second)
            session->known[fault] = std::move(surface);
          session->batches.erase(session->batches.begin());
        }
        for (const Id fault : numbers.faults) numbers.computed_on[fault] = session->known[fault];
      }
      if (reply.has_failure()) events_.failed(reply.failure().message(), reply.failure().hint());
      events_.numbers(std::move(numbers));
      wake_.notify_all();
    });

    lock.lock();
    bool rested = false;  // offsets of one fault follow on those of another at once
    for (;;) {
      const bool offsets = may_ask_offsets(*session);
      const auto ready = [&] {
        return ends_ || !wanted_ || volume_ != volume || (has_work() && session->answered >= session->sent) ||
               may_ask_offsets(*session) != offsets;
      };
      const auto patience = !offsets ? std::chrono::milliseconds(kLook) : rested ? 0ms : kRest;
      if (!wake_.wait_for(lock, patience, ready)) {
        rested = offsets;
        if (offsets) {
          ask_offsets(client, opened, *session, lock);
          continue;
        }
        lock.unlock();
        if (live->has_ended()) live->finish();  // throws why
        client.status();                        // throws when the engine is gone
        lock.lock();
        continue;
      }
      if (ends_ || !wanted_ || volume_ != volume) break;
      rested = false;
      if (!has_work() || session->answered < session->sent) continue;
      v1::EditBatch batch;
      std::size_t faces = 0;
      std::map<Id, std::shared_ptr<const FaultSurface>> told_now;
      while (!dirty_.empty() && faces < kFacesInBatch) {
        const Id fault = *dirty_.begin();
        dirty_.erase(dirty_.begin());
        const auto now = surfaces_.find(fault);
        auto& told = session->told[fault];
        const auto next = now == surfaces_.end() ? nullptr : now->second;
        told_now[fault] = next;
        faces += append_edits(fault, told.get(), next.get(), batch);
        told = next;
      }
      const std::uint64_t mine = dirty_.empty() ? edit_ : 0;  // what is still to come has not been told
      if (batch.edits_size() == 0) {
        lock.unlock();
        EngineNumbers nothing;
        nothing.edit = mine;
        events_.numbers(std::move(nothing));
        lock.lock();
        continue;
      }
      batch.set_edit(++session->engine_edit);
      session->sent = batch.edit();
      if (mine != 0) session->ours[batch.edit()] = mine;
      session->batches[batch.edit()] = std::move(told_now);
      lock.unlock();
      live->send(batch);
      lock.lock();
    }
    const bool goes_on = !ends_ && wanted_;
    lock.unlock();
    live.reset();
    if (!goes_on) return;
  }
}

}  // namespace footwall::ui
