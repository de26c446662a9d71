#include "ui/window/view_tile.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "ui/window/line_dialog.h"
#include "ui/window/theme.h"

namespace footwall::ui {
namespace {

constexpr int kBarHeight = 24;
constexpr int kIconPixels = 14;

QToolButton* small_button(QWidget* bar, const QString& icon_name, const QString& tip) {
  auto* button = new QToolButton(bar);
  button->setAutoRaise(true);
  button->setFocusPolicy(Qt::NoFocus);
  button->setToolTip(tip);
  button->setIconSize({kIconPixels, kIconPixels});
  if (!icon_name.isEmpty()) button->setIcon(icon(icon_name));
  return button;
}

QToolButton* text_button(QWidget* bar, const QString& tip) {
  QToolButton* button = small_button(bar, {}, tip);
  button->setProperty("dim", true);
  button->setToolButtonStyle(Qt::ToolButtonTextOnly);
  return button;
}

const Display::ShownSection* shown(const Workbench& workbench, Id id) {
  const auto& all = workbench.display.sections();
  const auto found = std::ranges::find(all, id, &Display::ShownSection::id);
  return found == all.end() ? nullptr : &*found;
}

}  // namespace

ViewTile::ViewTile(Workbench& workbench, const ViewFactories& factories, Id section, QWidget* parent)
    : QFrame(parent), workbench_(workbench), section_(section) {
  setMinimumSize(160, 120);
  bar_ = new QWidget(this);
  bar_->setFixedHeight(kBarHeight);
  bar_->setAutoFillBackground(true);
  bar_->setBackgroundRole(QPalette::Base);
  bar_->installEventFilter(this);
  auto* row = new QHBoxLayout(bar_);
  row->setContentsMargins(8, 0, 4, 0);
  row->setSpacing(2);
  title_ = new QLabel(bar_);
  title_->setTextFormat(Qt::PlainText);
  title_->setMinimumWidth(40);
  row->addWidget(title_, 1);
  if (section_ != 0) {
    add_section_controls(*row);
  } else {
    add_scene_controls(*row);
  }
  QToolButton* larger =
      small_button(bar_, QStringLiteral("maximise"), tr("Maximise this view, or put it back (F10)"));
  connect(larger, &QToolButton::clicked, this, &ViewTile::maximise_asked);
  QToolButton* close = small_button(bar_, QStringLiteral("close"), tr("Close this view (Ctrl+Shift+W)"));
  connect(close, &QToolButton::clicked, this, &ViewTile::close_asked);
  row->addWidget(larger);
  row->addWidget(close);

  if (section_ != 0 && factories.section) view_ = factories.section(workbench_, section_, this);
  if (section_ == 0 && factories.scene) view_ = factories.scene(workbench_, this);
  built_ = view_ != nullptr;
  if (!built_) {
    auto* label = new QLabel(section_ == 0 ? tr("This program has no 3D scene: it was built without it.")
                                           : tr("This program has no section view: it was built without it."),
                             this);
    label->setAlignment(Qt::AlignCenter);
    label->setWordWrap(true);
    label->setForegroundRole(QPalette::PlaceholderText);
    label->setFocusPolicy(Qt::StrongFocus);
    view_ = label;
  }
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(bar_);
  if (section_ == 0) column->addWidget(import_ = make_import_strip());
  column->addWidget(view_, 1);
  setFocusProxy(view_);

  connect(&workbench_.display, &Display::sections_changed, this, &ViewTile::update_title);
  connect(&workbench_.display, &Display::samples_changed, this, &ViewTile::update_title);
  connect(&workbench_.display, &Display::scene_changed, this, &ViewTile::update_title);
  connect(&workbench_.document, &Document::volumes_changed, this, &ViewTile::update_title);
  connect(&workbench_.document, &Document::survey_changed, this, &ViewTile::update_title);
  update_title();
}

void ViewTile::add_section_controls(QHBoxLayout& bar) {
  volume_ = text_button(bar_, tr("The volume that sections show"));
  volume_->setPopupMode(QToolButton::InstantPopup);
  auto* menu = new QMenu(volume_);
  connect(menu, &QMenu::aboutToShow, this, [this, menu] {
    menu->clear();
    for (const project::VolumeRecord& volume : workbench_.document.volumes()) {
      QAction* one = menu->addAction(QString::fromStdString(volume.name));
      one->setCheckable(true);
      one->setChecked(volume.id == workbench_.display.volume());
      connect(one, &QAction::triggered, this, [this, id = volume.id] { workbench_.display.set_volume(id); });
    }
  });
  volume_->setMenu(menu);
  linked_ = text_button(bar_, tr("Linked views share cursor, zoom and place (L)"));
  linked_->setCheckable(true);
  connect(linked_, &QToolButton::clicked, this, [this](bool on) {
    change_section([](Display::ShownSection& shown, bool is) { shown.linked = is; }, on);
  });
  in_scene_ = small_button(bar_, QStringLiteral("plane"), tr("A plane of the scene, too (Ctrl+Alt+P)"));
  in_scene_->setCheckable(true);
  in_scene_->setObjectName(QStringLiteral("in-scene"));
  connect(in_scene_, &QToolButton::clicked, this, [this](bool on) {
    change_section([](Display::ShownSection& shown, bool is) { shown.in_scene = is; }, on);
  });
  ends_ = text_button(bar_, tr("The ends of the line as numbers (Ctrl+Alt+N)"));
  ends_->setText(tr("ends…"));
  connect(ends_, &QToolButton::clicked, this, [this] { open_line_dialog(workbench_, section_, window()); });
  for (QToolButton* button : {volume_, ends_, linked_, in_scene_}) bar.addWidget(button);
}

void ViewTile::change_section(void (*change)(Display::ShownSection& shown, bool on), bool on) {
  const Display::ShownSection* now = shown(workbench_, section_);
  if (now == nullptr) return;
  Display::ShownSection changed = *now;
  change(changed, on);
  workbench_.display.change_section(changed);
}

QWidget* ViewTile::make_import_strip() {
  auto* strip = new QWidget(this);
  auto* row = new QHBoxLayout(strip);
  row->setContentsMargins(8, 4, 8, 4);
  row->addWidget(new QLabel(tr("There is no survey yet."), strip), 1);
  auto* button = new QPushButton(tr("Import SEG-Y..."), strip);
  connect(button, &QPushButton::clicked, this,
          [this] { Q_EMIT action_asked(QStringLiteral("file.import")); });
  row->addWidget(button);
  return strip;
}

void ViewTile::add_scene_controls(QHBoxLayout& bar) {
  perspective_ = text_button(bar_, tr("Perspective or parallel projection (O)"));
  connect(perspective_, &QToolButton::clicked, this,
          [this] { workbench_.display.set_perspective(!workbench_.display.perspective()); });
  exaggeration_ = text_button(bar_, tr("Exaggeration of heights (Ctrl+Up, Ctrl+Down)"));
  exaggeration_->setPopupMode(QToolButton::InstantPopup);
  auto* menu = new QMenu(exaggeration_);
  for (const double factor : {0.5, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0}) {
    connect(menu->addAction(QStringLiteral("z × %1").arg(factor)), &QAction::triggered, this,
            [this, factor] { workbench_.display.set_exaggeration(factor); });
  }
  exaggeration_->setMenu(menu);
  run_ = text_button(bar_, {});
  run_->setObjectName(QStringLiteral("shown-run"));
  connect(run_, &QToolButton::clicked, this, [this] { workbench_.display.show_run(0); });
  connect(&workbench_.shown_numbers, &ShownNumbers::run_changed, this, &ViewTile::show_run);
  show_run();
  bar.addWidget(run_);
  bar.addWidget(perspective_);
  bar.addWidget(exaggeration_);
}

// As long as the faces show a run, which run it is; a click goes back to what is known now.
void ViewTile::show_run() {
  const auto& run = workbench_.shown_numbers.run();
  run_->setVisible(run.has_value());
  if (!run) return;
  constexpr int kWidest = 160;
  const QString words = words_for(*run);
  run_->setText(run_->fontMetrics().elidedText(words, Qt::ElideRight, kWidest) + QStringLiteral("  ×"));
  run_->setToolTip(
      tr("Faces show the numbers of %1. A click shows those known now again (Shift+R).").arg(words));
}

QString ViewTile::title() const {
  if (section_ == 0) return tr("Scene");
  const Display::ShownSection* now = shown(workbench_, section_);
  if (now == nullptr || !workbench_.document.survey()) return tr("Section");
  return title_of(now->section, *workbench_.document.survey());
}

void ViewTile::set_active(bool active) {
  title_->setForegroundRole(active ? QPalette::Highlight : QPalette::WindowText);
}

bool ViewTile::eventFilter(QObject* watched, QEvent* event) {
  if (watched == bar_ && event->type() == QEvent::MouseButtonDblClick) {
    Q_EMIT maximise_asked();
    return true;
  }
  if (watched == bar_ && event->type() == QEvent::MouseButtonPress) view_->setFocus(Qt::MouseFocusReason);
  return QFrame::eventFilter(watched, event);
}

// Texts are set where they differ: a label lays itself out anew with each.
void ViewTile::update_title() {
  if (title_->text() != title()) title_->setText(title());
  if (const Display::ShownSection* now = shown(workbench_, section_); now != nullptr) {
    QString volume = tr("no volume");
    for (const project::VolumeRecord& one : workbench_.document.volumes()) {
      if (one.id == workbench_.display.volume()) volume = QString::fromStdString(one.name);
    }
    if (volume_->text() != volume) volume_->setText(volume);
    linked_->setChecked(now->linked);
    in_scene_->setChecked(now->in_scene);
    ends_->setVisible(now->section.kind == Section::Kind::kLine && workbench_.document.survey());
    const QString linked = now->linked ? tr("linked") : tr("free");
    if (linked_->text() != linked) linked_->setText(linked);
  }
  if (section_ == 0) {
    import_->setVisible(!workbench_.document.survey());
    perspective_->setText(workbench_.display.perspective() ? tr("perspective") : tr("parallel"));
    exaggeration_->setText(QStringLiteral("z × %1").arg(workbench_.display.exaggeration(), 0, 'g', 3));
  }
}

}  // namespace footwall::ui
