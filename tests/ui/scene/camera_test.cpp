#include <QTest>
#include <random>

#include "ui/scene3d/fault_geometry.h"
#include "ui/scene3d/isosurface_picture.h"
#include "ui/scene3d/orbit_camera.h"
#include "ui/test_class.h"

namespace footwall::ui {
namespace {

using render::Vec3;

const QSizeF kView(900, 700);

OrbitCamera over_a_box() {
  OrbitCamera camera;
  std::array<Vec3, 8> corners;
  for (unsigned n = 0; n < 8; ++n) {
    corners[n] = {(n & 1U) != 0 ? 3000.0 : -3000.0, (n & 2U) != 0 ? 1000.0 : -1000.0,
                  (n & 4U) != 0 ? 400.0 : -400.0};
  }
  camera.set_corners(corners);
  camera.fit(kView);
  return camera;
}

QPointF pixel_of(const OrbitCamera& camera, const Vec3& p) {
  QPointF pixel(-1, -1);
  project_to(camera.camera(kView), kView, p, &pixel);
  return pixel;
}

bool near(const QPointF& a, const QPointF& b, double pixels = 0.01) {
  return std::hypot(a.x() - b.x(), a.y() - b.y()) < pixels;
}

std::shared_ptr<FaultSurface> random_surface(std::mt19937& random, int side) {
  auto surface = std::make_shared<FaultSurface>();
  std::uniform_real_distribution<double> rough(-3, 3);
  for (int a = 0; a <= side; ++a) {
    for (int b = 0; b <= side; ++b) surface->vertices.push_back({10.0 * a, rough(random), 10.0 * b});
  }
  for (int a = 0; a < side; ++a) {
    for (int b = 0; b < side; ++b) {
      const std::int32_t n = a * (side + 1) + b;
      surface->faces.push_back({1, 2 * (a * side + b), {n, n + side + 1, n + 1}});
      surface->faces.push_back({1, 2 * (a * side + b) + 1, {n + side + 1, n + side + 2, n + 1}});
    }
  }
  return surface;
}

Vec3 as_it_is(const survey::WorldPoint& p) {
  return {p.x, p.y, p.z};
}

}  // namespace

class CameraTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void fits_the_whole_box_from_anywhere();
  void zoom_keeps_what_is_under_the_mouse();
  void a_ray_passes_through_its_pixel();
  void rays_meet_the_face_that_a_search_of_all_finds();
  void coarse_faces_are_few_and_an_outline_goes_around();
  void matrices_invert();
};

void CameraTest::fits_the_whole_box_from_anywhere() {
  for (const bool perspective : {true, false}) {
    OrbitCamera camera = over_a_box();
    camera.set_perspective(perspective);
    for (const auto view :
         {StandardView::kTop, StandardView::kBottom, StandardView::kNorth, StandardView::kEast,
          StandardView::kSouth, StandardView::kWest, StandardView::kOblique}) {
      camera.look(view);
      camera.fit(kView);
      double left = INFINITY, right = -INFINITY, top = INFINITY, bottom = -INFINITY;
      for (unsigned n = 0; n < 8; ++n) {
        const QPointF at =
            pixel_of(camera, {(n & 1U) != 0 ? 3000.0 : -3000.0, (n & 2U) != 0 ? 1000.0 : -1000.0,
                              (n & 4U) != 0 ? 400.0 : -400.0});
        left = std::min(left, at.x());
        right = std::max(right, at.x());
        top = std::min(top, at.y());
        bottom = std::max(bottom, at.y());
      }
      QVERIFY(left > 0 && right < kView.width() && top > 0 && bottom < kView.height());
      QVERIFY((right - left) > 0.6 * kView.width() || (bottom - top) > 0.6 * kView.height());
      QVERIFY(std::abs(left + right - kView.width()) < 4);
    }
  }
}

