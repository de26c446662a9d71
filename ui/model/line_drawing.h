// A line section on its way: the user says its two ends on a time or depth slice. One for all slices, each of
// which shows what is known of it.
#pragma once
#include <QObject>
#include <QString>
#include <optional>

#include "ui/model/display.h"
#include "ui/model/document.h"
#include "ui/model/picking.h"

namespace footwall::ui {

class LineDrawing final : public QObject {
  Q_OBJECT

 public:
  // Another tool, and a survey that changes, end it.
  LineDrawing(Document& document, Display& display, Picking& picking, QObject* parent = nullptr);

  bool is_active() const { return active_; }
  void begin();
  // With nothing made.
  void end();
  // An end of the line, in index space; it comes to lie where the nearest lines of the survey cross. The
  // second one makes the section; one at the same place as the first is no end.
  void put(const survey::IndexPoint& place);
  const std::optional<survey::IndexPoint>& first() const { return first_; }
  // What the next click does; empty where no line is drawn.
  QString hint() const;

 Q_SIGNALS:
  void changed();

 private:
  Document& document_;
  Display& display_;
  bool active_ = false;
  std::optional<survey::IndexPoint> first_;
};

}  // namespace footwall::ui
