#include "ui/model/workbench.h"

#include <QTest>

#include "ui/sample_project.h"
#include "ui/test_class.h"

namespace footwall::ui {

class WorkbenchTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void what_is_shown_is_stored_while_the_project_is_open();
  void each_volume_keeps_its_look();
};

void WorkbenchTest::what_is_shown_is_stored_while_the_project_is_open() {
  const SampleProject sample;
  Workbench bench(sample.open(), {});
  bench.display.add_isosurface(bench.display.volume(), 1.25);
  // As another program would find the file if this one were killed now.
  const auto stored = [&] {
    const auto setting = sample.open(project::OpenMode::kRead).setting("studio.display");
    return setting && setting->find("1.25") != std::string::npos;
  };
  QTRY_VERIFY(stored());
}

void WorkbenchTest::each_volume_keeps_its_look() {
  const SampleProject sample;
  project::Project project = sample.open();
  project::VolumeRecord other = project.volumes().front();
  other.name = "edges";
  other.role = "discontinuity";
  const Id edges = project.add_volume(other);
  QJsonObject stored;
  {
    Workbench bench(std::move(project), {});
    const Id amplitude = bench.display.volume();
    SampleLook look = bench.display.samples();
    QCOMPARE(look.colour_map, QStringLiteral("grey"));
    look.colour_map = QStringLiteral("seismic");
    look.gain = 2;
    bench.display.set_samples(look);
    bench.display.set_volume(edges);
    SampleLook first;
    first.colour_map = QStringLiteral("viridis");
    QCOMPARE(bench.display.samples(), first);
    SampleLook even = bench.display.samples();
    even.clip_percentile = 95;
    bench.display.set_samples(even);
    bench.display.set_volume(amplitude);
    QCOMPARE(bench.display.samples(), look);
    stored = bench.display.to_json();
  }
  Workbench again(sample.open(), {});
  again.display.from_json(stored);
  QCOMPARE(again.display.samples().colour_map, QStringLiteral("seismic"));
  again.display.set_volume(edges);
  QCOMPARE(again.display.samples().colour_map, QStringLiteral("viridis"));
  QCOMPARE(again.display.samples().clip_percentile, 95);
}

static const RegisterTest<WorkbenchTest> kRegistered;

}  // namespace footwall::ui

#include "workbench_test.moc"