void CameraTest::zoom_keeps_what_is_under_the_mouse() {
  for (const bool perspective : {true, false}) {
    OrbitCamera camera = over_a_box();
    camera.set_perspective(perspective);
    const Vec3 place{1500, -700, 350};
    const QPointF before = pixel_of(camera, place);
    for (int n = 0; n < 12; ++n) camera.zoom(0.85, place);
    QVERIFY(near(before, pixel_of(camera, place)));
    for (int n = 0; n < 500; ++n) camera.zoom(0.5, place);  // an end, and still a camera
    QVERIFY(near(before, pixel_of(camera, place), 1));
  }
}

void CameraTest::a_ray_passes_through_its_pixel() {
  for (const bool perspective : {true, false}) {
    OrbitCamera camera = over_a_box();
    camera.set_perspective(perspective);
    camera.orbit(77, -31);
    for (const QPointF pixel : {QPointF(3, 4), QPointF(450, 350), QPointF(880, 120)}) {
      const Ray ray = camera.ray(pixel, kView);
      QVERIFY(near(pixel, pixel_of(camera, ray.from + ray.along * length(camera.target() - ray.from))));
    }
  }
}

void CameraTest::rays_meet_the_face_that_a_search_of_all_finds() {
  std::mt19937 random(7);
  const FaultGeometry mesh(random_surface(random, 23), as_it_is);
  std::uniform_real_distribution<double> place(-40, 270);
  int met = 0;
  for (int n = 0; n < 400; ++n) {
    const Ray ray{{place(random), -100, place(random)},
                  {place(random) / 900 - 0.1, 1, place(random) / 900 - 0.1}};
    // Every face by itself.
    std::optional<RayHit> wanted;
    for (std::size_t face = 0; face < mesh.face_count(); ++face) {
      const RayTree alone(mesh.positions(), std::span(mesh.corners()).subspan(3 * face, 3));
      const auto hit = alone.first_hit(ray, wanted ? wanted->distance : INFINITY);
      if (hit) wanted = RayHit{hit->distance, static_cast<std::int32_t>(face)};
    }
    const auto found = mesh.tree().first_hit(ray, INFINITY);
    QCOMPARE(found.has_value(), wanted.has_value());
    if (!found) continue;
    ++met;
    QCOMPARE(found->distance, wanted->distance);
    QVERIFY(!mesh.tree().first_hit(ray, found->distance * 0.99));
  }
  QVERIFY(met > 100 && met < 400);
}

void CameraTest::coarse_faces_are_few_and_an_outline_goes_around() {
  std::mt19937 random(8);
  const FaultGeometry mesh(random_surface(random, 60), as_it_is);
  const CoarseFaces few = mesh.coarse(400);
  QVERIFY(few.faces.size() > 150 && few.faces.size() <= 400);
  QCOMPARE(few.corners.size(), 3 * few.faces.size());
  for (const std::uint32_t corner : few.corners) QVERIFY(corner < mesh.positions().size());
  QCOMPARE(mesh.coarse(100000).faces.size(), mesh.face_count());
  QCOMPARE(mesh.outline().size(), std::size_t{2 * 4 * 60});
  auto broken = random_surface(random, 4);
  broken->vertices[3].x = NAN;
  const FaultGeometry holed(broken, as_it_is);
  QVERIFY(holed.bounds().hi.x <= 40);
  QVERIFY(!holed.tree().first_hit({{10, -50, 1000}, {0, 1, 0}}, INFINITY));
}

void CameraTest::matrices_invert() {
  OrbitCamera camera = over_a_box();
  const render::Matrix4 m = camera.camera(kView).view_projection;
  const render::Matrix4 one = product_of(m, inverse_of(m));
  for (std::size_t n = 0; n < 16; ++n) QVERIFY(std::abs(one[n] - (n % 5 == 0 ? 1 : 0)) < 1e-6);
  QCOMPARE(inverse_of({}), render::Matrix4{});
}

static const RegisterTest<CameraTest> kRegistered;

}  // namespace footwall::ui

#include "camera_test.moc"
