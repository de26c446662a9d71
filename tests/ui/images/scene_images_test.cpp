// The scene as it looked when somebody looked.
#include <QTest>

#include "ui/images/image_difference.h"
#include "ui/scene/made_scene.h"
#include "ui/test_class.h"

namespace footwall::ui {
namespace {

constexpr QSize kSize{480, 360};

QPalette light() {
  QPalette palette;
  palette.setColor(QPalette::Window, QColor(0xf4, 0xf5, 0xf7));
  palette.setColor(QPalette::WindowText, QColor(0x23, 0x27, 0x2e));
  palette.setColor(QPalette::Highlight, QColor(0x1f, 0x78, 0xb4));
  return palette;
}

QImage picture_of(const MadeScene& scene) {
  QString problem;
  const QImage picture = scene.settle() ? scene.view->picture(kSize, 1, &problem) : QImage();
  if (!problem.isEmpty()) qWarning("%s", qPrintable(problem));
  return picture;
}

}  // namespace

class SceneImagesTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void variance_with_edges();
  void voxel_values();
  void isosurface_in_the_light();
};

void SceneImagesTest::variance_with_edges() {
  MadeScene scene;
  FaceLook look = scene.bench.display.faces();
  look.edges = true;
  scene.bench.display.set_faces(look);
  QCOMPARE(compare_with_baseline(picture_of(scene), QStringLiteral("scene_variance")), QString());
  if (qEnvironmentVariableIsSet("FOOTWALL_MAKE_BASELINES")) return;
  // That the comparison sees what it is there for: another colour map, a missing plane.
  look.colour_map = QStringLiteral("cividis");
  scene.bench.display.set_faces(look);
  QVERIFY(!compare_with_baseline(picture_of(scene), QStringLiteral("scene_variance")).isEmpty());
  look.colour_map.clear();
  scene.bench.display.set_faces(look);
  scene.bench.display.remove_section(scene.inline_plane);
  const QString told = compare_with_baseline(picture_of(scene), QStringLiteral("scene_variance"));
  QVERIFY(told.contains(QStringLiteral("look different")));
}

void SceneImagesTest::voxel_values() {
  MadeScene scene;
  FaceLook look = scene.bench.display.faces();
  look.colours = FaceColours::kVoxels;
  scene.bench.display.set_faces(look);
  QCOMPARE(compare_with_baseline(picture_of(scene), QStringLiteral("scene_voxels")), QString());
}

void SceneImagesTest::isosurface_in_the_light() {
  MadeScene scene;
  scene.view->setPalette(light());
  IsosurfaceLook look{.id = scene.bench.display.add_isosurface(scene.bench.display.volume(), 0.6),
                      .volume = scene.bench.display.volume(),
                      .value = 0.6};
  look.as_picture = false;
  scene.bench.display.change_isosurface(look);
  QCOMPARE(compare_with_baseline(picture_of(scene), QStringLiteral("scene_isosurface")), QString());
}

static const RegisterTest<SceneImagesTest> kRegistered;

}  // namespace footwall::ui

#include "scene_images_test.moc"
