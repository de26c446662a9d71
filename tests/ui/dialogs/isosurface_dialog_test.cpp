#include "ui/dialogs/isosurface_dialog.h"

#include <QSignalSpy>
#include <QTest>
#include <numeric>

#include "ui/dialogs/look.h"
#include "ui/model/volume_spread.h"
#include "ui/sample_project.h"
#include "ui/test_class.h"

namespace footwall::ui {

class IsosurfaceDialogTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() { put_on_dark(); }
  void bars_follow_the_counts();
  void the_surface_follows_the_mark();
  void cancel_puts_back_what_was();
};

void IsosurfaceDialogTest::bars_follow_the_counts() {
  volume::Histogram histogram;
  histogram.lo = -1;
  histogram.hi = 1;
  histogram.counts[0] = 4;
  histogram.counts[255] = 16;
  QCOMPARE(bar_heights(histogram, 4), (std::vector<double>{0.5, 0, 0, 1}));
  QCOMPARE(bar_heights({}, 3), (std::vector<double>{0, 0, 0}));
}

void IsosurfaceDialogTest::the_surface_follows_the_mark() {
  const SampleProject sample;
  Workbench workbench(sample.open(), {});
  workbench.display.set_volume(workbench.document.volumes()[0].id);
  IsosurfaceDialog dialog(workbench, 0);
  dialog.show();
  QVERIFY(QTest::qWaitForWindowExposed(&dialog));
  QTRY_VERIFY_WITH_TIMEOUT(dialog.isosurface() != 0, 30'000);
  QCOMPARE(workbench.display.isosurfaces().size(), std::size_t{1});
  QCOMPARE(workbench.display.isosurfaces()[0].volume, workbench.document.volumes()[0].id);
  auto* histogram = dialog.findChild<ValueHistogram*>();
  QSignalSpy changes(&workbench.display, &Display::isosurfaces_changed);
  QTest::mouseClick(histogram, Qt::LeftButton, {}, {histogram->width() / 4, 30});
  QCOMPARE(changes.size(), 1);
  const double value = workbench.display.isosurfaces()[0].value;
  QVERIFY(std::abs(histogram->x_of(value) - histogram->width() / 4.0) < 1);
  QVERIFY(std::abs(dialog.findChild<QDoubleSpinBox*>(QStringLiteral("value"))->value() - value) < 1e-3);
  dialog.findChild<QDoubleSpinBox*>(QStringLiteral("value"))->setValue(0.25);
  QCOMPARE(workbench.display.isosurfaces()[0].value, 0.25);
  QCOMPARE(histogram->value(), 0.25);
  auto* shown_as = dialog.findChild<QComboBox*>(QStringLiteral("shown as"));
  QVERIFY(workbench.display.isosurfaces()[0].as_picture);
  QCOMPARE(shown_as->currentIndex(), 0);
  QTest::keyClick(shown_as, Qt::Key_Down);
  QVERIFY(!workbench.display.isosurfaces()[0].as_picture);
  QCOMPARE(workbench.display.isosurfaces()[0].value, 0.25);
  keep_picture(dialog, QStringLiteral("isosurface"));
  dialog.accept();
  QCOMPARE(workbench.display.isosurfaces().size(), std::size_t{1});
}

void IsosurfaceDialogTest::cancel_puts_back_what_was() {
  const SampleProject sample;
  Workbench workbench(sample.open(), {});
  const Id volume = workbench.document.volumes()[0].id;
  const Id shown = workbench.display.add_isosurface(volume, 0.5);
  {
    IsosurfaceDialog dialog(workbench, shown);
    auto* value = dialog.findChild<QDoubleSpinBox*>(QStringLiteral("value"));
    QTRY_VERIFY_WITH_TIMEOUT(value->isEnabled(), 30'000);
    QCOMPARE(value->value(), 0.5);
    value->setValue(0.1);
    QCOMPARE(workbench.display.isosurfaces()[0].value, 0.1);
    dialog.reject();
    QCOMPARE(workbench.display.isosurfaces()[0].value, 0.5);
  }
  IsosurfaceDialog dialog(workbench, 0);
  QTRY_VERIFY_WITH_TIMEOUT(dialog.isosurface() != 0, 30'000);
  QCOMPARE(workbench.display.isosurfaces().size(), std::size_t{2});
  dialog.reject();
  QCOMPARE(workbench.display.isosurfaces().size(), std::size_t{1});
}

static const RegisterTest<IsosurfaceDialogTest> registered;

}  // namespace footwall::ui

#include "isosurface_dialog_test.moc"
