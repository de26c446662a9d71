#include "ui/panels/project_row.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>

#include "ui/model/project_tree.h"

namespace footwall::ui {
namespace {

constexpr int kRowHeight = 24;
constexpr int kRing = 9;        // diameter
constexpr int kRingPlace = 10;  // left of it
constexpr int kSwatch = 10;
constexpr int kGap = 8;
constexpr int kRightMargin = 10;

QRect ring_of(const QRect& row) {
  return {row.left() + kRingPlace, row.center().y() - kRing / 2, kRing, kRing};
}

int text_place(const QRect& row, const QModelIndex& index) {
  int x = ring_of(row).right() + kGap + 1;
  if (index.data(ProjectTree::kColour).isValid()) x += kSwatch + kGap;
  return x;
}

}  // namespace

void ProjectRow::paint(QPainter* painter, const QStyleOptionViewItem& option,
                       const QModelIndex& index) const {
  painter->save();
  painter->setRenderHint(QPainter::Antialiasing);
  const QPalette& colours = option.palette;
  const QRect row = option.rect;
  if ((option.state & QStyle::State_Selected) != 0) {
    QColor tint = colours.color(QPalette::Link);
    tint.setAlphaF(kSelectedTint);
    painter->fillRect(row, tint);
  }
  const bool is_heading = !index.parent().isValid();
  const QString name = index.data(Qt::DisplayRole).toString();
  if (is_heading) {
    painter->setPen(colours.color(QPalette::PlaceholderText));
    painter->drawText(row.adjusted(2, 0, 0, 0), Qt::AlignVCenter | Qt::AlignLeft, name);
    painter->restore();
    return;
  }
  const QVariant check = index.data(Qt::CheckStateRole);
  if (check.isValid()) {
    const QRectF ring = QRectF(ring_of(row)).adjusted(0.5, 0.5, 0.5, 0.5);
    painter->setBrush(Qt::NoBrush);
    painter->setPen(QPen(colours.color(QPalette::PlaceholderText), 1.2));
    painter->drawEllipse(ring);
    if (check.toInt() == Qt::Checked) {
      painter->setPen(Qt::NoPen);
      painter->setBrush(colours.color(QPalette::Text));
      painter->drawEllipse(ring.adjusted(2.2, 2.2, -2.2, -2.2));
    }
  }
  const QVariant colour = index.data(ProjectTree::kColour);
  if (colour.isValid()) {
    painter->setPen(Qt::NoPen);
    painter->setBrush(colour.value<QColor>());
    painter->drawRoundedRect(
        QRect(ring_of(row).right() + kGap, row.center().y() - kSwatch / 2 + 1, kSwatch, kSwatch), 2, 2);
  }
  const QString detail = index.data(ProjectTree::kDetail).toString();
  const int detail_width = detail.isEmpty() ? 0 : option.fontMetrics.horizontalAdvance(detail) + kGap;
  const bool hidden = check.isValid() && check.toInt() != Qt::Checked;
  painter->setPen(colours.color(hidden ? QPalette::PlaceholderText : QPalette::Text));
  const int x = text_place(row, index);
  const int width = row.right() - kRightMargin - detail_width - x;
  painter->drawText(QRect(x, row.top(), width, row.height()), Qt::AlignVCenter | Qt::AlignLeft,
                    option.fontMetrics.elidedText(name, Qt::ElideRight, width));
  painter->setPen(colours.color(QPalette::PlaceholderText));
  painter->drawText(row.adjusted(0, 0, -kRightMargin, 0), Qt::AlignVCenter | Qt::AlignRight, detail);
  if ((option.state & QStyle::State_HasFocus) != 0) {
    painter->setBrush(Qt::NoBrush);
    painter->setPen(colours.color(QPalette::Link));
    painter->drawRect(QRectF(row).adjusted(0.5, 0.5, -0.5, -0.5));
  }
  painter->restore();
}

QSize ProjectRow::sizeHint(const QStyleOptionViewItem&, const QModelIndex&) const {
  return {120, kRowHeight};
}

void ProjectRow::updateEditorGeometry(QWidget* editor, const QStyleOptionViewItem& option,
                                      const QModelIndex& index) const {
  const int x = text_place(option.rect, index) - 4;
  editor->setGeometry(QRect(QPoint(x, option.rect.top()), option.rect.bottomRight()));
}

// The ring takes clicks on it and to the left of it; Space does the same.
bool ProjectRow::editorEvent(QEvent* event, QAbstractItemModel* model, const QStyleOptionViewItem& option,
                             const QModelIndex& index) {
  const QVariant check = index.data(Qt::CheckStateRole);
  if (!check.isValid()) return false;
  const bool is_press = event->type() == QEvent::MouseButtonPress;
  if (is_press || event->type() == QEvent::MouseButtonRelease ||
      event->type() == QEvent::MouseButtonDblClick) {
    const auto* mouse = static_cast<QMouseEvent*>(event);
    if (mouse->button() != Qt::LeftButton || mouse->position().x() > ring_of(option.rect).right() + kGap / 2)
      return false;
    if (!is_press) return true;
  } else if (event->type() == QEvent::KeyPress) {
    const int key = static_cast<QKeyEvent*>(event)->key();
    if (key != Qt::Key_Space && key != Qt::Key_Select) return false;
  } else {
    return false;
  }
  model->setData(index, check.toInt() == Qt::Checked ? Qt::Unchecked : Qt::Checked, Qt::CheckStateRole);
  return true;
}

}  // namespace footwall::ui
