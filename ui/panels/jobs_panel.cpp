#include "ui/panels/jobs_panel.h"

#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QMouseEvent>
#include <QPainter>
#include <QProgressBar>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace footwall::ui {
namespace {

constexpr int kLogIndent = 12;

}  // namespace

QString time_left_text(const QVariant& seconds) {
  if (!seconds.isValid()) return {};
  const double left = seconds.toDouble();
  if (left < 10) return QObject::tr("%1 s left").arg(left, 0, 'f', 1);
  if (left < 120) return QObject::tr("%1 s left").arg(std::lround(left));
  return QObject::tr("%1 min left").arg(std::lround(left / 60));
}

// One job: its title and what it does on a line, a bar below, and its log where that is asked for.
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
    setFocusPolicy(Qt::StrongFocus);
    setToolTip(QObject::tr("A click, or Enter, shows what it did"));
    cancel_ = new QToolButton(this);
    cancel_->setObjectName(QStringLiteral("cancel"));
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
    log_ = new QLabel(this);
    log_->setObjectName(QStringLiteral("log"));
    log_->setTextFormat(Qt::PlainText);
    log_->setWordWrap(true);
    log_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    log_->setForegroundRole(QPalette::PlaceholderText);
    log_->setIndent(kLogIndent);
    log_->hide();
    column->addWidget(log_);
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
    QStringList log = job.data(Jobs::kLog).toString().split(QLatin1Char('\n'), Qt::SkipEmptyParts);
    log.append(job.data(Jobs::kHint).toString());
    log.removeAll(QString());
    log_->setText(log.isEmpty() ? QObject::tr("nothing to tell yet") : log.join(QLatin1Char('\n')));
    doing_->setForegroundRole(state == Jobs::State::kFailed ? QPalette::BrightText
                                                            : QPalette::PlaceholderText);
    bar_->setValue(static_cast<int>(1000 * job.data(Jobs::kFraction).toDouble()));
    bar_->setVisible(runs);
    cancel_->setVisible(runs);
  }

  const Jobs* jobs() const { return &jobs_; }
  int number() const { return number_; }
  void open_log(bool on) { log_->setVisible(on); }
  // Whether the log is shown, each time that it is asked for or put away.
  void when_toggled(std::function<void(bool)> tell) { tell_ = std::move(tell); }

 protected:
  void paintEvent(QPaintEvent* event) override {
    QWidget::paintEvent(event);
    if (!hasFocus()) return;
    QPainter painter(this);
    painter.setPen(palette().color(QPalette::Link));
    painter.drawRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5));
  }
  void mouseReleaseEvent(QMouseEvent* event) override {
    if (event->button() == Qt::LeftButton && rect().contains(event->position().toPoint())) toggle_log();
  }
  void keyPressEvent(QKeyEvent* event) override {
    if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter) return toggle_log();
    QWidget::keyPressEvent(event);
  }

 private:
  void toggle_log() {
    log_->setVisible(log_->isHidden());
    if (tell_) tell_(!log_->isHidden());
  }

  Jobs& jobs_;
  int number_ = 0;
  QLabel* title_ = nullptr;
  QLabel* doing_ = nullptr;
  QToolButton* cancel_ = nullptr;
  QProgressBar* bar_ = nullptr;
  QLabel* log_ = nullptr;
  std::function<void(bool)> tell_;
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
  clear_ = new QToolButton(body_);
  clear_->setObjectName(QStringLiteral("clear"));
  clear_->setText(tr("Clear finished"));
  clear_->setAutoRaise(true);
  clear_->setProperty("dim", true);
  clear_->setToolTip(tr("Take what has ended off this list"));
  connect(clear_, &QToolButton::clicked, this, [this] {
    for (Jobs* one : jobs_) one->clear_finished();
  });
  column_->addWidget(clear_, 0, Qt::AlignRight);
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
      show_clear();
    });
  }
  list_jobs();
}

void JobsPanel::list_jobs() {
  std::pair<const Jobs*, int> focused;
  for (JobRow* row : std::exchange(rows_, {})) {
    if (row->hasFocus()) focused = {row->jobs(), row->number()};
    delete row;
  }
  for (Jobs* one : jobs_) {
    for (int row = 0; row < one->rowCount(); ++row) {
      auto* shown = new JobRow(*one, row, body_);
      const std::pair key(static_cast<const Jobs*>(one), shown->number());
      shown->open_log(open_.contains(key));
      shown->when_toggled([this, key](bool on) {
        if (on) {
          open_.insert(key);
        } else {
          open_.erase(key);
        }
      });
      if (key == focused) shown->setFocus();
      rows_.push_back(shown);
      column_->insertWidget(static_cast<int>(rows_.size()) - 1, shown);
    }
  }
  nothing_->setVisible(rows_.empty());
  show_clear();
}

void JobsPanel::show_clear() {
  const auto has_ended = [](const Jobs* jobs) { return jobs->running() < jobs->rowCount(); };
  clear_->setVisible(std::ranges::any_of(jobs_, has_ended));
}

}  // namespace footwall::ui
