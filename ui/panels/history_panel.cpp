#include "ui/panels/history_panel.h"

#include <QPainter>
#include <QStyledItemDelegate>

#include "ui/model/history_jump.h"

namespace footwall::ui {
namespace {

constexpr int kRowHeight = 20;
constexpr int kDot = 8;

// A dot where the project stands; what is undone is dim.
class Step final : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;

  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    const QPalette& colours = option.palette;
    const QRect row = option.rect;
    if ((option.state & (QStyle::State_MouseOver | QStyle::State_HasFocus)) != 0) {
      QColor tint = colours.color(QPalette::Highlight);
      tint.setAlphaF(0.15F);
      painter->fillRect(row, tint);
    }
    const bool current = index.data(HistoryList::kCurrent).toBool();
    const bool undone = index.data(HistoryList::kUndone).toBool();
    if (current) {
      painter->setPen(Qt::NoPen);
      painter->setBrush(colours.color(QPalette::Link));
      painter->drawEllipse(QRectF(row.left() + 12, row.center().y() - kDot / 2.0 + 0.5, kDot, kDot));
    }
    painter->setPen(colours.color(current  ? QPalette::Link
                                  : undone ? QPalette::PlaceholderText
                                           : QPalette::Text));
    painter->drawText(
        row.adjusted(26, 0, -110, 0), Qt::AlignVCenter | Qt::AlignLeft,
        option.fontMetrics.elidedText(index.data().toString(), Qt::ElideRight, row.width() - 136));
    painter->setPen(colours.color(QPalette::PlaceholderText));
    painter->drawText(row.adjusted(0, 0, -10, 0), Qt::AlignVCenter | Qt::AlignRight,
                      index.data(HistoryList::kWhen).toString().mid(11));
    painter->restore();
  }
  QSize sizeHint(const QStyleOptionViewItem&, const QModelIndex&) const override { return {100, kRowHeight}; }
};

}  // namespace

HistoryPanel::HistoryPanel(Workbench& workbench, QWidget* parent) : QListView(parent), workbench_(workbench) {
  list_ = new HistoryList(workbench_.document, this);
  setModel(list_);
  setItemDelegate(new Step(this));
  setFrameShape(QFrame::NoFrame);
  setUniformItemSizes(true);
  setMouseTracking(true);
  setEditTriggers(QAbstractItemView::NoEditTriggers);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  // Later: going there changes the list.
  connect(this, &QListView::clicked, this, &HistoryPanel::go_to, Qt::QueuedConnection);
  connect(this, &QListView::activated, this, &HistoryPanel::go_to, Qt::QueuedConnection);
  connect(list_, &HistoryList::current_changed, this, &HistoryPanel::show_current);
  show_current();
}

void HistoryPanel::go_to(const QModelIndex& index) {
  if (!index.isValid() || index.data(HistoryList::kCurrent).toBool() || workbench_.document.read_only())
    return;
  jump_to_step(workbench_, index.data(HistoryList::kStep).toLongLong());
}

void HistoryPanel::resizeEvent(QResizeEvent* event) {
  QListView::resizeEvent(event);
  show_current();
}

void HistoryPanel::show_current() {
  scrollTo(list_->index(list_->current_row()));
}

}  // namespace footwall::ui
