#include "ui/window/tool_bar.h"

#include <QAction>
#include <QLayout>
#include <QMenu>
#include <QPainter>
#include <algorithm>

#include "engine/render/colour_map.h"
#include "ui/window/actions.h"

namespace footwall::ui {
namespace {

constexpr int kHeight = 28;
constexpr int kPadding = 10;
constexpr int kIconPixels = 16;
constexpr int kGap = 6;

QString text_of(std::string_view text) {
  return QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size()));
}

QIcon gradient(const QString& name) {
  constexpr QSize kSize{36, 12};
  QImage picture(kSize, QImage::Format_RGB32);
  try {
    const auto& table = render::ColourMap::named(name.toStdString()).table();
    for (int x = 0; x < kSize.width(); ++x) {
      const render::Rgba colour = table[static_cast<std::size_t>(x * 255 / (kSize.width() - 1))];
      for (int y = 0; y < kSize.height(); ++y)
        picture.setPixel(x, y,
                         qRgb(static_cast<int>(render::red(colour)), static_cast<int>(render::green(colour)),
                              static_cast<int>(render::blue(colour))));
    }
  } catch (const Error&) {
    picture.fill(Qt::gray);  // a map that this program does not know
  }
  return QIcon(QPixmap::fromImage(picture));
}

QString map_of(const Workbench& bench, const QString& statistic) {
  if (!bench.display.faces().colour_map.isEmpty()) return bench.display.faces().colour_map;
  for (const project::StatisticRecord& one : bench.surfaces.statistics()) {
    if (QString::fromStdString(one.name) == statistic) return QString::fromStdString(one.colour_map);
  }
  return QStringLiteral("viridis");
}

QString spoken(QString statistic) {
  if (statistic == QLatin1String("variance")) return QObject::tr("amplitude variance");
  return statistic.replace(QLatin1Char('_'), QLatin1Char(' '));
}

}  // namespace

ActionButton::ActionButton(QAction* action, Shows shows, QWidget* parent)
    : QToolButton(parent), shows_(shows) {
  setDefaultAction(action);
  setFocusPolicy(Qt::NoFocus);
}

void ActionButton::set_narrowness(int narrowness) {
  if (narrowness == narrowness_) return;
  narrowness_ = narrowness;
  updateGeometry();
  update();
}

bool ActionButton::is_icon_alone() const {
  return shows_ == Shows::kIcon || (shows_ == Shows::kName && narrowness_ > 0) ||
         (shows_ == Shows::kKey && narrowness_ > 1);
}

QString ActionButton::words() const {
  return is_icon_alone() ? QString() : defaultAction()->text().remove(QLatin1Char('&'));
}

QString ActionButton::key() const {
  return shows_ == Shows::kKey && !is_icon_alone()
             ? defaultAction()->shortcut().toString(QKeySequence::NativeText)
             : QString();
}

QSize ActionButton::sizeHint() const {
  const QFontMetrics metrics = fontMetrics();
  const int key_width = key().isEmpty() ? 0 : kGap + metrics.horizontalAdvance(key());
  if (is_icon_alone()) return {2 * kPadding + kIconPixels, kHeight};
  const int icon_width = is_prominent() ? 0 : kIconPixels + kGap;
  return {2 * kPadding + icon_width + metrics.horizontalAdvance(words()) + key_width, kHeight};
}

