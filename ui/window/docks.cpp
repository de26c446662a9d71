#include "ui/window/docks.h"

#include <QDockWidget>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>
#include <algorithm>

#include "ui/panels/history_panel.h"
#include "ui/panels/inspector_panel.h"
#include "ui/panels/jobs_panel.h"
#include "ui/panels/project_panel.h"
#include "ui/window/actions.h"
#include "ui/window/dialogs.h"
#include "ui/window/main_window.h"
#include "ui/window/put_back.h"
#include "ui/window/saved_views.h"
#include "ui/window/theme.h"

namespace footwall::ui {
namespace {

constexpr std::array kPanels{Panel::kProject, Panel::kInspector, Panel::kJobs, Panel::kHistory};
constexpr int kStateVersion = 1;

// A slim heading; presses go through to the dock, which is moved by it.
QWidget* heading(QDockWidget* dock) {
  auto* bar = new QWidget(dock);
  bar->setAutoFillBackground(true);
  bar->setBackgroundRole(QPalette::Base);
  auto* row = new QHBoxLayout(bar);
  row->setContentsMargins(12, 4, 4, 2);
  auto* title = new QLabel(dock->windowTitle().toUpper(), bar);
  title->setForegroundRole(QPalette::PlaceholderText);
  QFont font = title->font();
  font.setPixelSize(11);
  font.setBold(true);
  font.setLetterSpacing(QFont::PercentageSpacing, 108);
  title->setFont(font);
  row->addWidget(title, 1);
  auto* close = new QToolButton(bar);
  close->setAutoRaise(true);
  close->setFocusPolicy(Qt::NoFocus);
  close->setIcon(icon(QStringLiteral("close")));
  close->setIconSize({10, 10});
  close->setToolTip(QObject::tr("Close this panel; the Window menu opens it again"));
  QObject::connect(close, &QToolButton::clicked, dock, &QDockWidget::close);
  row->addWidget(close);
  return bar;
}

}  // namespace

Docks::Docks(MainWindow& window) : QObject(&window), window_(window) {
  const std::array names{tr("Project"), tr("Inspector"), tr("Jobs"), tr("History")};
  const std::array ids{"dock.project", "dock.inspector", "dock.jobs", "dock.history"};
  for (std::size_t n = 0; n < docks_.size(); ++n) {
    auto* dock = new QDockWidget(names[n], &window_);
    dock->setObjectName(QString::fromLatin1(ids[n]));
    dock->setTitleBarWidget(heading(dock));
    connect(dock, &QDockWidget::visibilityChanged, &window_.actions(), &Actions::refresh);
    docks_[n] = dock;
  }
  window_.setCorner(Qt::BottomLeftCorner, Qt::BottomDockWidgetArea);
  window_.setCorner(Qt::BottomRightCorner, Qt::BottomDockWidgetArea);
  put_back();
  for (QDockWidget* dock : docks_) dock->hide();
}

void Docks::put_back() {
  window_.addDockWidget(Qt::LeftDockWidgetArea, dock(Panel::kProject));
  window_.addDockWidget(Qt::RightDockWidgetArea, dock(Panel::kInspector));
  window_.addDockWidget(Qt::BottomDockWidgetArea, dock(Panel::kJobs));
  window_.splitDockWidget(dock(Panel::kJobs), dock(Panel::kHistory), Qt::Horizontal);
  for (QDockWidget* one : docks_) {
    one->setFloating(false);
    one->show();
  }
  window_.resizeDocks({dock(Panel::kProject), dock(Panel::kInspector)}, {230, 260}, Qt::Horizontal);
  window_.resizeDocks({dock(Panel::kJobs), dock(Panel::kHistory)}, {900, 420}, Qt::Horizontal);
  window_.resizeDocks({dock(Panel::kJobs)}, {116}, Qt::Vertical);
  hidden_.clear();
}

void Docks::show_workbench(Workbench* workbench) {
  for (QDockWidget* one : docks_) {
    delete one->widget();
    if (workbench == nullptr) one->hide();
  }
  if (workbench == nullptr) return;
  const auto action = [this](const QString& id) { return window_.actions().action(id); };
  auto* project = new ProjectPanel(*workbench, action);
  connect(project, &ProjectPanel::view_asked, this,
          [this](const QString& name) { restore_view(window_, name); });
  connect(project, &ProjectPanel::isosurface_asked, this,
          [this](Id isosurface) { open_isosurface_dialog(window_, isosurface); });
  connect(&project->tree(), &ProjectTree::removed_changed, project,
          [this, project] { show_what_was_removed(window_, project->tree()); });
  dock(Panel::kProject)->setWidget(project);
  dock(Panel::kInspector)->setWidget(new InspectorPanel(*workbench, action));
  dock(Panel::kJobs)->setWidget(new JobsPanel({&workbench->jobs, &window_.start_jobs()}));
  dock(Panel::kHistory)->setWidget(new HistoryPanel(*workbench));
}

bool Docks::is_open(Panel panel) const {
  return !dock(panel)->isHidden();
}

void Docks::step_to(Panel panel) {
  QWidget* widget = dock(panel)->widget();
  const QWidget* focus = window_.focusWidget();
  const bool inside =
      widget != nullptr && focus != nullptr && (focus == widget || widget->isAncestorOf(focus));
  open(panel, !is_open(panel) || !inside);
  if (is_open(panel) && widget != nullptr) widget->setFocus(Qt::ShortcutFocusReason);
}

void Docks::open(Panel panel, bool on) {
  hidden_.clear();
  dock(panel)->setVisible(on);
  if (on) dock(panel)->raise();
}

bool Docks::all_hidden() const {
  return std::ranges::none_of(kPanels, [this](Panel panel) { return is_open(panel); });
}

void Docks::toggle_all() {
  if (!all_hidden()) {
    hidden_.clear();
    for (const Panel panel : kPanels) {
      if (!is_open(panel)) continue;
      hidden_.push_back(panel);
      dock(panel)->hide();
    }
    return;
  }
  if (hidden_.empty()) hidden_.assign(kPanels.begin(), kPanels.end());
  for (const Panel panel : hidden_) dock(panel)->show();
  hidden_.clear();
}

QJsonObject Docks::look() const {
  return {{"docks", QString::fromLatin1(window_.saveState(kStateVersion).toBase64())}};
}

void Docks::restore(const QJsonObject& look) {
  const QByteArray state = QByteArray::fromBase64(look["docks"].toString().toLatin1());
  if (!window_.restoreState(state, kStateVersion)) put_back();
}

}  // namespace footwall::ui
