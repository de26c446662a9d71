// Pictures of isosurfaces by the engine, on a thread and connection of their own: the newest request wins,
// and each pass is handed on as it arrives.
#pragma once
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "engine/service/client/connection_file.h"
#include "storage/base/job_context.h"
#include "ui/model/engine_link.h"
#include "ui/model/live_colours.h"

namespace footwall::ui {

class PictureThread {
 public:
  // Both called on the thread. connection: nothing while there is no engine.
  struct Events {
    std::function<std::optional<service::Connection>()> connection;
    std::function<void(std::shared_ptr<const Picture>)> picture;
    std::function<void(const std::string& message, const std::string& hint)> failed;
  };

  explicit PictureThread(Events events);
  // Cancels the one under way.
  ~PictureThread();
  PictureThread(const PictureThread&) = delete;
  PictureThread& operator=(const PictureThread&) = delete;

  // volumes: of the request's isosurfaces, in their order. Without an engine it waits for engine_came().
  std::uint64_t draw(const PictureRequest& request, std::vector<EngineVolume> volumes);
  void engine_came();

 private:
  struct Wanted {
    std::uint64_t number = 0;
    PictureRequest request;
    std::vector<EngineVolume> volumes;
  };
  void work();
  void make(const Wanted& wanted, const JobContext& job);

  const Events events_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<Wanted> wanted_;
  std::optional<Wanted> without_engine_;  // came when there was none
  JobContext job_;
  std::uint64_t last_ = 0;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace footwall::ui