void ActionButton::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QPalette colours = palette();
  const QColor accent = colours.color(QPalette::Highlight);
  const QRectF frame = QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5);
  QColor text = colours.color(isEnabled() ? QPalette::WindowText : QPalette::PlaceholderText);
  if (is_prominent() && isEnabled()) {
    painter.setPen(Qt::NoPen);
    painter.setBrush(isDown() ? accent.darker(120) : underMouse() ? accent.lighter(110) : accent);
    painter.drawRoundedRect(frame, 4, 4);
    text = colours.color(QPalette::HighlightedText);
  } else if (isChecked()) {
    QColor tint = accent;
    tint.setAlphaF(0.25F);
    painter.setPen(accent);
    painter.setBrush(tint);
    painter.drawRoundedRect(frame, 4, 4);
  } else if (isEnabled() && (underMouse() || isDown() || is_prominent())) {
    painter.setPen(Qt::NoPen);
    painter.setBrush(colours.color(QPalette::Mid));
    painter.drawRoundedRect(frame, 4, 4);
  } else if (is_prominent()) {
    painter.setPen(colours.color(QPalette::Mid));
    painter.drawRoundedRect(frame, 4, 4);
  }
  int x = kPadding;
  if (!is_prominent()) {
    defaultAction()->icon().paint(&painter, QRect(x, (height() - kIconPixels) / 2, kIconPixels, kIconPixels),
                                  Qt::AlignCenter, isEnabled() ? QIcon::Normal : QIcon::Disabled);
    x += kIconPixels + kGap;
  }
  painter.setPen(text);
  const int width = fontMetrics().horizontalAdvance(words());
  painter.drawText(QRect(x, 0, width + 1, height()), Qt::AlignVCenter | Qt::AlignLeft, words());
  if (key().isEmpty()) return;
  painter.setPen(colours.color(QPalette::PlaceholderText));
  painter.drawText(QRect(x + width + kGap, 0, this->width() - x - width - kGap, height()),
                   Qt::AlignVCenter | Qt::AlignLeft, key());
}

ToolBar::ToolBar(const Actions& actions, QWidget* parent) : QToolBar(tr("Tools"), parent) {
  setObjectName(QStringLiteral("tools"));
  setMovable(false);
  using Shows = ActionButton::Shows;
  const auto add = [&](const char* id, Shows shows) {
    addWidget(new ActionButton(actions.action(QString::fromLatin1(id)), shows, this));
  };
  for (const char* id : {"file.new", "file.open"}) add(id, Shows::kIcon);
  addSeparator();
  for (const char* id : {"tool.select", "tool.pick", "tool.move"}) add(id, Shows::kKey);
  addSeparator();
  for (const char* id : {"view.inline", "view.crossline", "view.slice", "view.line"}) add(id, Shows::kName);
  addSeparator();
  colours_ = add_choice(tr("Colours of the sections"), [this](QMenu& menu) { fill_colour_maps(menu); });
  clip_ = add_choice(tr("Amplitudes beyond this percentile get the last colour"), [this](QMenu& menu) {
    for (const double percentile : {90.0, 95.0, 98.0, 99.0, 99.5, 99.9, 100.0}) {
      connect(menu.addAction(tr("clip %1 %").arg(percentile)), &QAction::triggered, this, [this, percentile] {
        SampleLook look = workbench_->display.samples();
        look.clip_percentile = percentile;
        workbench_->display.set_samples(look);
      });
    }
  });
  step_ = add_choice(tr("Lines that X and Z move by"), [this](QMenu& menu) {
    connect(menu.addAction(tr("step by the tool: 10 while picking, else 1")), &QAction::triggered, this,
            [this] { workbench_->display.set_own_step(std::nullopt); });
    for (const int lines : {1, 2, 5, 10, 20, 50}) {
      connect(menu.addAction(tr("step %1").arg(lines)), &QAction::triggered, this,
              [this, lines] { workbench_->display.set_own_step(lines); });
    }
  });
  addSeparator();
  statistic_ =
      add_choice(tr("What colours the faces of faults"), [this](QMenu& menu) { fill_statistics(menu); });
  auto* space = new QWidget(this);
  space->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  addWidget(space);
  for (const char* id : {"edit.undo", "edit.redo"}) add(id, Shows::kName);
  addSeparator();
  add("compute.update-all", Shows::kProminent);
}

void ToolBar::resizeEvent(QResizeEvent* event) {
  QToolBar::resizeEvent(event);
  fit_into_width();
}

