#include "ui/scene3d/selecting_overlay.h"

#include <QPainter>

namespace footwall::ui {

SelectingOverlay::SelectingOverlay(QWidget* parent) : QWidget(parent) {
  setAttribute(Qt::WA_TransparentForMouseEvents);
  setFocusPolicy(Qt::NoFocus);
  hide();
}

void SelectingOverlay::show_region(const QPolygonF& region) {
  region_ = region;
  setGeometry(parentWidget()->rect());
  show();
  raise();
  update();
}

void SelectingOverlay::paintEvent(QPaintEvent*) {
  if (region_.size() < 2) return;
  const QColor accent = palette().color(QPalette::Highlight);
  QColor ground = accent;
  ground.setAlphaF(0.12F);
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(accent, 1, Qt::DashLine));
  painter.setBrush(ground);
  painter.drawPolygon(region_);
}

}  // namespace footwall::ui
