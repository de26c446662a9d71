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

// A surface put under an edit, as Surfaces does it.
void put(FaceValues& values, std::int32_t at, std::uint64_t edit) {
  values.set_surface(surface(at));
  values.tell_moved(edit);
}

// An answer about both faces as they stood under an edit.
void answer(FaceValues& values, double first, double second, std::uint64_t edit) {
  values.take({7, 7}, {0, 1}, {{"variance", {first, second}}, {"count", {100, 100}}}, {0, 1}, edit);
}

}  // namespace

class FaceValuesTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void a_moved_face_is_stale_until_it_is_answered();
  void a_face_that_came_back_is_fresh();
  void an_answer_to_an_older_edit_leaves_what_moved_since_stale();
  void offsets_are_stale_by_themselves();
  void faces_that_are_gone_are_passed_over();
};

void FaceValuesTest::a_moved_face_is_stale_until_it_is_answered() {
  FaceValues values;
  put(values, 0, 1);
  answer(values, 2, 3, 1);
  QVERIFY(!values.any_stale("variance"));
  put(values, 50, 2);
  QCOMPARE(values.numbers("variance")->stale, (std::vector<std::uint8_t>{0, 1}));
  QCOMPARE(values.numbers("variance")->values,
           (std::vector<double>{2, 3}));  // the last one known, until then
  answer(values, 2, 5, 2);
  QVERIFY(!values.any_stale("variance"));
  QCOMPARE(values.numbers("variance")->values, (std::vector<double>{2, 5}));
}

void FaceValuesTest::a_face_that_came_back_is_fresh() {
  FaceValues values;
  put(values, 0, 1);
  answer(values, 2, 3, 1);
  put(values, 50, 2);
  put(values, 0, 3);  // as after Esc; the engine was told neither
  QVERIFY(!values.any_stale("variance"));
}

void FaceValuesTest::an_answer_to_an_older_edit_leaves_what_moved_since_stale() {
  FaceValues values;
  put(values, 0, 1);
  put(values, 50, 2);
  put(values, 50, 3);  // another face of the fault may have moved
  answer(values, 2, 3, 1);
  QCOMPARE(values.numbers("variance")->stale, (std::vector<std::uint8_t>{0, 1}));
  answer(values, 2, 5, 3);
  QVERIFY(!values.any_stale("variance"));
  put(values, 0, 4);
  QCOMPARE(values.numbers("variance")->stale, (std::vector<std::uint8_t>{0, 1}));
}

void FaceValuesTest::offsets_are_stale_by_themselves() {
  FaceValues values;
  put(values, 0, 1);
  answer(values, 2, 3, 1);
  QVERIFY(values.any_stale("offset_voxels"));
  values.take({7, 7}, {0, 1}, {{"offset_voxels", {1, -1}}}, {0, 1}, 1);
  QVERIFY(!values.any_stale("offset_voxels"));
  put(values, 50, 2);
  answer(values, 2, 5, 2);
  QVERIFY(!values.any_stale("variance"));
  QCOMPARE(values.numbers("offset_voxels")->stale, (std::vector<std::uint8_t>{0, 1}));
  // The normal's side was turned.
  values.mark_stale("offset_voxels");
  QCOMPARE(values.numbers("offset_voxels")->stale, (std::vector<std::uint8_t>{1, 1}));
  QVERIFY(!values.any_stale("variance"));
  values.mark_all_stale();
  QVERIFY(values.any_stale("variance"));
}

void FaceValuesTest::faces_that_are_gone_are_passed_over() {
  FaceValues values;
  answer(values, 2, 3, 1);
  QVERIFY(!values.is_known("variance"));
  put(values, 0, 1);
  values.take({9}, {0}, {{"variance", {4}}}, {0}, 1);
  QVERIFY(!values.is_known("variance"));
  QVERIFY(values.any_stale("variance"));
}

static const RegisterTest<FaceValuesTest> kRegistered;

}  // namespace footwall::ui

#include "face_values_test.moc"
