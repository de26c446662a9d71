#include "ui/window/theme.h"

#include <QApplication>
#include <QFile>
#include <QIconEngine>
#include <QPainter>
#include <QPalette>
#include <QSettings>
#include <QStyleFactory>
#include <QSvgRenderer>

static void init_icons() {
  Q_INIT_RESOURCE(icons);
}

namespace footwall::ui {
namespace {

constexpr const char* kThemeSetting = "theme";
constexpr int kFontPixels = 13;

const ThemeColours kDark{QColor(0x1e2126), QColor(0x262a31), QColor(0x3a404a), QColor(0xd6dae0),
                         QColor(0x8d95a1), QColor(0x4aa3df), QColor(0xe0a458), QColor(0xe06c6c)};
const ThemeColours kLight{QColor(0xf4f5f7), QColor(0xffffff), QColor(0xd5d9df), QColor(0x23272e),
                          QColor(0x6b7480), QColor(0x1f78b4), QColor(0xb06a00), QColor(0xc0392b)};

QPalette palette_of(const ThemeColours& c) {
  QPalette palette(c.text, c.panel, c.line.lighter(120), c.line.darker(130), c.line, c.text, c.error, c.panel,
                   c.window);
  palette.setColor(QPalette::AlternateBase, c.window);
  palette.setColor(QPalette::PlaceholderText, c.dim);
  palette.setColor(QPalette::Highlight, c.accent);
  palette.setColor(QPalette::HighlightedText,
                   c.window.lightness() < 128 ? QColor(0x0d1117) : QColor(Qt::white));
  palette.setColor(QPalette::Link, c.accent);
  palette.setColor(QPalette::LinkVisited, c.warning);
  palette.setColor(QPalette::ToolTipBase, c.panel);
  palette.setColor(QPalette::ToolTipText, c.text);
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText}) {
    palette.setColor(QPalette::Disabled, role, c.dim);
  }
  return palette;
}

QString hex(const QColor& colour, double alpha = 1) {
  return QStringLiteral("rgba(%1,%2,%3,%4)")
      .arg(colour.red())
      .arg(colour.green())
      .arg(colour.blue())
      .arg(alpha);
}

// What Fusion draws heavier than the look wants.
QString sheet_of(const ThemeColours& c) {
  QString sheet = QStringLiteral(
      "QMainWindow::separator { background: @line; width: 1px; height: 1px; }"
      "QSplitter::handle { background: @line; }"
      "QMenuBar { background: @panel; border-bottom: 1px solid @line; padding: 2px 4px; }"
      "QMenuBar::item { padding: 3px 8px; border-radius: 4px; background: transparent; }"
      "QMenuBar::item:selected { background: @line; }"
      "QMenu { background: @panel; border: 1px solid @line; padding: 4px; }"
      "QMenu::item { padding: 4px 24px 4px 8px; border-radius: 3px; }"
      "QMenu::item:selected { background: @tint; }"
      "QMenu::item:disabled { color: @dim; }"
      "QMenu::icon { padding-left: 8px; }"
      "QMenu::icon:checked { background: @tint; border: 1px solid @accent; border-radius: 3px; }"
      "QTreeView { selection-background-color: transparent; }"
      "QMenu::separator { height: 1px; background: @line; margin: 4px 8px; }"
      "QToolBar { background: @panel; border: 0; border-bottom: 1px solid @line; padding: 5px 8px; spacing: "
      "4px; }"
      "QToolBar::separator { background: @line; width: 1px; margin: 4px 6px; }"
      "QStatusBar { background: @panel; border: 0; }"
      "QStatusBar::item { border: 0; }"
      "QTreeView, QListView { background: @panel; border: 0; outline: 0; }"
      "QScrollArea { background: @panel; border: 0; }"
      "QToolButton[choice=\"true\"] { border: 1px solid @line; border-radius: 4px; padding: 0 9px; }"
      "QToolButton[choice=\"true\"]:hover { border-color: @dim; }"
      "QToolButton[dim=\"true\"] { color: @dim; border: 0; padding: 1px 6px; background: transparent; }"
      "QToolButton[dim=\"true\"]:hover { color: @text; }"
      "QToolButton[choice=\"true\"]::menu-indicator, QToolButton[dim=\"true\"]::menu-indicator { image: "
      "none; }"
      "QScrollBar { background: @panel; width: 8px; height: 8px; margin: 0; border: 0; }"
      "QScrollBar::handle { background: @line; border-radius: 3px; margin: 1px; min-width: 24px; min-height: "
      "24px; }"
      "QScrollBar::handle:hover { background: @dim; }"
      "QScrollBar::add-line, QScrollBar::sub-line { width: 0; height: 0; }"
      "QScrollBar::add-page, QScrollBar::sub-page { background: transparent; }"
      "QPushButton { background: transparent; border: 1px solid @line; border-radius: 4px; padding: 4px "
      "12px; }"
      "QPushButton:hover { border-color: @dim; }"
      "QPushButton:pressed { background: @tint; }"
      "QPushButton:focus { border-color: @accent; }"
      "QPushButton:disabled { color: @dim; }"
      "QPushButton[primary=\"true\"] { background: @accent; color: @on; border-color: @accent; }"
      "QPushButton[warning=\"true\"] { color: @warning; border-color: @warning; }"
      "QProgressBar { background: @line; border: 0; border-radius: 2px; max-height: 4px; }"
      "QProgressBar::chunk { background: @accent; border-radius: 2px; }"
      "QToolTip { background: @panel; color: @text; border: 1px solid @line; padding: 3px; }");
  const std::pair<const char*, QString> words[] = {
      {"@line", hex(c.line)},     {"@panel", hex(c.panel)},
      {"@dim", hex(c.dim)},       {"@tint", hex(c.accent, 0.3)},
      {"@accent", hex(c.accent)}, {"@warning", hex(c.warning)},
      {"@text", hex(c.text)},     {"@on", hex(palette_of(c).color(QPalette::HighlightedText))}};
  for (const auto& [word, value] : words) sheet.replace(QLatin1String(word), value);
  return sheet;
}

