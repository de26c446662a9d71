#include "ui/panels/jobs_panel.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QToolButton>
#include <QVBoxLayout>
#include <cmath>
#include <utility>

namespace footwall::ui {

QString time_left_text(const QVariant& seconds) {
  if (!seconds.isValid()) return {};
  const double left = seconds.toDouble();
  if (left < 10) return QObject::tr("%1 s left").arg(left, 0, 'f', 1);
  if (left < 120) return QObject::tr("%1 s left").arg(std::lround(left));
  return QObject::tr("%1 min left").arg(std::lround(left / 60));
}

// One job: its title and what it does on a line, a bar below.
class JobRow final : public QWidget {
 public:
  JobRow(Jobs& jobs, int row, QWidget* parent) : QWidget(parent), jobs_(jobs) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 4);
    column->setSpacing(4);
    auto* line = new QHBoxLayout;
    title_ = new QLabel(this);
    doing_ = new QLabel(this);
    doing_->setForegroundRole(QPalette::PlaceholderText);
    doing_->setTextFormat(Qt::PlainText);
    doing_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    cancel_ = new QToolButton(this);
    cancel_->setText(QObject::tr("cancel ×"));
    cancel_->setAutoRaise(true);
    cancel_->setProperty("dim", true);
    connect(cancel_, &QToolButton::clicked, this, [this] { jobs_.cancel(number_); });
    line->addWidget(title_);
    line->addSpacing(8);
    line->addWidget(doing_, 1);
    line->addWidget(cancel_);
    column->addLayout(line);
    bar_ = new QProgressBar(this);
    bar_->setRange(0, 1000);
    bar_->setTextVisible(false);
    column->addWidget(bar_);
    show_job(row);
  }

  void show_job(int row) {
    const QModelIndex job = jobs_.index(row);
    number_ = job.data(Jobs::kNumber).toInt();
    title_->setText(job.data(Jobs::kTitle).toString());
    const auto state = job.data(Jobs::kState).value<Jobs::State>();
    const bool runs = state == Jobs::State::kRunning;
    QStringList words;
    switch (state) {
      case Jobs::State::kRunning:
        words = {job.data(Jobs::kPhase).toString(), job.data(Jobs::kAmounts).toString(),
                 time_left_text(job.data(Jobs::kSecondsLeft))};
        break;
      case Jobs::State::kDone:
        words = {QObject::tr("done")};
        break;
      case Jobs::State::kCancelled:
        words = {QObject::tr("cancelled")};
        break;
      case Jobs::State::kFailed:
        words = {job.data(Jobs::kMessage).toString(), job.data(Jobs::kHint).toString()};
        break;
    }
    words.removeAll(QString());
    doing_->setText(words.join(QStringLiteral(", ")));
    doing_->setToolTip(job.data(Jobs::kLog).toString());
    doing_->setForegroundRole(state == Jobs::State::kFailed ? QPalette::BrightText
                                                            : QPalette::PlaceholderText);
    bar_->setValue(static_cast<int>(1000 * job.data(Jobs::kFraction).toDouble()));
    bar_->setVisible(runs);
    cancel_->setVisible(runs);
  }

  const Jobs* jobs() const { return &jobs_; }

 private:
  Jobs& jobs_;
  int number_ = 0;
  QLabel* title_ = nullptr;
  QLabel* doing_ = nullptr;
  QToolButton* cancel_ = nullptr;
  QProgressBar* bar_ = nullptr;
};

JobsPanel::JobsPanel(std::vector<Jobs*> jobs, QWidget* parent) : QScrollArea(parent), jobs_(std::move(jobs)) {
  setFrameShape(QFrame::NoFrame);
  setWidgetResizable(true);
  body_ = new QWidget(this);
  body_->setAutoFillBackground(true);
  body_->setBackgroundRole(QPalette::Base);
  column_ = new QVBoxLayout(body_);
  column_->setContentsMargins(12, 2, 12, 4);
  column_->setSpacing(2);
  nothing_ = new QLabel(tr("Nothing runs. What takes longer than a second is shown here."), body_);
  nothing_->setForegroundRole(QPalette::PlaceholderText);
  column_->addWidget(nothing_);
  column_->addStretch(1);
  setWidget(body_);
  for (Jobs* one : jobs_) {
    connect(one, &Jobs::rowsInserted, this, &JobsPanel::list_jobs);
    connect(one, &Jobs::rowsRemoved, this, &JobsPanel::list_jobs);
    connect(one, &Jobs::dataChanged, this, [this, one](const QModelIndex& from, const QModelIndex& to) {
      int row = 0;
      for (JobRow* shown : rows_) {
        if (shown->jobs() != one) continue;
        if (row >= from.row() && row <= to.row()) shown->show_job(row);
        ++row;
      }
    });
  }
  list_jobs();
}

void JobsPanel::list_jobs() {
  for (JobRow* row : std::exchange(rows_, {})) delete row;
  for (Jobs* one : jobs_) {
    for (int row = 0; row < one->rowCount(); ++row) {
      rows_.push_back(new JobRow(*one, row, body_));
      column_->insertWidget(static_cast<int>(rows_.size()) - 1, rows_.back());
    }
  }
  nothing_->setVisible(rows_.empty());
}

}  // namespace footwall::ui
