#include "ui/model/update_all.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "ui/model/fault_commands.h"
#include "ui/model/project_job.h"

namespace footwall::ui {
namespace {

using namespace std::chrono_literals;

constexpr const char* kWatch = "update-all";
constexpr auto kLook = 100ms;                   // how soon a cancel is seen
constexpr const char* kStatistic = "variance";  // one that needs the voxels: the others come with it

// What the window's thread tells the job's.
struct Told {
  std::mutex mutex;
  std::condition_variable changed;
  std::size_t fresh = 0, faces = 0;
  bool all = false;
  std::optional<LiveRun> run = {};
  std::optional<Error> failure = {};
};

// Lives in the window's thread as long as the job does.
class Watch final : public QObject {
 public:
  Watch(Workbench& workbench, std::shared_ptr<Told> told)
      : QObject(&workbench.surfaces), workbench_(workbench), told_(std::move(told)) {
    setObjectName(QLatin1String(kWatch));
    connect(&workbench.surfaces, &Surfaces::surfaces_changed, this, [this] { look(); });
    connect(&workbench.surfaces, &Surfaces::numbers_changed, this, [this] { look(); });
    connect(&workbench.engine, &EngineLink::state_changed, this, [this] { look_at_engine(); });
    connect(&workbench.engine, &EngineLink::failed, this,
            [this](const QString& message, const QString& hint) {
              fail({ErrorCode::kEngine, message.toStdString(), hint.toStdString()});
            });
    connect(&workbench.jobs, &Jobs::finished, this, [this](int job) {
      if (job != number) return;
      setObjectName(QString());  // the next "Update all" is another
      deleteLater();
    });
  }

  // At what is known now: a run that the views show says nothing of it.
  void look() {
    const Surfaces& surfaces = workbench_.surfaces;
    std::size_t fresh = 0, faces = 0;
    for (const Fault& fault : workbench_.document.faults()) {
      const auto surface = surfaces.surface(fault.record.id);
      if (surface == nullptr) continue;
      faces += surface->faces.size();
      const bool is_fresh =
          surface->faces.empty() ||
          surfaces.freshness(fault.record.id, QLatin1String(kStatistic)) == Freshness::kFresh;
      if (is_fresh) fresh += surface->faces.size();
    }
    const bool all = surfaces.is_settled() && fresh == faces;
    {
      const std::scoped_lock lock(told_->mutex);
      told_->fresh = fresh;
      told_->faces = faces;
      if (all && !told_->all) told_->run = surfaces.live_run();
      told_->all = told_->all || all;
    }
    told_->changed.notify_all();
  }

  int number = 0;  // of the job

 private:
  bool runs() const {
    const EngineLink::State state = workbench_.engine.state();
    return state != EngineLink::State::kOff && state != EngineLink::State::kLost;
  }

  void look_at_engine() {
    ran_ = ran_ || runs();
    if (runs()) return look();
    const bool lost = workbench_.engine.state() == EngineLink::State::kLost;
    if (lost || ran_) {
      fail({ErrorCode::kEngine, "engine " + workbench_.engine.state_text().toStdString(),
            "Compute > Engine starts it again"});
    }
  }

  void fail(const Error& error) {
    {
      const std::scoped_lock lock(told_->mutex);
      if (!told_->failure) told_->failure = error;
    }
    told_->changed.notify_all();
  }

  Workbench& workbench_;
  std::shared_ptr<Told> told_;
  bool ran_ = runs();
};

LiveRun wait_for_all(Told& told, const JobContext& job) {
  std::unique_lock lock(told.mutex);
  for (;;) {
    if (told.failure) throw *told.failure;
    if (told.all && !told.run) {
      throw Error(ErrorCode::kInvalid, "no fault has a surface that statistics could be of",
                  "pick at least two pillars on a fault");
    }
    if (told.all) return std::move(*told.run);
    const std::size_t fresh = told.fresh, faces = told.faces;
    lock.unlock();
    job.report(faces == 0 ? 0 : 0.95 * static_cast<double>(fresh) / static_cast<double>(faces), "statistics",
               fmt::format("{} of {} faces", fresh, faces));
    lock.lock();
    if (told.fresh == fresh && !told.all && !told.failure) told.changed.wait_for(lock, kLook);
  }
}

}  // namespace

int start_update(Workbench& workbench) {
  if (const QObject* running =
          workbench.surfaces.findChild<QObject*>(QLatin1String(kWatch), Qt::FindDirectChildrenOnly))
    return static_cast<const Watch*>(running)->number;
  workbench.engine.start();
  workbench.engine.set_volume(workbench.display.volume());
  auto told = std::make_shared<Told>();
  auto watch = std::make_unique<Watch>(workbench, told);
  const bool keeps = !workbench.document.read_only();
  watch->number = start_on_project(workbench, QObject::tr("Update all"),
                                   [told, keeps](project::Project& project, const JobContext& job) {
                                     const LiveRun run = wait_for_all(*told, job);
                                     job.report(0.95, "store");
                                     if (keeps) store(project, run);
                                   });
  watch->look();
  return watch.release()->number;
}

}  // namespace footwall::ui