// Draws the SVG in the text colour of the palette, whatever it is when it is painted.
class LineDrawing final : public QIconEngine {
 public:
  explicit LineDrawing(QByteArray svg) : svg_(std::move(svg)) {}

  void paint(QPainter* painter, const QRect& rect, QIcon::Mode mode, QIcon::State) override {
    const QPalette palette = QGuiApplication::palette();
    const QColor colour =
        mode == QIcon::Disabled ? palette.color(QPalette::PlaceholderText) : palette.color(QPalette::Text);
    QByteArray tinted = svg_;
    tinted.replace("#000000", colour.name().toLatin1());
    QSvgRenderer renderer(tinted);
    renderer.render(painter, rect);
  }
  QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) override {
    QPixmap picture(size);
    picture.fill(Qt::transparent);
    QPainter painter(&picture);
    paint(&painter, QRect(QPoint(), size), mode, state);
    return picture;
  }
  QIconEngine* clone() const override { return new LineDrawing(svg_); }
  QString key() const override { return QStringLiteral("footwall-line-drawing"); }

 private:
  QByteArray svg_;
};

}  // namespace

const ThemeColours& colours_of(Theme theme) {
  return theme == Theme::kDark ? kDark : kLight;
}

Theme remembered_theme() {
  const QString stored = QSettings().value(QLatin1String(kThemeSetting)).toString();
  return stored == QLatin1String("light") ? Theme::kLight : Theme::kDark;
}

Theme current_theme() {
  return QGuiApplication::palette().color(QPalette::Window).lightness() < 128 ? Theme::kDark : Theme::kLight;
}

void apply_theme(Theme theme) {
  QSettings().setValue(QLatin1String(kThemeSetting), theme == Theme::kDark ? "dark" : "light");
  QApplication::setStyle(QStyleFactory::create(QStringLiteral("Fusion")));
  QApplication::setPalette(palette_of(colours_of(theme)));
  QFont font = QApplication::font();
  font.setPixelSize(kFontPixels);
  QApplication::setFont(font);
  qApp->setStyleSheet(sheet_of(colours_of(theme)));
}

QIcon icon(const QString& name) {
  init_icons();
  QFile file(QStringLiteral(":/icons/%1.svg").arg(name));
  if (!file.open(QIODevice::ReadOnly)) return {};
  return QIcon(new LineDrawing(file.readAll()));
}

}  // namespace footwall::ui
