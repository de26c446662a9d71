// What a face's number is worth after moves and answers in any order.
#include "ui/model/face_values.h"

#include <QTest>

#include "ui/test_class.h"

namespace footwall::ui {
namespace {

// Two faces of one panel, the second of which stands `at`.
std::shared_ptr<const FaultSurface> surface(std::int32_t at) {
  auto made = std::make_shared<FaultSurface>();
  made->fault = 1;
  made->faces = {{.panel = 7, .n = 0, .vertices = {0, 1, 2}}, {.panel = 7, .n = 1, .vertices = {1, 3, 2}}};
  made->lattice = {survey::LatticeTriangle{{{0, 0, 0}, {256, 0, 0}, {0, 256, 0}}},
                   survey::LatticeTriangle{{{256, 0, 0}, {256, 256, at}, {0, 256, 0}}}};
  return made;
}

void put(FaceValues& values, std::int32_t at) {
  values.set_surface(surface(at));
}

// An answer about both faces, computed while the second stood `at`.
void answer(FaceValues& values, double first, double second, std::int32_t at) {
  values.take({7, 7}, {0, 1}, {{"variance", {first, second}}, {"count", {100, 100}}}, {0, 1}, *surface(at));
}

}  // namespace

class FaceValuesTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void a_moved_face_is_stale_until_it_is_answered();
  void a_face_that_came_back_is_fresh();
  void a_face_that_came_back_before_its_answer_is_fresh();
  void an_answer_of_an_older_place_leaves_what_moved_since_stale();
  void offsets_are_stale_by_themselves();
  void faces_that_are_gone_are_passed_over();
};

void FaceValuesTest::a_moved_face_is_stale_until_it_is_answered() {
  FaceValues values;
  put(values, 0);
  answer(values, 2, 3, 0);
  QVERIFY(!values.any_stale("variance"));
  put(values, 50);
  QCOMPARE(values.numbers("variance")->stale, (std::vector<std::uint8_t>{0, 1}));
  QCOMPARE(values.numbers("variance")->values,
           (std::vector<double>{2, 3}));  // the last one known, until then
  answer(values, 2, 5, 50);
  QVERIFY(!values.any_stale("variance"));
  QCOMPARE(values.numbers("variance")->values, (std::vector<double>{2, 5}));
}

void FaceValuesTest::a_face_that_came_back_is_fresh() {
  FaceValues values;
  put(values, 0);
  answer(values, 2, 3, 0);
  put(values, 50);
  put(values, 0);  // as after Esc; the engine was told neither
  QVERIFY(!values.any_stale("variance"));
}

// A hand that is to and fro faster than the engine answers: it was told the place once, and says no more.
void FaceValuesTest::a_face_that_came_back_before_its_answer_is_fresh() {
  FaceValues values;
  put(values, 0);
  put(values, 50);
  answer(values, 2, 3, 0);
  QCOMPARE(values.numbers("variance")->stale, (std::vector<std::uint8_t>{0, 1}));
  put(values, 0);
  QVERIFY(!values.any_stale("variance"));
}

void FaceValuesTest::an_answer_of_an_older_place_leaves_what_moved_since_stale() {
  FaceValues values;
  put(values, 0);
  put(values, 50);
  put(values, 50);  // another face of the fault may have moved
  answer(values, 2, 3, 0);
  QCOMPARE(values.numbers("variance")->stale, (std::vector<std::uint8_t>{0, 1}));
  answer(values, 2, 5, 50);
  QVERIFY(!values.any_stale("variance"));
  put(values, 0);
  QCOMPARE(values.numbers("variance")->stale, (std::vector<std::uint8_t>{0, 1}));
}

void FaceValuesTest::offsets_are_stale_by_themselves() {
  FaceValues values;
  put(values, 0);
  answer(values, 2, 3, 0);
  QVERIFY(values.any_stale("offset_voxels"));
  values.take({7, 7}, {0, 1}, {{"offset_voxels", {1, -1}}}, {0, 1}, *surface(0));
  QVERIFY(!values.any_stale("offset_voxels"));
  put(values, 50);
  answer(values, 2, 5, 50);
  QVERIFY(!values.any_stale("variance"));
  QCOMPARE(values.numbers("offset_voxels")->stale, (std::vector<std::uint8_t>{0, 1}));
  // The normal's side was turned.
  values.mark_stale("offset_voxels");
  QCOMPARE(values.numbers("offset_voxels")->stale, (std::vector<std::uint8_t>{1, 1}));
  QVERIFY(!values.any_stale("variance"));
  FaultSurface turned = *surface(50);
  turned.side = -turned.side;
  values.take({7, 7}, {0, 1}, {{"offset_voxels", {1, -1}}}, {0, 1}, turned);
  QCOMPARE(values.numbers("offset_voxels")->stale, (std::vector<std::uint8_t>{1, 1}));
  values.mark_all_stale();
  QVERIFY(values.any_stale("variance"));
}

void FaceValuesTest::faces_that_are_gone_are_passed_over() {
  FaceValues values;
  answer(values, 2, 3, 0);
  QVERIFY(!values.is_known("variance"));
  put(values, 0);
  values.take({9}, {0}, {{"variance", {4}}}, {0}, *surface(0));
  QVERIFY(!values.is_known("variance"));
  QVERIFY(values.any_stale("variance"));
}

static const RegisterTest<FaceValuesTest> kRegistered;

}  // namespace footwall::ui

#include "face_values_test.moc"
