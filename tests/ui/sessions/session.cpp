#include "ui/sessions/session.h"

#include <QAction>
#include <QApplication>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QTest>
#include <QWheelEvent>
#include <cmath>

#include "storage/base/error.h"
#include "ui/scene3d/scene_view.h"
#include "ui/section/section_view.h"
#include "ui/window/actions.h"
#include "ui/window/main_window.h"
#include "ui/window/view_area.h"
#include "ui/window/view_tile.h"

namespace footwall::ui {
namespace {

constexpr int kPatience = 30000;
constexpr quint64 kMillisecondsApart =
    60;  // of two events, as views see it: a stroke of five moves is a slow one

const std::array<std::pair<Section::Kind, QString>, 3> kKinds{
    std::pair{Section::Kind::kInline, QStringLiteral("inline")},
    {Section::Kind::kCrossline, QStringLiteral("crossline")},
    {Section::Kind::kSlice, QStringLiteral("slice")}};

SectionCanvas* canvas_of(const MainWindow& window, Section::Kind kind) {
  for (const auto& shown : window.workbench()->display.sections()) {
    if (shown.section.kind != kind) continue;
    for (SectionCanvas* canvas : window.findChildren<SectionCanvas*>()) {
      if (canvas->section() == shown.section) return canvas;
    }
  }
  return nullptr;
}

SceneView* scene_of(const MainWindow& window) {
  const ViewTile* tile = window.views() == nullptr ? nullptr : window.views()->scene();
  return tile == nullptr ? nullptr : qobject_cast<SceneView*>(tile->view());
}

// "dock.history" or "QWidget#2": its name, or its class and which of its kind it is below its parent.
QString label_of(const QWidget& widget) {
  if (!widget.objectName().isEmpty()) return widget.objectName();
  int number = 0;
  for (const QObject* other : widget.parentWidget()->children()) {
    if (other == &widget) break;
    const bool alike =
        other->isWidgetType() && other->objectName().isEmpty() && other->metaObject() == widget.metaObject();
    number += alike ? 1 : 0;
  }
  return QStringLiteral("%1#%2").arg(QString::fromLatin1(widget.metaObject()->className())).arg(number);
}

QString name_of(const MainWindow& window, const QWidget& widget) {
  for (const auto& [kind, name] : kKinds) {
    if (canvas_of(window, kind) == &widget) return name;
  }
  if (scene_of(window) == &widget) return QStringLiteral("scene");
  QString path;
  for (const QWidget* at = &widget; at != nullptr && at != &window; at = at->parentWidget())
    path = path.isEmpty() ? label_of(*at) : label_of(*at) + u'/' + path;
  return path;
}

QWidget* widget_of(MainWindow& window, const QString& name) {
  for (const auto& [kind, of_kind] : kKinds) {
    if (name == of_kind) return canvas_of(window, kind);
  }
  if (name == QStringLiteral("scene")) return scene_of(window);
  QWidget* at = &window;
  for (const QString& part : name.split(u'/', Qt::SkipEmptyParts)) {
    QWidget* found = nullptr;
    for (QObject* child : at->children()) {
      auto* widget = qobject_cast<QWidget*>(child);
      if (widget != nullptr && found == nullptr && label_of(*widget) == part) found = widget;
    }
    if (found == nullptr) return nullptr;
    at = found;
  }
  return at;
}

[[noreturn]] void refuse(const QJsonObject& line, const QString& why) {
  const QByteArray text = QJsonDocument(line).toJson(QJsonDocument::Compact);
  throw Error(ErrorCode::kInvalid, QStringLiteral("%1: %2").arg(QString::fromUtf8(text), why).toStdString());
}

QPointF pixel_of(QWidget& widget, const QJsonObject& line) {
  const QJsonArray pixel = line["pixel"].toArray();
  if (pixel.size() == 2) return {pixel[0].toDouble(), pixel[1].toDouble()};
  const QJsonArray at = line["at"].toArray();
  if (auto* canvas = qobject_cast<SectionCanvas*>(&widget); canvas != nullptr && at.size() == 2)
    return canvas->view().to_pixels({at[0].toDouble(), at[1].toDouble()});
  if (auto* scene = qobject_cast<SceneView*>(&widget); scene != nullptr && at.size() == 3) {
    const auto place = scene->pixel_of({at[0].toDouble(), at[1].toDouble(), at[2].toDouble()});
    if (place) return *place;
  }
  refuse(line, QStringLiteral("no place"));
}

Qt::MouseButton button_of(const QJsonObject& line) {
  const QString name = line["button"].toString();
  if (name == QStringLiteral("none")) return Qt::NoButton;
  if (name == QStringLiteral("middle")) return Qt::MiddleButton;
  return name == QStringLiteral("right") ? Qt::RightButton : Qt::LeftButton;
}

const std::array<std::pair<Qt::KeyboardModifier, QString>, 3> kModifiers{
    std::pair{Qt::ShiftModifier, QStringLiteral("Shift")},
    {Qt::ControlModifier, QStringLiteral("Ctrl")},
    {Qt::AltModifier, QStringLiteral("Alt")}};

Qt::KeyboardModifiers modifiers_of(const QJsonObject& line) {
  Qt::KeyboardModifiers modifiers;
  for (const auto& [modifier, name] : kModifiers) {
    if (line["keys"].toString().split(u'+').contains(name)) modifiers |= modifier;
  }
  return modifiers;
}

void add_modifiers(QJsonObject& line, Qt::KeyboardModifiers modifiers) {
  QStringList names;
  for (const auto& [modifier, name] : kModifiers) {
    if (modifiers.testFlag(modifier)) names << name;
  }
  if (!names.isEmpty()) line["keys"] = names.join(u'+');
}

void send_mouse(QEvent::Type type, QWidget& widget, const QJsonObject& line, quint64 time) {
  const QPointF at = pixel_of(widget, line);
  const Qt::MouseButton button = button_of(line);
  const bool moves = type == QEvent::MouseMove;
  const Qt::MouseButtons held = type == QEvent::MouseButtonRelease ? Qt::NoButton : button;
  QMouseEvent event(type, at, widget.mapToGlobal(at), moves ? Qt::NoButton : button, held,
                    modifiers_of(line));
  event.setTimestamp(time);
  QApplication::sendEvent(&widget, &event);
}

void send_key(QEvent::Type type, QWidget& widget, const QJsonObject& line, quint64 time) {
  const auto keys = QKeySequence::fromString(line["key"].toString(), QKeySequence::PortableText);
  if (keys.isEmpty()) refuse(line, QStringLiteral("no such key"));
  const Qt::Key key = keys[0].key();
  const bool prints = key >= Qt::Key_Space && key <= Qt::Key_AsciiTilde;
  QKeyEvent event(type, key, modifiers_of(line), prints ? QString(QChar(key)).toLower() : QString());
  event.setTimestamp(time);
  QApplication::sendEvent(&widget, &event);
}

void play_line(MainWindow& window, const QJsonObject& line, quint64 time) {
  const QString what = line["do"].toString();
  if (what == QStringLiteral("action")) {
    QAction* action = window.actions().action(line["id"].toString());
    if (action == nullptr || !action->isEnabled()) refuse(line, QStringLiteral("no such action now"));
    return action->trigger();
  }
  QWidget* widget = widget_of(window, line["in"].toString());
  if (widget == nullptr) refuse(line, QStringLiteral("no such view or widget"));
  if (what == QStringLiteral("press")) return send_mouse(QEvent::MouseButtonPress, *widget, line, time);
  if (what == QStringLiteral("move")) return send_mouse(QEvent::MouseMove, *widget, line, time);
  if (what == QStringLiteral("release")) return send_mouse(QEvent::MouseButtonRelease, *widget, line, time);
  if (what == QStringLiteral("double")) return send_mouse(QEvent::MouseButtonDblClick, *widget, line, time);
  if (what == QStringLiteral("key")) return send_key(QEvent::KeyPress, *widget, line, time);
  if (what == QStringLiteral("keyup")) return send_key(QEvent::KeyRelease, *widget, line, time);
  if (what != QStringLiteral("wheel")) refuse(line, QStringLiteral("what is that?"));
  const QPointF at = pixel_of(*widget, line);
  QWheelEvent event(at, widget->mapToGlobal(at), {}, {0, line["by"].toInt()}, Qt::NoButton,
                    modifiers_of(line), Qt::NoScrollPhase, false);
  event.setTimestamp(time);
  QApplication::sendEvent(widget, &event);
}

double rounded(double value) {
  return std::round(value * 100) / 100;
}

}  // namespace

std::vector<QJsonObject> read_session(const QString& path) {
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly)) throw Error(ErrorCode::kIo, "cannot read " + path.toStdString());
  std::vector<QJsonObject> lines;
  for (int number = 1; !file.atEnd(); ++number) {
    const QByteArray text = file.readLine().trimmed();
    if (text.isEmpty() || text.startsWith('#')) continue;
    const QJsonDocument json = QJsonDocument::fromJson(text);
    if (!json.isObject())
      throw Error(ErrorCode::kFormat,
                  path.toStdString() + ":" + std::to_string(number) + " is no JSON object");
    lines.push_back(json.object());
  }
  return lines;
}

