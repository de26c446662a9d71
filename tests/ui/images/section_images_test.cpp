// Sections as they looked when somebody looked: the data with the traces of faults, without the axes'
// letters.
#include <QTest>

#include "ui/images/image_difference.h"
#include "ui/model/workbench.h"
#include "ui/sample_project.h"
#include "ui/section/section_view.h"
#include "ui/test_class.h"

namespace footwall::ui {
namespace {

QPalette dark() {
  QPalette palette;
  palette.setColor(QPalette::Window, QColor(0x1e, 0x21, 0x26));
  palette.setColor(QPalette::Base, QColor(0x26, 0x2a, 0x31));
  palette.setColor(QPalette::WindowText, QColor(0xd6, 0xda, 0xe0));
  palette.setColor(QPalette::Highlight, QColor(0x4a, 0xa3, 0xdf));
  return palette;
}

struct OpenSection {
  OpenSection(const SampleProject& sample, const QPalette& palette, const SampleLook& look)
      : bench(sample.open(), {}),
        view(bench, bench.display.add_section({.kind = Section::Kind::kInline, .index = 20})) {
    bench.display.set_samples(look);
    view.setPalette(palette);
    view.resize(480, 360);
    view.show();
  }
  // The data's rectangle, once samples and surfaces are there.
  QImage picture() {
    SectionCanvas& canvas = view.canvas();
    const bool there = QTest::qWaitForWindowExposed(&view) &&
                       QTest::qWaitFor(
                           [&] {
                             return canvas.samples() && canvas.samples()->section == canvas.section() &&
                                    bench.surfaces.is_settled();
                           },
                           30'000);
    if (!there) return {};
    QCoreApplication::processEvents();
    return canvas.grab()
        .toImage()
        .copy(canvas.view().area().toAlignedRect())
        .convertToFormat(QImage::Format_RGB32);
  }
  Workbench bench;
  SectionView view;
};

}  // namespace

class SectionImagesTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void variable_density();
  void wiggles_on_light();
};

void SectionImagesTest::variable_density() {
  const SampleProject sample;
  SampleLook look;
  look.colour_map = QStringLiteral("seismic");
  OpenSection open(sample, dark(), look);
  QCOMPARE(compare_with_baseline(open.picture(), QStringLiteral("section_density")), QString());
  if (qEnvironmentVariableIsSet("FOOTWALL_MAKE_BASELINES")) return;
  look.colour_map = QStringLiteral("grey");
  open.bench.display.set_samples(look);
  QVERIFY(!compare_with_baseline(open.picture(), QStringLiteral("section_density")).isEmpty());
}

void SectionImagesTest::wiggles_on_light() {
  const SampleProject sample;
  SampleLook look;
  look.wiggle = true;
  look.interpolate = true;
  QPalette light;
  light.setColor(QPalette::Window, QColor(0xf4, 0xf5, 0xf7));
  light.setColor(QPalette::Base, QColor(Qt::white));
  light.setColor(QPalette::WindowText, QColor(0x23, 0x27, 0x2e));
  OpenSection open(sample, light, look);
  QCOMPARE(compare_with_baseline(open.picture(), QStringLiteral("section_wiggles")), QString());
  if (qEnvironmentVariableIsSet("FOOTWALL_MAKE_BASELINES")) return;
  look.wiggle = false;
  open.bench.display.set_samples(look);
  QVERIFY(!compare_with_baseline(open.picture(), QStringLiteral("section_wiggles")).isEmpty());
}

static const RegisterTest<SectionImagesTest> kRegistered;

}  // namespace footwall::ui

#include "section_images_test.moc"
