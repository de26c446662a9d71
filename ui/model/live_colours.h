// The engine's side of colours that follow the hand: a thread that holds the engine, tells it the faces that
// changed (newest wins, one batch under way at a time) and hands its numbers on. Offsets cost 17 times what a
// discontinuity does: they are asked for by themselves, fault by fault, while all else is answered and no
// hand is on a fault, and given up for anything that is to be told. No Qt in here.
#pragma once
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>

#include "engine/service/client/connection_file.h"
#include "engine/session/launch.h"
#include "storage/base/job_context.h"
#include "ui/model/engine_link.h"
#include "ui/model/surfaces.h"

namespace footwall::service {
class EngineClient;
class LocalEngine;
}  // namespace footwall::service

namespace footwall::ui {

// A volume as the engine finds it.
struct EngineVolume {
  std::string checksum;
  std::string path;
  friend bool operator==(const EngineVolume&, const EngineVolume&) = default;
};

class LiveColours {
 public:
  // Called on the thread, or on one of the engine client's.
  struct Events {
    std::function<void(EngineLink::State, const std::string& text)> state;
    std::function<void(EngineNumbers)> numbers;
    std::function<void(const std::string& message, const std::string& hint)> failed;
  };

  // connection: of an engine that runs already; else one is started on this machine.
  LiveColours(std::optional<service::Connection> connection, int ranks, Events events);
  // Ends a local engine.
  ~LiveColours();
  LiveColours(const LiveColours&) = delete;
  LiveColours& operator=(const LiveColours&) = delete;

  void start();
  void stop();
  void set_volume(const std::optional<EngineVolume>& volume);
  // Of the fault whose id it has. Returns the edit's number.
  std::uint64_t put(const std::shared_ptr<const FaultSurface>& surface);
  std::uint64_t remove(Id fault);
  // How to reach the engine, once it has been started.
  std::optional<service::Connection> connection() const;

 private:
  struct Session;
  void work();
  void serve(service::EngineClient& client);
  void forget_connection();
  bool has_work() const;                               // mutex_ is held
  bool may_ask_offsets(const Session& session) const;  // mutex_ is held
  // Of the fault that changed last of those that wait. lock: of mutex_, held before and after.
  void ask_offsets(service::EngineClient& client, const std::string& volume, Session& session,
                   std::unique_lock<std::mutex>& lock);
  void say(EngineLink::State state, const std::string& text = {});

  const std::optional<service::Connection> given_;
  const int ranks_;
  const Events events_;
  JobContext job_;  // of what is under way

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  bool ends_ = false;
  bool wanted_ = false;  // the engine is to run
  std::optional<EngineVolume> volume_;
  std::map<Id, std::shared_ptr<const FaultSurface>> surfaces_;
  std::set<Id> dirty_;           // to be told; those not among surfaces_ are to go
  std::vector<Id> offsets_due_;  // faults whose offsets are not known; the one that changed last at the end
  JobContext offsets_job_;       // of those under way
  std::uint64_t edit_ = 0;
  std::optional<service::Connection> reached_;

  std::thread thread_;
};

}  // namespace footwall::ui
