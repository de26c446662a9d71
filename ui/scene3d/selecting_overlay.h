// The box or lasso under the mouse, drawn over the scene: there only while it is drawn, so that the scene
// itself is not drawn again for it.
#pragma once
#include <QPolygonF>
#include <QWidget>

namespace footwall::ui {

class SelectingOverlay final : public QWidget {
 public:
  // As large as its parent, and no target of the mouse.
  explicit SelectingOverlay(QWidget* parent);
  void show_region(const QPolygonF& region);

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QPolygonF region_;
};

}  // namespace footwall::ui
