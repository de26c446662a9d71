#include "ui/dialogs/transform_dialog.h"

#include <QPushButton>
#include <QTest>
#include <cmath>

#include "ui/dialogs/look.h"
#include "ui/sample_project.h"
#include "ui/test_class.h"

namespace footwall::ui {

class TransformDialogTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() { put_on_dark(); }
  void shows_while_the_numbers_change_and_is_one_step();
  void cancel_puts_back_what_was();
  void turns_about_the_middle();
};

namespace {

struct Desk {
  Desk() : workbench(sample.open(), {}) {
    const Fault& fault = workbench.document.faults()[0];
    id = fault.record.id;
    pillar = fault.pillars[0];
    workbench.selection.select({.kind = Item::Kind::kPillar, .id = pillar.id});
  }
  const survey::Pillar& shown() const { return workbench.document.shown_pillars(id)[0]; }
  static QDoubleSpinBox* box(const QDialog& dialog, const char* name) {
    return dialog.findChild<QDoubleSpinBox*>(QLatin1String(name));
  }
  SampleProject sample;
  Workbench workbench;
  Id id = 0;
  survey::Pillar pillar;
};

}  // namespace

void TransformDialogTest::shows_while_the_numbers_change_and_is_one_step() {
  Desk desk;
  Document& document = desk.workbench.document;
  const std::size_t steps = document.history().size();
  TransformDialog dialog(desk.workbench);
  dialog.show();
  QVERIFY(QTest::qWaitForWindowExposed(&dialog));
  QVERIFY(Desk::box(dialog, "x")->suffix().endsWith("m"));
  QVERIFY(Desk::box(dialog, "z")->suffix().endsWith("ms"));
  Desk::box(dialog, "x")->setValue(25);
  Desk::box(dialog, "z")->setValue(-8);
  QVERIFY(document.is_provisional(desk.id));
  for (std::size_t n = 0; n < desk.pillar.nodes.size(); ++n) {
    QCOMPARE(desk.shown().nodes[n].position.x, desk.pillar.nodes[n].position.x + 25);
    QCOMPARE(desk.shown().nodes[n].position.z, desk.pillar.nodes[n].position.z - 8);
  }
  QCOMPARE(document.history().size(), steps);
  keep_picture(dialog, QStringLiteral("transform"));
  QTest::mouseClick(dialog.findChild<QPushButton*>(QStringLiteral("ok")), Qt::LeftButton);
  QVERIFY(!document.is_provisional(desk.id));
  QCOMPARE(document.history().size(), steps + 1);
  QCOMPARE(document.pillar(desk.pillar.id)->nodes[0].position.x, desk.pillar.nodes[0].position.x + 25);
  QVERIFY(document.undo());
  QCOMPARE(document.pillar(desk.pillar.id)->nodes[0].position, desk.pillar.nodes[0].position);
}

void TransformDialogTest::cancel_puts_back_what_was() {
  Desk desk;
  Document& document = desk.workbench.document;
  const std::size_t steps = document.history().size();
  {
    TransformDialog dialog(desk.workbench);
    Desk::box(dialog, "y")->setValue(50);
    QVERIFY(document.is_provisional(desk.id));
    // Back to zero is as if nothing had been said.
    Desk::box(dialog, "y")->setValue(0);
    QVERIFY(!document.is_provisional(desk.id));
    Desk::box(dialog, "y")->setValue(50);
    QTest::keyClick(&dialog, Qt::Key_Escape);
  }
  QVERIFY(!document.is_provisional(desk.id));
  {
    TransformDialog dialog(desk.workbench);
    dialog.accept();  // nothing was changed: no step
  }
  QCOMPARE(document.history().size(), steps);
  QCOMPARE(desk.shown().nodes[0].position, desk.pillar.nodes[0].position);
}

void TransformDialogTest::turns_about_the_middle() {
  Desk desk;
  TransformDialog dialog(desk.workbench);
  Desk::box(dialog, "rotate")->setValue(180);
  Desk::box(dialog, "scale_z")->setValue(2);
  survey::WorldPoint before, after;
  double heights = 0, stretched = 0;
  const std::size_t last = desk.pillar.nodes.size() - 1;
  for (std::size_t n = 0; n <= last; ++n) {
    before.x += desk.pillar.nodes[n].position.x;
    after.x += desk.shown().nodes[n].position.x;
    before.z += desk.pillar.nodes[n].position.z;
    after.z += desk.shown().nodes[n].position.z;
  }
  heights = desk.pillar.nodes[last].position.z - desk.pillar.nodes[0].position.z;
  stretched = desk.shown().nodes[last].position.z - desk.shown().nodes[0].position.z;
  QVERIFY(std::abs(before.x - after.x) < 1e-3 && std::abs(before.z - after.z) < 1e-3);
  QVERIFY(std::abs(stretched - 2 * heights) < 1e-6);
  const double across = desk.pillar.nodes[last].position.x - desk.pillar.nodes[0].position.x;
  const double turned = desk.shown().nodes[last].position.x - desk.shown().nodes[0].position.x;
  QVERIFY(std::abs(across + turned) < 1e-6);
}

static const RegisterTest<TransformDialogTest> kRegistered;

}  // namespace footwall::ui

#include "transform_dialog_test.moc"
