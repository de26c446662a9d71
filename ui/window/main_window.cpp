#include "ui/window/main_window.h"

#include <QCloseEvent>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QFileSystemWatcher>
#include <QJsonDocument>
#include <QKeyEvent>
#include <QLabel>
#include <QMenu>
#include <QMenuBar>
#include <QMimeData>
#include <QStatusBar>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>

#include "engine/tasks/new_project.h"
#include "engine/tasks/relink.h"
#include "storage/base/log.h"
#include "ui/model/fault_commands.h"
#include "ui/model/project_job.h"
#include "ui/window/actions.h"
#include "ui/window/assign_menu.h"
#include "ui/window/banner.h"
#include "ui/window/dialogs.h"
#include "ui/window/docks.h"
#include "ui/window/file_kinds.h"
#include "ui/window/import_files.h"
#include "ui/window/start_page.h"
#include "ui/window/status_line.h"
#include "ui/window/theme.h"
#include "ui/window/tool_bar.h"
#include "ui/window/view_area.h"
#include "ui/window/view_tile.h"

namespace footwall::ui {
namespace {

constexpr const char* kWindowSetting = "studio.window";
constexpr survey::Index kDemoSize{256, 256, 256};
constexpr std::uint64_t kDemoSeed = 7;
constexpr double kDemoSignalToNoise = 4;
constexpr int kFollowAfterMs = 200;
constexpr int kStoreLookMs = 3000;
constexpr int kMenuPadding = 8;

// Nothing where the project cannot tell: the window then looks as for a new one.
QJsonObject stored_look(const Document& document) {
  try {
    const auto stored = document.project().setting(kWindowSetting);
    return stored ? QJsonDocument::fromJson(QByteArray::fromStdString(*stored)).object() : QJsonObject();
  } catch (const Error& error) {
    log::warn("how the window looked could not be read: " + error.message());
    return {};
  }
}

}  // namespace

MainWindow::MainWindow(const EngineLink::Options& engine, QWidget* parent)
    : QMainWindow(parent), engine_(engine), start_jobs_(new Jobs(this)) {
  setAcceptDrops(true);
  setDockNestingEnabled(true);
  setContextMenuPolicy(Qt::NoContextMenu);
  actions_ = new Actions(*this);
  actions_->fill(*menuBar());
  project_name_ = new QLabel(this);
  project_name_->setContentsMargins(10, 0, 8, 0);
  QFont bold = project_name_->font();
  bold.setBold(true);
  project_name_->setFont(bold);
  engine_state_ = new QLabel(this);
  engine_state_->setTextFormat(Qt::RichText);
  engine_state_->setContentsMargins(8, 0, 12, 0);
  engine_state_->setAlignment(Qt::AlignVCenter | Qt::AlignRight);
  engine_state_->setMinimumHeight(project_name_->sizeHint().height() + kMenuPadding);
  menuBar()->setCornerWidget(project_name_, Qt::TopLeftCorner);
  menuBar()->setCornerWidget(engine_state_, Qt::TopRightCorner);
  tool_bar_ = new ToolBar(*actions_, this);
  addToolBar(tool_bar_);

  middle_ = new QWidget(this);
  auto* whole = new QVBoxLayout(middle_);
  whole->setContentsMargins(0, 0, 0, 0);
  whole->setSpacing(0);
  banners_ = new BannerArea(middle_);
  whole->addWidget(banners_);
  column_ = whole;
  setCentralWidget(middle_);
  status_ = new StatusLine(this);
  statusBar()->setSizeGripEnabled(false);
  statusBar()->addWidget(status_, 1);
  docks_ = new Docks(*this);
  follow_ = new QTimer(this);
  follow_->setSingleShot(true);
  follow_->setInterval(kFollowAfterMs);
  connect(follow_, &QTimer::timeout, this, &MainWindow::follow_changes);
  // An editor that is killed keeps its views and cameras, too.
  auto* keep_look = new QTimer(this);
  connect(keep_look, &QTimer::timeout, this, [this] {
    // A job that stores what it made would make the window wait.
    if (workbench_ && workbench_->jobs.running() == 0) store_look();
  });
  keep_look->start(kStoreLookMs);
  connect(start_jobs_, &Jobs::running_changed, actions_, &Actions::refresh);
  connect(start_jobs_, &Jobs::finished, this,
          [this](int, Jobs::State state, const QString& message, const QString& hint) {
            if (state == Jobs::State::kFailed) tell_failure(message, hint);
          });
  show_start_page();
}

MainWindow::~MainWindow() {
  store_look();
  docks_->show_workbench(nullptr);
  status_->show_workbench(nullptr);
  tool_bar_->show_workbench(nullptr);
  delete views_;
  views_ = nullptr;
  workbench_.reset();  // while those who hear of it are still there
}

bool MainWindow::open_project(const QString& path) {
  std::unique_ptr<Workbench> opened;
  QString held;
  const QString whole = QFileInfo(path).absoluteFilePath();
  // Its own lock would hold it.
  if (workbench_ &&
      QFileInfo(QString::fromStdString(workbench_->document.project().path().string())) == QFileInfo(whole)) {
    close_project();
  }
  try {
    opened = open_workbench(whole.toStdString(), engine_, &held);
  } catch (const Error& error) {
    tell_failure(QString::fromStdString(error.message()), QString::fromStdString(error.hint()));
    return false;
  } catch (const std::exception& error) {
    tell_failure(tr("cannot open %1: %2").arg(whole, QString::fromUtf8(error.what())), {});
    return false;
  }
  close_project();
  workbench_ = std::move(opened);
  remember_project(whole);
  banners_->clear();
  connect_workbench();
  show_workbench();
  try {
    show_lasting_banners(held);
  } catch (const Error& error) {
    tell_failure(QString::fromStdString(error.message()), QString::fromStdString(error.hint()));
  }
  return true;
}

void MainWindow::close_project() {
  if (!workbench_) return;
  store_look();
  delete watcher_;
  watcher_ = nullptr;
  follow_->stop();
  show_start_page();
  banners_->clear();
  workbench_.reset();
  show_title();
  show_engine_state();
  actions_->refresh();
}

void MainWindow::put_in_middle(QWidget* widget) {
  while (QLayoutItem* item = column_->takeAt(1)) {
    delete item->widget();
    delete item;
  }
  column_->addWidget(widget, 1);
}

void MainWindow::show_start_page() {
  views_ = nullptr;
  docks_->show_workbench(nullptr);
  status_->show_workbench(nullptr);
  tool_bar_->show_workbench(nullptr);
  tool_bar_->hide();
  auto* page = new StartPage(*actions_, *start_jobs_, middle_);
  // Later: opening takes the page away.
  connect(page, &StartPage::open_asked, this, &MainWindow::open_project, Qt::QueuedConnection);
  put_in_middle(page);
  show_title();
  show_engine_state();
  actions_->refresh();
}

void MainWindow::show_workbench() {
  const QJsonObject look = stored_look(workbench_->document);
  look_stored_ = {};
  views_ = new ViewArea(*workbench_, built_views(), look["views"].toObject(), middle_);
  connect(views_, &ViewArea::active_changed, actions_, &Actions::refresh);
  connect(views_, &ViewArea::action_asked, this,
          [this](const QString& action) { actions_->action(action)->trigger(); });
  put_in_middle(views_);
  docks_->show_workbench(workbench_.get());
  docks_->restore(look);
  status_->show_workbench(workbench_.get());
  tool_bar_->show_workbench(workbench_.get());
  tool_bar_->show();
  section_failed_ = false;
  if (ViewTile* tile = views_->active()) tile->view()->setFocus();
  show_title();
  show_engine_state();
  actions_->refresh();
}

void MainWindow::connect_workbench() {
  Workbench& bench = *workbench_;
  for (const auto signal : {&Document::faults_changed, &Document::history_changed, &Document::survey_changed,
                            &Document::volumes_changed}) {
    connect(&bench.document, signal, actions_, &Actions::refresh);
  }
  // Now and then: the sizes of all steps are added up.
  constexpr std::size_t kSteps = 256;
  connect(&bench.document, &Document::history_changed, this, [this, &document = bench.document] {
    if (document.history().size() % kSteps != 0) return;
    try {
      warn_of_history(*this);
    } catch (const Error& error) {
      tell_failure(QString::fromStdString(error.message()), QString::fromStdString(error.hint()));
    }
  });
  connect(&bench.selection, &Selection::changed, actions_, &Actions::refresh);
  connect(&bench.selection, &Selection::unassigned_caught, this, [this](const std::set<Id>& pillars) {
    make_assign_menu(*workbench_, pillars, views_)->popup(QCursor::pos());
  });
  connect(&bench.picking, &Picking::tool_changed, actions_, &Actions::refresh);
  connect(&bench.line, &LineDrawing::changed, actions_, &Actions::refresh);
  for (const auto signal : {&Display::samples_changed, &Display::faces_changed, &Display::scene_changed,
                            &Display::sections_changed}) {
    connect(&bench.display, signal, actions_, &Actions::refresh);
  }
  connect(&bench.jobs, &Jobs::running_changed, actions_, &Actions::refresh);
  connect(&bench.document, &Document::failed, this, &MainWindow::tell_failure);
  connect(&bench.document, &Document::became_read_only, this, [this] { show_read_only_banner({}); });
  connect(&bench.engine, &EngineLink::failed, this, &MainWindow::tell_failure);
  connect(&bench.engine, &EngineLink::state_changed, this, &MainWindow::show_engine_state);
  connect(&bench.engine, &EngineLink::state_changed, this, &MainWindow::show_engine_banner);
  connect(&bench.display, &Display::isosurfaces_changed, this, &MainWindow::show_engine_banner);
  connect(&bench.engine, &EngineLink::state_changed, actions_, &Actions::refresh);
  connect(&bench.surfaces, &Surfaces::surfaces_changed, this, &MainWindow::show_surface_banner);
  connect(&bench.selection, &Selection::active_fault_changed, this, &MainWindow::show_surface_banner);
  connect(&bench.picking, &Picking::active_pillar_changed, this, &MainWindow::show_surface_banner);
  connect(&bench.sections, &SectionReader::failed, this,
          [this](QObject*, const QString& message, const QString& hint) {
            section_failed_ = true;
            tell_failure(message, hint);
          });
  connect(&bench.jobs, &Jobs::finished, this,
          [this](int, Jobs::State state, const QString& message, const QString& hint) {
            if (state == Jobs::State::kFailed) tell_failure(message, hint);
          });
}

void MainWindow::relink_missing(const QString& volume) {
  const QString file = QFileDialog::getOpenFileName(this, tr("Where is the volume %1 now?").arg(volume), {},
                                                    tr("Volumes (*.h5);;All files (*)"));
  if (!file.isEmpty() && workbench_) relink(volume, file);
}

void MainWindow::relink(const QString& volume, const QString& file) {
  auto relinked = std::make_shared<QString>();
  try {
    start_on_project(
        *workbench_, tr("Relink %1").arg(volume.isEmpty() ? QFileInfo(file).fileName() : volume),
        [relinked, volume, file](project::Project& project, const JobContext&) {
          *relinked =
              QString::fromStdString(tasks::relink_volume(project, volume.toStdString(), file.toStdString()));
        },
        [this, relinked] { banners_->remove(QStringLiteral("missing-%1").arg(*relinked)); });
  } catch (const Error& error) {
    tell_failure(QString::fromStdString(error.message()), QString::fromStdString(error.hint()));
  }
}

void MainWindow::follow_changes() {
  if (!workbench_) return;
  workbench_->document.refresh();
  // Some programs replace the file, which ends the watch.
  const QString path = QString::fromStdString(workbench_->document.project().path().string());
  for (const QString& one : {path, path + QStringLiteral("-wal")}) {
    if (watcher_ != nullptr && QFileInfo::exists(one) && !watcher_->files().contains(one))
      watcher_->addPath(one);
  }
}

void MainWindow::show_engine_state() {
  if (!workbench_) return engine_state_->setText({});
  const QPalette colours = palette();
  QColor dot = colours.color(QPalette::PlaceholderText);
  QString text = workbench_->engine.state_text();
  switch (workbench_->engine.state()) {
    case EngineLink::State::kOff:
      if (text.isEmpty()) text = tr("not running");
      break;
    case EngineLink::State::kStarting:
      dot = colours.color(QPalette::LinkVisited);
      if (text.isEmpty()) text = tr("starting");
      break;
    case EngineLink::State::kReady:
      dot = QColor(0x5c, 0xb8, 0x5c);
      break;
    case EngineLink::State::kBusy:
      dot = colours.color(QPalette::Link);
      break;
    case EngineLink::State::kLost:
      dot = colours.color(QPalette::BrightText);
      break;
  }
  const QString saved = workbench_->document.read_only() ? tr("read-only") : tr("saved: every gesture");
  engine_state_->setText(
      QStringLiteral("<span style='color:%1'>●</span> <span style='color:%2'>%3&nbsp;&nbsp; %4</span>")
          .arg(dot.name(), colours.color(QPalette::PlaceholderText).name(),
               tr("engine: %1").arg(text).toHtmlEscaped(), saved.toHtmlEscaped()));
  menuBar()->adjustSize();
}

void MainWindow::show_title() {
  const QString path =
      workbench_ ? QString::fromStdString(workbench_->document.project().path().string()) : QString();
  const QString name = QFileInfo(path).fileName();
  project_name_->setText(name.isEmpty() ? tr("Footwall Studio") : name);
  setWindowTitle(name.isEmpty() ? tr("Footwall Studio") : tr("%1 - Footwall Studio").arg(name));
  setWindowFilePath(path);
}

void MainWindow::store_look() {
  if (!workbench_ || views_ == nullptr || workbench_->document.read_only()) return;
  QJsonObject look = docks_->look();
  look["views"] = views_->layout();
  if (std::exchange(look_stored_, look) == look) return;
  try {
    workbench_->document.store().set_setting(
        kWindowSetting, QJsonDocument(look).toJson(QJsonDocument::Compact).toStdString());
  } catch (const Error& error) {
    log::warn("how the window looked could not be stored: " + error.message());
  }
}

void MainWindow::tell_failure(const QString& message, const QString& hint) {
  banners_->show_banner(QStringLiteral("failure"),
                        {.kind = BannerArea::Kind::kError, .text = message, .hint = hint, .passes = true});
}

void MainWindow::take_file(const QString& path) {
  switch (kind_of_file(path)) {
    case FileKind::kProject:
      open_project(path);
      return;
    case FileKind::kVolume:
      import_volume(*this, path, workbench_ == nullptr);
      return;
    case FileKind::kSticks:
    case FileKind::kSurface:
      import_interpretation(*this, path);
      return;
    case FileKind::kUnknown:
      break;
  }
  tell_failure(tr("%1 is no file that Footwall knows").arg(QFileInfo(path).fileName()),
               tr("projects, SEG-Y, NRRD, fault sticks and GOCAD surfaces can be dropped here"));
}

void MainWindow::make_demo(const QString& path) {
  start_jobs_->start(
      tr("Synthetic demo"),
      [path](const JobContext& job) {
        tasks::new_synthetic_project(path.toStdString(), "faulted", kDemoSize, kDemoSeed, kDemoSignalToNoise,
                                     job);
      },
      [this, path] { open_project(path); });
}

bool MainWindow::is_settled() const {
  if (start_jobs_->running() > 0) return false;
  if (!workbench_ || views_ == nullptr) return true;
  const EngineLink::State engine = workbench_->engine.state();
  if (engine == EngineLink::State::kStarting || engine == EngineLink::State::kBusy) return false;
  if (workbench_->jobs.running() > 0) return false;
  const Id volume = workbench_->display.volume();
  bool shows_faults = false;
  for (const ViewTile* tile : views_->tiles()) {
    shows_faults = shows_faults || tile->is_built();
    const auto& scene_settled = views_->factories().is_settled;
    if (tile->is_built() && tile->section() == 0 && scene_settled && !scene_settled(*tile->view()))
      return false;
    if (!tile->is_built() || tile->section() == 0 || volume == 0 || section_failed_) continue;
    const auto& sections = workbench_->display.sections();
    const auto shown = std::ranges::find(sections, tile->section(), &Display::ShownSection::id);
    if (shown != sections.end() && !workbench_->sections.kept(volume, shown->section)) return false;
  }
  return !shows_faults || std::ranges::all_of(workbench_->document.faults(), [this](const Fault& fault) {
    const Id id = fault.record.id;
    return fault.pillars.size() < 2 || is_unassigned(fault) || !workbench_->document.survey() ||
           workbench_->surfaces.surface(id) || !workbench_->surfaces.problem(id).isEmpty();
  });
}

// Enter is a shortcut over the views alone: in a panel it belongs to the list or field there.
bool MainWindow::event(QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride) {
    const auto& pressed = *static_cast<QKeyEvent*>(event);
    const bool enter = (pressed.key() == Qt::Key_Return || pressed.key() == Qt::Key_Enter) &&
                       (pressed.modifiers() & ~Qt::KeypadModifier) == 0;
    const QWidget* focus = focusWidget();
    const bool in_views =
        focus == nullptr || focus == this || (views_ != nullptr && views_->isAncestorOf(focus));
    if (enter && !in_views) {
      event->accept();
      return true;
    }
  }
  return QMainWindow::event(event);
}

void MainWindow::closeEvent(QCloseEvent* event) {
  close_project();
  event->accept();
}

void MainWindow::changeEvent(QEvent* event) {
  QMainWindow::changeEvent(event);
  if (event->type() == QEvent::PaletteChange && engine_state_ != nullptr) show_engine_state();
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  const QList<QUrl> urls = event->mimeData()->urls();
  if (std::ranges::any_of(urls, [](const QUrl& url) { return url.isLocalFile(); }))
    event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  for (const QUrl& url : event->mimeData()->urls()) {
    if (url.isLocalFile()) take_file(url.toLocalFile());
  }
  event->acceptProposedAction();
}

}  // namespace footwall::ui
