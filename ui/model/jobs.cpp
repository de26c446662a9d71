#include "ui/model/jobs.h"

#include <algorithm>
#include <utility>

namespace footwall::ui {

struct Jobs::Job {
  int number = 0;
  QString title, phase, amounts, message, hint, log;
  double fraction = 0;
  State state = State::kRunning;
  std::chrono::steady_clock::time_point begun = std::chrono::steady_clock::now();
  JobContext context;
  Done done;
  std::thread thread;
};

Jobs::Jobs(QObject* parent) : QAbstractListModel(parent) {
  qRegisterMetaType<footwall::ui::Jobs::State>();
}

Jobs::~Jobs() {
  for (const auto& job : jobs_) job->context.cancel();
  for (const auto& job : jobs_) {
    if (job->thread.joinable()) job->thread.join();
  }
}

int Jobs::start(const QString& title, Work work, Done done) {
  auto job = std::make_unique<Job>();
  const int number = job->number = ++last_;
  job->title = title;
  job->done = std::move(done);
  job->context = JobContext([this, number](const Progress& progress) {
    const QString phase =
        QString::fromUtf8(progress.phase.data(), static_cast<qsizetype>(progress.phase.size()));
    const QString amounts = QString::fromStdString(progress.amounts);
    QMetaObject::invokeMethod(
        this,
        [this, number, fraction = progress.fraction, phase, amounts] {
          progressed(number, fraction, phase, amounts);
        },
        Qt::QueuedConnection);
  });
  const JobContext context = job->context;
  job->thread = std::thread([this, number, context, work = std::move(work)] {
    State state = State::kDone;
    QString message, hint;
    try {
      work(context);
    } catch (const Error& error) {
      state = error.code() == ErrorCode::kCancelled ? State::kCancelled : State::kFailed;
      message = QString::fromStdString(error.message());
      hint = QString::fromStdString(error.hint());
    } catch (const std::exception& error) {
      state = State::kFailed;
      message = QString::fromUtf8(error.what());
    }
    QMetaObject::invokeMethod(
        this, [this, number, state, message, hint] { ended(number, state, message, hint); },
        Qt::QueuedConnection);
  });
  beginInsertRows({}, 0, 0);
  jobs_.insert(jobs_.begin(), std::move(job));
  endInsertRows();
  Q_EMIT running_changed(running());
  return number;
}

void Jobs::cancel(int job) {
  const int row = row_of(job);
  if (row >= 0) jobs_[static_cast<std::size_t>(row)]->context.cancel();
}

void Jobs::clear_finished() {
  for (int row = static_cast<int>(jobs_.size()) - 1; row >= 0; --row) {
    if (jobs_[static_cast<std::size_t>(row)]->state == State::kRunning) continue;
    beginRemoveRows({}, row, row);
    jobs_.erase(jobs_.begin() + row);
    endRemoveRows();
  }
}

int Jobs::running() const {
  return static_cast<int>(
      std::ranges::count_if(jobs_, [](const auto& job) { return job->state == State::kRunning; }));
}

int Jobs::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(jobs_.size());
}

QVariant Jobs::data(const QModelIndex& index, int role) const {
  if (!checkIndex(index, CheckIndexOption::IndexIsValid)) return {};
  const Job& job = *jobs_[static_cast<std::size_t>(index.row())];
  switch (role) {
    case Qt::DisplayRole:
    case kTitle:
      return job.title;
    case kPhase:
      return job.phase;
    case kAmounts:
      return job.amounts;
    case kFraction:
      return job.fraction;
    case kSecondsLeft: {
      if (job.state != State::kRunning || job.fraction < 0.02) return {};
      const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - job.begun;
      return spent.count() * (1 - job.fraction) / job.fraction;
    }
    case kState:
      return QVariant::fromValue(job.state);
    case kMessage:
      return job.message;
    case kHint:
      return job.hint;
    case kLog:
      return job.log;
    case kNumber:
      return job.number;
    default:
      return {};
  }
}

int Jobs::row_of(int number) const {
  const auto found = std::ranges::find_if(jobs_, [number](const auto& job) { return job->number == number; });
  return found == jobs_.end() ? -1 : static_cast<int>(found - jobs_.begin());
}

void Jobs::progressed(int number, double fraction, const QString& phase, const QString& amounts) {
  const int row = row_of(number);
  if (row < 0) return;
  Job& job = *jobs_[static_cast<std::size_t>(row)];
  if (phase != job.phase) job.log += phase + QLatin1Char('\n');
  job.fraction = fraction;
  job.phase = phase;
  job.amounts = amounts;
  Q_EMIT dataChanged(index(row), index(row));
}

void Jobs::ended(int number, State state, const QString& message, const QString& hint) {
  const int row = row_of(number);
  if (row < 0) return;
  Job& job = *jobs_[static_cast<std::size_t>(row)];
  job.thread.join();
  job.state = state;
  job.message = message;
  job.hint = hint;
  if (state == State::kDone) job.fraction = 1;
  if (!message.isEmpty()) job.log += message + QLatin1Char('\n');
  const Done done = std::exchange(job.done, {});
  Q_EMIT dataChanged(index(row), index(row));
  Q_EMIT running_changed(running());
  if (state == State::kDone && done) done();
  Q_EMIT finished(number, state, message, hint);
}

}  // namespace footwall::ui
