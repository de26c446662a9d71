#include "ui/window/start_page.h"

#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QProgressBar>
#include <QPushButton>
#include <QSettings>
#include <QVBoxLayout>

#include "ui/model/jobs.h"
#include "ui/window/actions.h"

namespace footwall::ui {
namespace {

constexpr const char* kRecentSetting = "recent";
constexpr int kRowHeight = 24;
constexpr qsizetype kRecentCount = 12;
constexpr int kColumnWidth = 560;

QPushButton* button_of(const Actions& actions, const char* id, QWidget* parent) {
  QAction* action = actions.action(QString::fromLatin1(id));
  auto* button =
      new QPushButton(action->icon(), QLatin1Char(' ') + action->text().remove(QLatin1Char('&')), parent);
  button->setToolTip(action->toolTip());
  button->setMinimumHeight(36);
  QObject::connect(button, &QPushButton::clicked, action, &QAction::trigger, Qt::QueuedConnection);
  return button;
}

}  // namespace

QStringList recent_projects() {
  return QSettings().value(QLatin1String(kRecentSetting)).toStringList();
}

void remember_project(const QString& path) {
  const QString whole = QFileInfo(path).absoluteFilePath();
  QStringList all = recent_projects();
  all.removeAll(whole);
  all.prepend(whole);
  QSettings().setValue(QLatin1String(kRecentSetting), all.mid(0, kRecentCount));
}

void forget_project(const QString& path) {
  QStringList all = recent_projects();
  all.removeAll(QFileInfo(path).absoluteFilePath());
  QSettings().setValue(QLatin1String(kRecentSetting), all);
}

StartPage::StartPage(const Actions& actions, Jobs& jobs, QWidget* parent) : QWidget(parent), jobs_(jobs) {
  auto* middle = new QWidget(this);
  middle->setFixedWidth(kColumnWidth);
  auto* column = new QVBoxLayout(middle);
  column->setSpacing(12);
  auto* name = new QLabel(tr("Footwall Studio"), middle);
  QFont large = name->font();
  large.setPixelSize(26);
  name->setFont(large);
  column->addWidget(name);
  auto* what =
      new QLabel(tr("Interpret faults in 3D seismic data. Open a project, make one, or drop a file here: a "
                    "project, SEG-Y, fault sticks or a GOCAD surface."),
                 middle);
  what->setWordWrap(true);
  what->setForegroundRole(QPalette::PlaceholderText);
  column->addWidget(what);
  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(8);
  for (const char* id : {"file.open", "file.new-segy", "file.demo"}) {
    buttons->addWidget(button_of(actions, id, middle), 1);
  }
  column->addLayout(buttons);

  job_ = new QWidget(middle);
  auto* job_column = new QVBoxLayout(job_);
  job_column->setContentsMargins(0, 0, 0, 0);
  auto* job_row = new QHBoxLayout;
  job_text_ = new QLabel(job_);
  job_row->addWidget(job_text_, 1);
  auto* cancel = new QPushButton(tr("Cancel"), job_);
  connect(cancel, &QPushButton::clicked, this,
          [this] { jobs_.cancel(jobs_.data(jobs_.index(0), Jobs::kNumber).toInt()); });
  job_row->addWidget(cancel);
  job_column->addLayout(job_row);
  job_bar_ = new QProgressBar(job_);
  job_bar_->setTextVisible(false);
  job_bar_->setRange(0, 1000);
  job_column->addWidget(job_bar_);
  column->addWidget(job_);

  recent_title_ = new QLabel(tr("RECENT"), middle);
  recent_title_->setForegroundRole(QPalette::PlaceholderText);
  column->addWidget(recent_title_);
  recent_ = new QListWidget(middle);
  recent_->setUniformItemSizes(true);
  recent_->setTextElideMode(Qt::ElideMiddle);
  recent_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  connect(recent_, &QListWidget::itemActivated, this,
          [this](const QListWidgetItem* item) { Q_EMIT open_asked(item->data(Qt::UserRole).toString()); });
  connect(recent_, &QListWidget::itemClicked, this,
          [this](const QListWidgetItem* item) { Q_EMIT open_asked(item->data(Qt::UserRole).toString()); });
  column->addWidget(recent_);

  auto* whole = new QVBoxLayout(this);
  whole->addStretch(1);
  whole->addWidget(middle, 0, Qt::AlignHCenter);
  whole->addStretch(2);
  connect(&jobs_, &Jobs::dataChanged, this, &StartPage::show_job);
  connect(&jobs_, &Jobs::running_changed, this, &StartPage::show_job);
  list_recent();
  show_job();
}

void StartPage::list_recent() {
  for (const QString& path : recent_projects()) {
    const QFileInfo file(path);
    auto* item = new QListWidgetItem(QStringLiteral("%1    %2").arg(file.fileName(), file.path()), recent_);
    item->setData(Qt::UserRole, path);
    item->setToolTip(path);
    item->setSizeHint({0, kRowHeight});
    if (!file.exists()) item->setText(tr("%1    (not there)").arg(path));
  }
  const bool any = recent_->count() > 0;
  recent_title_->setVisible(any);
  recent_->setVisible(any);
  recent_->setFixedHeight(std::max(1, recent_->count()) * kRowHeight + 8);
}

void StartPage::show_job() {
  const bool runs = jobs_.running() > 0;
  job_->setVisible(runs);
  if (!runs) return;
  const QModelIndex newest = jobs_.index(0);
  job_text_->setText(QStringLiteral("%1  %2").arg(newest.data(Jobs::kTitle).toString(),
                                                  newest.data(Jobs::kPhase).toString()));
  job_bar_->setValue(static_cast<int>(1000 * newest.data(Jobs::kFraction).toDouble()));
}

}  // namespace footwall::ui
