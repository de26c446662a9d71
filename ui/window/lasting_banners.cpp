// The window's banners for states that last.
#include <QFileInfo>
#include <QFileSystemWatcher>
#include <QTimer>
#include <algorithm>

#include "ui/window/banner.h"
#include "ui/window/dialogs.h"
#include "ui/window/main_window.h"

namespace footwall::ui {

void MainWindow::show_lasting_banners(const QString& held) {
  using Kind = BannerArea::Kind;
  const Document& document = workbench_->document;
  if (document.read_only()) show_read_only_banner(held);
  // Who holds it stands in the banner above.
  const std::vector<std::string> notices =
      held.isEmpty() ? document.project().notices() : std::vector<std::string>();
  for (std::size_t n = 0; n < notices.size(); ++n) {
    banners_->show_banner(QStringLiteral("notice-%1").arg(n),
                          {.kind = Kind::kNotice,
                           .text = QString::fromStdString(notices[n]),
                           .buttons = {{tr("Close"), [this, key = QStringLiteral("notice-%1").arg(n)] {
                                          banners_->remove(key);
                                        }}}});
  }
  for (const project::MissingFile& missing : document.project().missing()) {
    const QString volume = QString::fromStdString(missing.volume);
    banners_->show_banner(QStringLiteral("missing-%1").arg(volume),
                          {.kind = Kind::kWarning,
                           .text = tr("Volume missing: %1 (%2 %3).")
                                       .arg(volume, QString::fromStdString(missing.path.string()),
                                            QString::fromStdString(missing.reason)),
                           .buttons = {{tr("Relink…"), [this, volume] { relink_missing(volume); }}}});
  }
  warn_of_history(*this);
  show_engine_banner();
}

// held: by whom; empty: nobody has it, or it was taken over while it was open.
void MainWindow::show_read_only_banner(const QString& held) {
  const QString path = QString::fromStdString(workbench_->document.project().path().string());
  banners_->show_banner(QStringLiteral("read-only"),
                        {.kind = BannerArea::Kind::kWarning,
                         .text = held.isEmpty() ? tr("Read-only: this project cannot be written here.")
                                                : tr("Read-only: %1.").arg(held),
                         .hint = held.isEmpty() ? QString() : tr("changes made there are followed here"),
                         .buttons = {{tr("Try again"), [this, path] { open_project(path); }}}});
  if (watcher_ != nullptr) return;
  watcher_ = new QFileSystemWatcher({path}, this);
  if (QFileInfo::exists(path + QStringLiteral("-wal"))) watcher_->addPath(path + QStringLiteral("-wal"));
  // Started once: somebody who edits without a pause would put it off for ever.
  connect(watcher_, &QFileSystemWatcher::fileChanged, follow_, [this] {
    if (!follow_->isActive()) follow_->start();
  });
}

// A fault that has just lost its surface says why where the eye is, but not in the middle of a gesture.
void MainWindow::show_surface_banner() {
  const Id id = workbench_ ? workbench_->selection.active_fault() : 0;
  const Fault* fault = id != 0 ? workbench_->document.fault(id) : nullptr;
  if (fault != nullptr &&
      (workbench_->document.is_provisional(id) || workbench_->picking.active_pillar() != 0))
    return;
  const QString problem = fault != nullptr ? workbench_->surfaces.problem(id) : QString();
  if (problem.isEmpty() || fault->pillars.size() < 2 || workbench_->surfaces.surface(id))
    return banners_->remove(QStringLiteral("surface"));
  banners_->show_banner(
      QStringLiteral("surface"),
      {.kind = BannerArea::Kind::kWarning,
       .text = tr("%1 has no surface: %2").arg(QString::fromStdString(fault->record.name), problem)});
}

// Of an engine that has stopped, and of one that was never started in a project that has something to
// compute.
void MainWindow::show_engine_banner() {
  const auto state = workbench_ ? workbench_->engine.state() : EngineLink::State::kReady;
  const bool lost = state == EngineLink::State::kLost;
  const auto is_picture = [](const IsosurfaceLook& look) { return look.visible && look.as_picture; };
  const bool pictures = workbench_ && std::ranges::any_of(workbench_->display.isosurfaces(), is_picture);
  const bool off = state == EngineLink::State::kOff && workbench_->display.volume() != 0 &&
                   (pictures || !workbench_->document.faults().empty()) && !workbench_->engine.is_wanted();
  if (!lost && !off) return banners_->remove(QStringLiteral("engine"));
  const QDateTime last = workbench_->engine.answered_at();
  banners_->show_banner(
      QStringLiteral("engine"),
      {.kind = lost ? BannerArea::Kind::kWarning : BannerArea::Kind::kNotice,
       .text = lost ? tr("Engine %1.").arg(workbench_->engine.state_text()) : tr("The engine is off."),
       .hint = (last.isValid() ? tr("colours are from %1; faults can be edited all the same")
                                     .arg(last.toString(QStringLiteral("HH:mm")))
                               : tr("there are no live colours; faults can be edited all the same")) +
               (pictures ? tr("; isosurfaces that it draws are not there") : QString()),
       .buttons = {{lost ? tr("Restart") : tr("Start"), [this] {
                      if (workbench_) workbench_->engine.start();
                    }}}});
}

}  // namespace footwall::ui
