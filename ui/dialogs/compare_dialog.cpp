#include "ui/dialogs/compare_dialog.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QPointer>
#include <QVBoxLayout>
#include <algorithm>
#include <memory>
#include <utility>

#include "engine/tasks/statistics.h"
#include "ui/dialogs/caption.h"
#include "ui/dialogs/fault_box.h"

namespace footwall::ui {
namespace {

QString in_words(const Error& error) {
  const QString message = QString::fromStdString(error.message());
  return error.hint().empty() ? message
                              : message + QStringLiteral(": ") + QString::fromStdString(error.hint());
}

QVBoxLayout* with_caption(const QString& text, QWidget* widget, QWidget* parent) {
  auto* column = new QVBoxLayout;
  column->setSpacing(4);
  column->addWidget(caption(text, parent));
  column->addWidget(widget);
  return column;
}

}  // namespace

CompareDialog::CompareDialog(Workbench& workbench, QWidget* parent) : QDialog(parent), workbench_(workbench) {
  setWindowTitle(tr("Compare runs"));
  fault_ = fault_box(workbench, false, true, this);
  run_a_ = new QComboBox(this);
  run_a_->setObjectName(QStringLiteral("run_a"));
  run_b_ = new QComboBox(this);
  run_b_->setObjectName(QStringLiteral("run_b"));
  statistic_ = new QComboBox(this);
  statistic_->setObjectName(QStringLiteral("statistic"));
  for (const project::StatisticRecord& one : workbench.surfaces.statistics()) {
    const QString name = QString::fromStdString(one.name);
    statistic_->addItem(name, QString::fromStdString(one.colour_map));
    statistic_->setItemData(statistic_->count() - 1, QString::fromStdString(one.description),
                            Qt::ToolTipRole);
  }
  statistic_->setCurrentText(QStringLiteral("variance"));
  compare_ = new QPushButton(tr("Compare"), this);
  compare_->setObjectName(QStringLiteral("compare"));
  compare_->setDefault(true);
  auto* row = new QHBoxLayout;
  row->setSpacing(8);
  row->addLayout(with_caption(tr("Fault"), fault_, this), 1);
  row->addLayout(with_caption(tr("Run A"), run_a_, this), 1);
  row->addLayout(with_caption(tr("Run B"), run_b_, this), 1);
  row->addLayout(with_caption(tr("Statistic"), statistic_, this), 1);
  row->addWidget(compare_, 0, Qt::AlignBottom);

  view_ = new CompareView(this);
  read_out_ = new QLabel(this);
  read_out_->setMinimumHeight(fontMetrics().height());
  message_ = new QLabel(this);
  message_->setWordWrap(true);
  csv_ = new QPushButton(tr("Table (CSV)…"), this);
  csv_->setObjectName(QStringLiteral("csv"));
  picture_ = new QPushButton(tr("Picture (PNG)…"), this);
  picture_->setObjectName(QStringLiteral("picture"));
  auto* close = new QPushButton(tr("Close"), this);
  for (QPushButton* button : {csv_, picture_, close}) button->setAutoDefault(false);
  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(8);
  buttons->addWidget(message_, 1);
  buttons->addWidget(csv_);
  buttons->addWidget(picture_);
  buttons->addWidget(close);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(12, 12, 12, 12);
  column->setSpacing(8);
  column->addLayout(row);
  column->addWidget(view_, 1);
  column->addWidget(read_out_);
  column->addLayout(buttons);

  connect(view_, &CompareView::pointed, read_out_, &QLabel::setText);
  connect(compare_, &QPushButton::clicked, this, &CompareDialog::compare);
  connect(close, &QPushButton::clicked, this, &QDialog::reject);
  connect(csv_, &QPushButton::clicked, this,
          [this] { ask_file(QStringLiteral(".csv"), &CompareDialog::write_csv); });
  connect(picture_, &QPushButton::clicked, this,
          [this] { ask_file(QStringLiteral(".png"), &CompareDialog::write_picture); });
  connect(&workbench.document, &Document::runs_changed, this, &CompareDialog::fill_runs);
  connect(&workbench.jobs, &Jobs::finished, this,
          [this](int job, Jobs::State state, const QString& message, const QString& hint) {
            if (job != job_ || state == Jobs::State::kDone) return;
            say(hint.isEmpty() ? message : message + QStringLiteral(": ") + hint, QPalette::BrightText);
          });
  fill_runs();
  take(nullptr);
}

void CompareDialog::fill_runs() {
  std::vector<project::RunRecord> runs;
  try {
    runs = workbench_.document.project().runs();
  } catch (const Error& error) {
    return say(in_words(error), QPalette::BrightText);
  }
  for (QComboBox* box : {run_a_, run_b_}) {
    const QVariant chosen = box->currentData();
    box->clear();
    for (const project::RunRecord& run : runs) {
      const QString name = QString::fromStdString(run.name);
      const QString label =
          run.volume.empty() ? name : tr("%1 (%2)").arg(name, QString::fromStdString(run.volume));
      box->addItem(label, static_cast<qlonglong>(run.id));
    }
    const int last = box->count() - (box == run_a_ ? 2 : 1);
    const int again = box->findData(chosen);
    box->setCurrentIndex(again >= 0 ? again : std::max(0, last));
  }
  const bool can = runs.size() >= 2 && fault_->count() > 0;
  compare_->setEnabled(can);
  if (!can) say(tr("It takes two runs: Compute > Run… adds one."), QPalette::LinkVisited);
}

tasks::CompareChoice CompareDialog::choice() const {
  tasks::CompareChoice choice;
  choice.fault = fault_->currentData().toString().toStdString();
  choice.run_a = run_a_->currentData().toLongLong();
  choice.run_b = run_b_->currentData().toLongLong();
  choice.statistic = statistic_->currentText().toStdString();
  return choice;
}

void CompareDialog::compare() {
  const tasks::CompareChoice now = choice();
  const std::string colours = statistic_->currentData().toString().toStdString();
  const QPointer<CompareDialog> dialog = this;
  auto made = std::make_shared<ComparedImages>();
  auto serial = std::make_shared<int>(0);
  try {
    auto project = std::make_shared<project::Project>(workbench_.document.project().beside());
    say(tr("comparing …"), QPalette::PlaceholderText);
    job_ = *serial = workbench_.jobs.start(
        tr("Compare %1").arg(QString::fromStdString(now.fault)),
        [project, now, colours, made](const JobContext& job) {
          *made = pictured(tasks::compare_runs(*project, now, job), colours);
        },
        [dialog, made, serial] {
          if (dialog && *serial == dialog->job_) dialog->take(made);
        });
  } catch (const Error& error) {
    say(in_words(error), QPalette::BrightText);
  }
}

void CompareDialog::take(std::shared_ptr<const ComparedImages> compared) {
  compared_ = std::move(compared);
  view_->show_compared(compared_);
  csv_->setEnabled(compared_ != nullptr);
  picture_->setEnabled(compared_ != nullptr);
  if (!compared_) return;
  const tasks::RunComparison& made = compared_->comparison;
  const auto value = [](const std::optional<double>& known) {
    return known ? QString::number(*known, 'g', 4) : QStringLiteral("–");
  };
  QString text = tr("B − A: mean %1, root mean square %2 %3. %4 cells in both, %5 in A alone, %6 in B alone.")
                     .arg(value(made.mean), value(made.rms), QString::fromStdString(made.unit))
                     .arg(made.both)
                     .arg(made.only_a)
                     .arg(made.only_b);
  if (made.assumed_velocity) text += tr(" No velocity: 1 ms counts 1 m.");
  say(text, QPalette::WindowText);
}

void CompareDialog::say(const QString& text, QPalette::ColorRole role) {
  message_->setForegroundRole(role);
  message_->setText(text);
}

void CompareDialog::ask_file(const QString& suffix, void (CompareDialog::*write)(const QString&)) {
  const QFileInfo project(QString::fromStdString(workbench_.document.project().path().string()));
  const QString proposed = project.absolutePath() + QLatin1Char('/') + project.completeBaseName() +
                           QStringLiteral("-difference") + suffix;
  const QString file = QFileDialog::getSaveFileName(this, tr("Export comparison"), proposed,
                                                    QStringLiteral("*%1").arg(suffix));
  if (!file.isEmpty()) (this->*write)(file);
}

void CompareDialog::write_csv(const QString& file) {
  if (!compared_ || !workbench_.document.survey()) return;
  const QPointer<CompareDialog> dialog = this;
  job_ = workbench_.jobs.start(
      tr("Export %1").arg(QFileInfo(file).fileName()),
      [compared = compared_, survey = *workbench_.document.survey(), file](const JobContext&) {
        tasks::write_csv(compared->comparison, survey, file.toStdString());
      },
      [dialog, file] {
        if (dialog) dialog->say(tr("%1 written").arg(QFileInfo(file).fileName()), QPalette::WindowText);
      });
}

void CompareDialog::write_picture(const QString& file) {
  constexpr int kScale = 2;  // sharper than the screen
  QImage picture(view_->size() * kScale, QImage::Format_RGB32);
  picture.setDevicePixelRatio(kScale);
  view_->render(&picture);
  if (picture.save(file, "PNG"))
    return say(tr("%1 written").arg(QFileInfo(file).fileName()), QPalette::WindowText);
  say(tr("cannot write %1: is the folder there, and not full?").arg(file), QPalette::BrightText);
}

}  // namespace footwall::ui
