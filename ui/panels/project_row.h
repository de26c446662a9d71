// Draws a row of the project tree: a ring for shown or hidden, the colour, the name, and a dim word at the
// right.
#pragma once
#include <QStyledItemDelegate>

namespace footwall::ui {

class ProjectRow final : public QStyledItemDelegate {
  Q_OBJECT

 public:
  static constexpr float kSelectedTint = 0.28F;  // of the accent

  using QStyledItemDelegate::QStyledItemDelegate;
  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override;
  QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override;
  void updateEditorGeometry(QWidget* editor, const QStyleOptionViewItem& option,
                            const QModelIndex& index) const override;
  bool editorEvent(QEvent* event, QAbstractItemModel* model, const QStyleOptionViewItem& option,
                   const QModelIndex& index) override;
};

}  // namespace footwall::ui