void write_session(const QString& path, const std::vector<QJsonObject>& lines) {
  QFile file(path);
  if (!file.open(QIODevice::WriteOnly)) throw Error(ErrorCode::kIo, "cannot write " + path.toStdString());
  for (const QJsonObject& line : lines) file.write(QJsonDocument(line).toJson(QJsonDocument::Compact) + "\n");
}

void play(MainWindow& window, const std::vector<QJsonObject>& lines) {
  quint64 time = 1000;
  for (const QJsonObject& line : lines) {
    // What lies under the mouse depends on surfaces that are made on threads.
    const QString what = line["do"].toString();
    const bool is_under_way = what == QStringLiteral("move") || what == QStringLiteral("release");
    if (!is_under_way && !QTest::qWaitFor([&] { return window.is_settled(); }, kPatience))
      refuse(line, QStringLiteral("the window did not come to rest before it"));
    play_line(window, line, time += kMillisecondsApart);
    QCoreApplication::processEvents();
  }
}

QString text_after(const MainWindow& window) {
  const Document& document = window.workbench()->document;
  QString text;
  for (const Fault& fault : document.faults()) {
    text += QStringLiteral("fault %1\n").arg(QString::fromStdString(fault.record.name));
    for (const survey::Pillar& pillar : fault.pillars) {
      text += QStringLiteral("  pillar\n");
      for (const survey::PillarNode& node : pillar.nodes) {
        const survey::IndexPoint p = document.survey()->index_of(node.position);
        text += QStringLiteral("    %1 %2 %3\n").arg(p.i, 0, 'f', 1).arg(p.j, 0, 'f', 1).arg(p.k, 0, 'f', 1);
      }
    }
  }
  for (const project::HistoryStep& step : document.history())
    text += QStringLiteral("%1 %2\n").arg(step.undone ? QStringLiteral("undone") : QStringLiteral("done"),
                                          QString::fromStdString(step.name));
  return text;
}

