#include "ui/window/banner.h"

#include <QFrame>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QTimer>
#include <QToolButton>
#include <QVBoxLayout>

#include "ui/window/theme.h"

namespace footwall::ui {
namespace {

constexpr int kPassesAfterMs = 12000;

// A strip in the colour of its kind at the left edge.
class Strip final : public QFrame {
 public:
  Strip(BannerArea::Kind kind, QWidget* parent) : QFrame(parent), kind_(kind) {
    setAutoFillBackground(true);
    setBackgroundRole(QPalette::Base);
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    const QPalette::ColorRole role = kind_ == BannerArea::Kind::kError     ? QPalette::BrightText
                                     : kind_ == BannerArea::Kind::kWarning ? QPalette::LinkVisited
                                                                           : QPalette::Highlight;
    QPainter painter(this);
    painter.fillRect(QRect(0, 0, 3, height()), palette().color(role));
    painter.fillRect(QRect(0, height() - 1, width(), 1), palette().color(QPalette::Mid));
  }

 private:
  BannerArea::Kind kind_;
};

}  // namespace

BannerArea::BannerArea(QWidget* parent) : QWidget(parent) {
  column_ = new QVBoxLayout(this);
  column_->setContentsMargins(0, 0, 0, 0);
  column_->setSpacing(0);
  setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Maximum);
}

void BannerArea::show_banner(const QString& key, const Banner& banner) {
  remove(key);
  auto* strip = new Strip(banner.kind, this);
  auto* row = new QHBoxLayout(strip);
  row->setContentsMargins(12, 4, 4, 5);
  auto* text = new QLabel(strip);
  text->setTextFormat(Qt::PlainText);
  text->setWordWrap(true);
  text->setTextInteractionFlags(Qt::TextSelectableByMouse);
  text->setText(banner.hint.isEmpty() ? banner.text
                                      : QStringLiteral("%1 — %2").arg(banner.text, banner.hint));
  row->addWidget(text, 1);
  for (const Button& button : banner.buttons) {
    auto* push = new QPushButton(button.text, strip);
    // Later: what is pressed may take this very banner away.
    connect(push, &QPushButton::clicked, this, button.pressed, Qt::QueuedConnection);
    row->addWidget(push);
  }
  if (banner.passes) {
    auto* cross = new QToolButton(strip);
    cross->setAutoRaise(true);
    cross->setIcon(icon(QStringLiteral("close")));
    cross->setToolTip(tr("Dismiss"));
    connect(
        cross, &QToolButton::clicked, this, [this, key] { remove(key); }, Qt::QueuedConnection);
    row->addWidget(cross);
    QTimer::singleShot(kPassesAfterMs, strip, [this, key] { remove(key); });
  }
  column_->addWidget(strip);
  rows_[key] = {strip, banner};
}

void BannerArea::remove(const QString& key) {
  const auto found = rows_.find(key);
  if (found == rows_.end()) return;
  found->second.widget->hide();
  found->second.widget->deleteLater();
  rows_.erase(found);
}

void BannerArea::clear() {
  while (!rows_.empty()) remove(QString(rows_.begin()->first));
}

QString BannerArea::text(const QString& key) const {
  const auto found = rows_.find(key);
  if (found == rows_.end()) return {};
  const Banner& banner = found->second.banner;
  return banner.hint.isEmpty() ? banner.text : QStringLiteral("%1 — %2").arg(banner.text, banner.hint);
}

bool BannerArea::press(const QString& key, std::size_t button) {
  const auto found = rows_.find(key);
  if (found == rows_.end() || button >= found->second.banner.buttons.size()) return false;
  const auto pressed = found->second.banner.buttons[button].pressed;
  pressed();
  return true;
}

}  // namespace footwall::ui
