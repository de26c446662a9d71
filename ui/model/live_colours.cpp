#include "ui/model/live_colours.h"

#include <fmt/format.h>

#include <chrono>
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

EngineNumbers plain(const v1::LiveReply& reply) {
  EngineNumbers numbers;
  numbers.edit = reply.edit();
  const v1::FaceNumbers& of = reply.numbers();
  numbers.faults.assign(of.faces().faults().begin(), of.faces().faults().end());
  numbers.panels.assign(of.faces().owners().begin(), of.faces().owners().end());
  numbers.face_numbers.assign(of.faces().numbers().begin(), of.faces().numbers().end());
  const auto take = [&](const char* name, const auto& column) {
    // A column that was not asked for is empty.
    if (static_cast<std::size_t>(column.size()) != numbers.faults.size()) return;
    numbers.statistics[name].assign(column.begin(), column.end());
  };
  take("count", of.count());
  take("nulls", of.nulls());
  take("outside", of.outside());
  take("mean", of.mean());
  take("variance", of.variance());
  take("min", of.min());
  take("max", of.max());
  take("discontinuity", of.discontinuity());
  take("contrast", of.contrast());
  take("offset_voxels", of.offset_voxels());
  take("offset_score", of.offset_score());
  return numbers;
}

}  // namespace

// One stretch with one engine and one volume.
struct LiveColours::Session {
  std::map<Id, std::shared_ptr<const FaultSurface>> told;
  std::uint64_t sent = 0;      // the newest edit told
  std::uint64_t answered = 0;  // guarded by mutex_
  std::uint64_t engine_edit = 0;
  // Guarded by mutex_, by the engine's number of an edit: our number where it told all there was, and the faults that it
  // told with our number of each.
  std::map<std::uint64_t, std::uint64_t> ours;
  std::map<std::uint64_t, std::map<Id, std::uint64_t>> batches;
  std::map<Id, std::uint64_t> known;  // of what was answered, our number of each fault
};

LiveColours::LiveColours(std::optional<service::Connection> connection, int ranks, Events events)
    : given_(std::move(connection)), ranks_(ranks), events_(std::move(events)), thread_([this] { work(); }) {}

LiveColours::~LiveColours() {
  {
    const std::scoped_lock lock(mutex_);
    ends_ = true;
    job_.cancel();
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
  }
  wake_.notify_all();
}

void LiveColours::set_volume(const std::optional<EngineVolume>& volume) {
  {
    const std::scoped_lock lock(mutex_);
    volume_ = volume;
  }
  wake_.notify_all();
}

std::uint64_t LiveColours::put(const std::shared_ptr<const FaultSurface>& surface) {
  std::uint64_t edit = 0;
  {
    const std::scoped_lock lock(mutex_);
    edit = ++edit_;
    surfaces_[surface->fault] = {surface, edit};
    dirty_.insert(surface->fault);
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
        if (local == nullptr) local = std::make_unique<service::LocalEngine>(launch, service::LocalEngine::Replay{});
        local->with_engine([&](service::EngineClient& client) { serve_with(client, local->connection()); }, job);
      }
      forget_connection();
      local.reset();
      say(EngineLink::State::kOff);
    } catch (const Error& error) {
      forget_connection();
      lock.lock();
      const bool told_to = ends_ || !wanted_;
      // LocalEngine starts one that died again, and gives up after three deaths in a minute. One that still runs, but broke
      // the connection, is asked once more.
      const bool again = !told_to && served && local != nullptr && local->is_running() && error.code() == ErrorCode::kEngine;
      if (!told_to && !again) wanted_ = false;
      lock.unlock();
      if (again) continue;
      local.reset();
      say(told_to ? EngineLink::State::kOff : EngineLink::State::kLost, told_to ? std::string() : error.message());
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

void LiveColours::serve(service::EngineClient& client) {
  for (;;) {  // one round for each volume
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [this] { return ends_ || !wanted_ || volume_.has_value(); });
    if (ends_ || !wanted_) return;
    const EngineVolume volume = *volume_;
    const JobContext job = job_;
    for (const auto& [fault, surface] : surfaces_) dirty_.insert(fault);
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
    for (const char* one : {"count", "mean", "variance", "min", "max", "discontinuity", "contrast"}) {
      options.add_compute(one);
    }
    auto live = client.live(opened, options, [this, session](const v1::LiveReply& reply) {
      EngineNumbers numbers = plain(reply);
      {
        const std::scoped_lock guard(mutex_);
        session->answered = std::max(session->answered, reply.edit());
        const auto found = session->ours.upper_bound(reply.edit());
        numbers.edit = found == session->ours.begin() ? 0 : std::prev(found)->second;
        session->ours.erase(session->ours.begin(), found == session->ours.begin() ? found : std::prev(found));
        while (!session->batches.empty() && session->batches.begin()->first <= reply.edit()) {
          for (const auto& [fault, edit] : session->batches.begin()->second) session->known[fault] = edit;
          session->batches.erase(session->batches.begin());
        }
        for (const Id fault : numbers.faults) numbers.known[fault] = session->known[fault];
      }
      if (reply.has_failure()) events_.failed(reply.failure().message(), reply.failure().hint());
      events_.numbers(std::move(numbers));
      wake_.notify_all();
    });

    lock.lock();
    for (;;) {
      const auto ready = [&] {
        return ends_ || !wanted_ || volume_ != volume || (has_work() && session->answered >= session->sent);
      };
      if (!wake_.wait_for(lock, kLook, ready)) {
        lock.unlock();
        if (live->has_ended()) live->finish();  // throws why
        client.status();                        // throws when the engine is gone
        lock.lock();
        continue;
      }
      if (ends_ || !wanted_ || volume_ != volume) break;
      v1::EditBatch batch;
      std::size_t faces = 0;
      std::map<Id, std::uint64_t> told_now;
      while (!dirty_.empty() && faces < kFacesInBatch) {
        const Id fault = *dirty_.begin();
        dirty_.erase(dirty_.begin());
        const auto now = surfaces_.find(fault);
        auto& told = session->told[fault];
        const auto next = now == surfaces_.end() ? nullptr : now->second.surface;
        if (next != nullptr) told_now[fault] = now->second.edit;
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