SessionRecorder::SessionRecorder(MainWindow& window) : window_(window) {
  for (QAction* action : window.QWidget::actions()) {
    connect(action, &QAction::triggered, this, [this, id = action->objectName()] {
      lines_.push_back({{"do", "action"}, {"id", id}});
    });
  }
  qApp->installEventFilter(this);
}

SessionRecorder::~SessionRecorder() {
  qApp->removeEventFilter(this);
}

void SessionRecorder::add_place(QJsonObject& line, QWidget& widget, const QPointF& pixel) const {
  if (auto* canvas = qobject_cast<SectionCanvas*>(&widget); canvas != nullptr) {
    const PlanePoint at = canvas->view().to_plane(pixel);
    line["at"] = QJsonArray{rounded(at.u), rounded(at.v)};
    return;
  }
  if (auto* scene = qobject_cast<SceneView*>(&widget); scene != nullptr) {
    const SceneView::Under under = scene->under(pixel);
    if (under.hit) {
      line["at"] = QJsonArray{rounded(under.place.i), rounded(under.place.j), rounded(under.place.k)};
      return;
    }
  }
  line["pixel"] = QJsonArray{pixel.x(), pixel.y()};
}

void SessionRecorder::add_mouse(const char* what, QWidget& widget, const QMouseEvent& event) {
  const bool moves = event.type() == QEvent::MouseMove;
  if (moves && event.buttons() == Qt::NoButton) return;  // pointing alone changes nothing
  QJsonObject line{{"do", what}, {"in", name_of(window_, widget)}};
  add_place(line, widget, event.position());
  const Qt::MouseButtons buttons = moves ? event.buttons() : Qt::MouseButtons(event.button());
  if (buttons.testFlag(Qt::MiddleButton)) line["button"] = "middle";
  if (buttons.testFlag(Qt::RightButton)) line["button"] = "right";
  add_modifiers(line, event.modifiers());
  lines_.push_back(line);
}

