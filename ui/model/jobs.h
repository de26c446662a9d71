// Work over a second: each a row with progress, time left, cancel and log, run on a thread of its own.
#pragma once
#include <QAbstractListModel>
#include <QString>
#include <chrono>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "storage/base/error.h"
#include "storage/base/job_context.h"

namespace footwall::ui {

class Jobs final : public QAbstractListModel {
  Q_OBJECT

 public:
  enum Role {
    kTitle = Qt::UserRole,
    kPhase,
    kAmounts,
    kFraction,
    kSecondsLeft,
    kState,
    kMessage,
    kHint,
    kLog,
    kNumber
  };
  enum class State { kRunning, kDone, kCancelled, kFailed };

  explicit Jobs(QObject* parent = nullptr);
  // Cancels what runs and waits for it.
  ~Jobs() override;

  using Work = std::function<void(const JobContext&)>;
  using Done = std::function<void()>;
  // work runs on a thread of its own and sees nothing that lives in the window's; done runs in the window's
  // thread after it ended well. Returns the job's number.
  int start(const QString& title, Work work, Done done = {});
  void cancel(int job);
  void clear_finished();
  int running() const;

  int rowCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;

 Q_SIGNALS:
  void finished(int job, footwall::ui::Jobs::State state, const QString& message, const QString& hint);
  void running_changed(int running);

 private:
  struct Job;
  void progressed(int job, double fraction, const QString& phase, const QString& amounts);
  void ended(int job, State state, const QString& message, const QString& hint);
  int row_of(int job) const;
  std::vector<std::unique_ptr<Job>> jobs_;  // newest first
  int last_ = 0;
};

}  // namespace footwall::ui
