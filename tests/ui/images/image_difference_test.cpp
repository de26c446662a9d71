#include "ui/images/image_difference.h"

#include <QPainter>
#include <QTest>

#include "ui/test_class.h"

namespace footwall::ui {
namespace {

QImage drawing(const QColor& fill, double shift, bool smooth) {
  QImage image(480, 360, QImage::Format_RGB32);
  image.fill(QColor(0x1e, 0x21, 0x26));
  QPainter painter(&image);
  painter.setRenderHint(QPainter::Antialiasing, smooth);
  painter.fillRect(QRectF(100, 80, 200, 150), fill);
  painter.setPen(QPen(QColor(0xd6, 0xda, 0xe0), 1.2));
  for (int n = 0; n < 12; ++n)
    painter.drawLine(QPointF(20 + shift, 30 + 25 * n), QPointF(450 + shift, 60 + 22 * n));
  return image;
}

}  // namespace

class ImageDifferenceTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void passes_what_looks_alike();
  void tells_what_does_not();
};

void ImageDifferenceTest::passes_what_looks_alike() {
  const QImage image = drawing(QColor(60, 120, 200), 0, true);
  QCOMPARE(difference_of(image, image).share, 0.0);
  QImage grainy = image;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const QColor c = image.pixelColor(x, y);
      const int grain = (x * 7919 + y * 104729) % 7 - 3;
      grainy.setPixelColor(x, y,
                           QColor(std::clamp(c.red() + grain, 0, 255), std::clamp(c.green() - grain, 0, 255),
                                  std::clamp(c.blue() + grain, 0, 255)));
    }
  }
  QVERIFY(grainy != image);
  QVERIFY(difference_of(image, grainy).is_small());
}

void ImageDifferenceTest::tells_what_does_not() {
  const QImage image = drawing(QColor(60, 120, 200), 0, true);
  // A colour that is a little off, a part that is missing, another size, nothing at all.
  const ImageDifference other = difference_of(image, drawing(QColor(60, 120, 170), 0, true));
  QVERIFY(!other.is_small());
  QCOMPARE(other.picture.size(), image.size());
  QVERIFY(qRed(other.picture.pixel(200, 200)) > 100 && qGreen(other.picture.pixel(200, 200)) == 0);
  QImage holed = image;
  QPainter(&holed).fillRect(300, 200, 80, 60, Qt::black);
  QVERIFY(!difference_of(image, holed).is_small());
  QVERIFY(!difference_of(image, image.copy(0, 0, 479, 360)).is_small());
  QVERIFY(!difference_of(image, QImage()).is_small());
  if (qEnvironmentVariableIsSet("FOOTWALL_MAKE_BASELINES")) return;  // the next line would make one
  QVERIFY(compare_with_baseline(image, QStringLiteral("no such picture"))
              .contains(QStringLiteral("no baseline")));
}

static const RegisterTest<ImageDifferenceTest> kRegistered;

}  // namespace footwall::ui

#include "image_difference_test.moc"