bool SessionRecorder::eventFilter(QObject* watched, QEvent* event) {
  auto* widget = qobject_cast<QWidget*>(watched);
  if (widget == nullptr || widget == &window_ || !window_.isAncestorOf(widget)) return false;
  const QEvent::Type type = event->type();
  const bool is_mouse = type == QEvent::MouseButtonPress || type == QEvent::MouseMove ||
                        type == QEvent::MouseButtonRelease || type == QEvent::MouseButtonDblClick;
  const bool is_key = type == QEvent::KeyPress || type == QEvent::KeyRelease;
  if (!is_mouse && !is_key && type != QEvent::Wheel) return false;
  const quint64 time = static_cast<QInputEvent*>(event)->timestamp();
  if (time == seen_at_ && type == seen_type_) return false;
  seen_at_ = time;
  seen_type_ = type;
  if (type == QEvent::MouseButtonPress) add_mouse("press", *widget, *static_cast<QMouseEvent*>(event));
  if (type == QEvent::MouseMove) add_mouse("move", *widget, *static_cast<QMouseEvent*>(event));
  if (type == QEvent::MouseButtonRelease) add_mouse("release", *widget, *static_cast<QMouseEvent*>(event));
  if (type == QEvent::MouseButtonDblClick) add_mouse("double", *widget, *static_cast<QMouseEvent*>(event));
  if (is_key) {
    const auto& key = *static_cast<QKeyEvent*>(event);
    if (key.isAutoRepeat() && type == QEvent::KeyRelease) return false;
    QJsonObject line{{"do", type == QEvent::KeyPress ? "key" : "keyup"}, {"in", name_of(window_, *widget)}};
    line["key"] = QKeySequence(key.key()).toString(QKeySequence::PortableText);
    add_modifiers(line, key.modifiers());
    lines_.push_back(line);
  }
  if (type == QEvent::Wheel) {
    const auto& wheel = *static_cast<QWheelEvent*>(event);
    QJsonObject line{{"do", "wheel"}, {"in", name_of(window_, *widget)}, {"by", wheel.angleDelta().y()}};
    add_place(line, *widget, wheel.position());
    add_modifiers(line, wheel.modifiers());
    lines_.push_back(line);
  }
  return false;
}

}  // namespace footwall::ui
