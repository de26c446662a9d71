// What a user did in a window, one JSON object a line, without times: played again, or written down while it
// happens.
//
//   {"do": "action", "id": "fault.new"}                                 a menu entry or shortcut
//   {"do": "press", "in": "inline", "at": [10, 24], "keys": "Ctrl"}     also move, release, double
//   {"do": "wheel", "in": "scene", "at": [24, 20, 30], "by": 120}
//   {"do": "key", "in": "inline", "key": "X"}                           also keyup
//
// "in": "inline", "crossline", "slice" (the first of its kind), "scene", or a widget's path in the window.
// "at": voxels of the section's plane; in the scene a place of the survey's index space; elsewhere, and where
// the scene is empty, "pixel". "button": left, unless it says "middle" or "right"; of a move: what is held,
// "none" for nothing. Lines that begin with # are comments.
#pragma once
#include <QJsonObject>
#include <QObject>
#include <QString>
#include <vector>

class QEvent;
class QMouseEvent;
class QWidget;

namespace footwall::ui {

class MainWindow;

// Throws Error, naming the line, for one that cannot be read.
std::vector<QJsonObject> read_session(const QString& path);
void write_session(const QString& path, const std::vector<QJsonObject>& lines);

// Throws Error for a line that names what the window does not have.
void play(MainWindow& window, const std::vector<QJsonObject>& lines);

// The interpretation and its history as a person reads them, places in voxels: what a session is compared by.
QString text_after(const MainWindow& window);

// Writes down what happens in the window while it lives.
class SessionRecorder final : public QObject {
 public:
  explicit SessionRecorder(MainWindow& window);
  ~SessionRecorder() override;
  const std::vector<QJsonObject>& lines() const { return lines_; }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void add_mouse(const char* what, QWidget& widget, const QMouseEvent& event);
  void add_place(QJsonObject& line, QWidget& widget, const QPointF& pixel) const;

  MainWindow& window_;
  std::vector<QJsonObject> lines_;
  quint64 seen_at_ = 0;  // of the event written down last: it goes on to parents
  int seen_type_ = 0;
};

}  // namespace footwall::ui
