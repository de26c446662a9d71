#include <QSignalSpy>
#include <QTest>

#include "ui/scene/made_scene.h"
#include "ui/test_class.h"

namespace footwall::ui {
namespace {

std::size_t differing(const QImage& a, const QImage& b, int tolerance = 24) {
  std::size_t count = 0;
  for (int y = 0; y < std::min(a.height(), b.height()); ++y) {
    for (int x = 0; x < std::min(a.width(), b.width()); ++x) {
      const QRgb p = a.pixel(x, y);
      const QRgb q = b.pixel(x, y);
      const int most = std::max(
          {std::abs(qRed(p) - qRed(q)), std::abs(qGreen(p) - qGreen(q)), std::abs(qBlue(p) - qBlue(q))});
      if (most > tolerance) ++count;
    }
  }
  return count;
}

}  // namespace

class SceneTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void shows_faults_planes_and_box();
};

void SceneTest::shows_faults_planes_and_box() {
  MadeScene scene;
  QVERIFY(scene.settle());
  QCOMPARE(scene.view->problem(), QString());
  const QImage all = scene.grabbed("scene");
  scene.bench.display.set_visible({.kind = Item::Kind::kFault, .id = scene.first_fault()}, false);
  QVERIFY(scene.settle());
  QVERIFY(differing(all, scene.grabbed("one_hidden")) > 3000);
}

static const RegisterTest<SceneTest> kRegistered;

}  // namespace footwall::ui

#include "scene_test.moc"
