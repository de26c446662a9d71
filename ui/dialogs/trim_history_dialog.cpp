#include "ui/dialogs/trim_history_dialog.h"

#include <QDateTime>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLocale>
#include <QVBoxLayout>

#include "ui/model/project_job.h"

namespace footwall::ui {
namespace {

constexpr const char* kKeepDays = "history.keep_days";
constexpr int kProposedDays = 365;
constexpr int kMostDays = 36500;

QString mebibytes(std::int64_t bytes) {
  return QString::number(static_cast<double>(bytes) / (1 << 20), 'f', 1);
}

QString number(std::int64_t n) {
  return QLocale::c().toString(static_cast<qlonglong>(n));
}

}  // namespace

std::optional<int> history_keep_days(const project::Project& project) {
  const auto text = project.setting(kKeepDays);
  if (!text) return std::nullopt;
  bool ok = false;
  const int days = QString::fromStdString(*text).toInt(&ok);
  return ok && days >= 0 && days <= kMostDays ? std::optional(days) : std::nullopt;
}

std::string days_ago(int days) {
  return QDateTime::currentDateTimeUtc()
      .addDays(-days)
      .toString(QStringLiteral("yyyy-MM-ddTHH:mm:ssZ"))
      .toStdString();
}

TrimHistoryDialog::TrimHistoryDialog(Workbench& workbench, QWidget* parent)
    : QDialog(parent), workbench_(workbench) {
  setWindowTitle(tr("Trim history"));
  setMinimumWidth(420);
  days_ = new QSpinBox(this);
  days_->setObjectName(QStringLiteral("days"));
  days_->setRange(0, kMostDays);
  days_->setSuffix(tr(" days"));
  remind_ = new QCheckBox(tr("Remind me of this age when the project is opened"), this);
  remind_->setObjectName(QStringLiteral("remind"));
  message_ = new QLabel(this);
  message_->setWordWrap(true);
  trim_ = new QPushButton(tr("Drop these steps"), this);
  trim_->setObjectName(QStringLiteral("trim"));
  auto* close = new QPushButton(tr("Close"), this);
  close->setDefault(true);
  try {
    const auto kept = history_keep_days(workbench.document.project());
    days_->setValue(kept.value_or(kProposedDays));
    remind_->setChecked(kept.has_value());
  } catch (const Error& error) {
    message_->setText(QString::fromStdString(error.message()));
  }
  auto* form = new QFormLayout;
  form->setHorizontalSpacing(12);
  form->addRow(tr("Steps older than"), days_);
  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(8);
  buttons->addStretch(1);
  buttons->addWidget(close);
  buttons->addWidget(trim_);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(12, 12, 12, 12);
  column->setSpacing(8);
  column->addLayout(form);
  column->addWidget(message_);
  column->addWidget(remind_);
  column->addStretch(1);
  column->addLayout(buttons);
  connect(days_, &QSpinBox::valueChanged, this, &TrimHistoryDialog::look);
  connect(trim_, &QPushButton::clicked, this, &TrimHistoryDialog::trim);
  connect(close, &QPushButton::clicked, this, &QDialog::reject);
  connect(remind_, &QCheckBox::toggled, this, [this](bool on) {
    try {
      workbench_.document.store().set_setting(kKeepDays,
                                              on ? std::to_string(days_->value()) : std::string("unlimited"));
    } catch (const Error& error) {
      message_->setText(QString::fromStdString(error.message()));
    }
  });
  look();
}

void TrimHistoryDialog::look() {
  try {
    const project::Project& project = workbench_.document.project();
    const project::HistorySize all = project.history_size();
    const project::HistorySize old = project.history_size(days_ago(days_->value()));
    message_->setText(
        tr("%1 of %2 steps, %3 of %4 MiB, would go. What they did stays; it can no longer be undone.")
            .arg(number(old.steps), number(all.steps), mebibytes(old.bytes), mebibytes(all.bytes)));
    trim_->setEnabled(old.steps > 0);
    if (remind_->isChecked())
      workbench_.document.store().set_setting(kKeepDays, std::to_string(days_->value()));
  } catch (const Error& error) {
    message_->setText(QString::fromStdString(error.message()));
    trim_->setEnabled(false);
  }
}

void TrimHistoryDialog::trim() {
  const std::string before = days_ago(days_->value());
  try {
    start_on_project(workbench_, tr("Trim history"), [before](project::Project& project, const JobContext&) {
      project.trim_history(before);
    });
    accept();
  } catch (const Error& error) {
    message_->setText(QString::fromStdString(error.message()));
  }
}

}  // namespace footwall::ui