// Names give way before a button does: what does not fit would hide in a menu at the end.
void ToolBar::fit_into_width() {
  const auto buttons = findChildren<ActionButton*>();
  constexpr int kNarrowest = 2;
  for (int narrowness = 0; narrowness <= kNarrowest; ++narrowness) {
    for (ActionButton* button : buttons) button->set_narrowness(narrowness);
    int needed = layout()->contentsMargins().left() + layout()->contentsMargins().right();
    for (QAction* action : actions())
      needed += widgetForAction(action)->sizeHint().width() + layout()->spacing();
    if (needed <= width()) return;
  }
}

QToolButton* ToolBar::add_choice(const QString& tip, const std::function<void(QMenu&)>& fill) {
  auto* button = new QToolButton(this);
  button->setToolTip(tip);
  button->setFocusPolicy(Qt::NoFocus);
  button->setPopupMode(QToolButton::InstantPopup);
  button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  button->setIconSize({36, 12});
  button->setFixedHeight(kHeight);
  button->setProperty("choice", true);
  auto* menu = new QMenu(button);
  connect(menu, &QMenu::aboutToShow, this, [this, menu, fill] {
    menu->clear();
    if (workbench_ != nullptr) fill(*menu);
  });
  button->setMenu(menu);
  addWidget(button);
  return button;
}

void ToolBar::fill_colour_maps(QMenu& menu) {
  for (const render::ColourMap& map : render::ColourMap::all()) {
    const QString name = text_of(map.name());
    QAction* one = menu.addAction(gradient(name), name);
    connect(one, &QAction::triggered, this, [this, name] {
      SampleLook look = workbench_->display.samples();
      look.colour_map = name;
      workbench_->display.set_samples(look);
    });
  }
}

void ToolBar::fill_statistics(QMenu& menu) {
  for (const project::StatisticRecord& one : workbench_->surfaces.statistics()) {
    const QString name = QString::fromStdString(one.name);
    QAction* action = menu.addAction(gradient(QString::fromStdString(one.colour_map)), spoken(name));
    action->setToolTip(QString::fromStdString(one.description));
    connect(action, &QAction::triggered, this, [this, name] {
      FaceLook look = workbench_->display.faces();
      look.colours = FaceColours::kStatistic;
      if (look.statistic != name)
        look = {.statistic = name, .colour_map = {}, .low = {}, .high = {}, .edges = look.edges};
      workbench_->display.set_faces(look);
    });
  }
  if (menu.isEmpty()) menu.addAction(tr("no statistics yet"))->setEnabled(false);
}

void ToolBar::show_workbench(Workbench* workbench) {
  if (workbench_ != nullptr) {
    workbench_->display.disconnect(this);
    workbench_->picking.disconnect(this);
  }
  workbench_ = workbench;
  if (workbench_ == nullptr) return;
  for (const auto signal : {&Display::samples_changed, &Display::faces_changed, &Display::scene_changed}) {
    connect(&workbench_->display, signal, this, &ToolBar::refresh);
  }
  connect(&workbench_->picking, &Picking::tool_changed, this, &ToolBar::refresh);  // for the step
  refresh();
}

void ToolBar::open(Choice choice) {
  QToolButton* button = choice == Choice::kColours ? colours_ : choice == Choice::kClip ? clip_ : statistic_;
  button->showMenu();
}

void ToolBar::refresh() {
  const Display& display = workbench_->display;
  colours_->setText(QLatin1Char(' ') + display.samples().colour_map);
  colours_->setIcon(gradient(display.samples().colour_map));
  clip_->setText(tr("clip %1 %").arg(display.samples().clip_percentile));
  step_->setText(tr("step %1").arg(workbench_->picking.step_lines()));
  switch (display.faces().colours) {
    case FaceColours::kStatistic:
      statistic_->setText(QLatin1Char(' ') + spoken(display.faces().statistic));
      statistic_->setIcon(gradient(map_of(*workbench_, display.faces().statistic)));
      break;
    case FaceColours::kVoxels:
      statistic_->setText(QLatin1Char(' ') + tr("voxel values"));
      statistic_->setIcon(gradient(display.samples().colour_map));
      break;
    case FaceColours::kPlain:
      statistic_->setText(tr("plain"));
      statistic_->setIcon({});
      break;
  }
  fit_into_width();
}

}  // namespace footwall::ui
