// Faces that show the samples that they cut.
#include <QSignalSpy>
#include <QTest>

#include "ui/model/sample_colours.h"
#include "ui/model/section_source.h"
#include "ui/scene/made_scene.h"
#include "ui/test_class.h"

namespace footwall::ui {
namespace {

void show_voxels(MadeScene& scene) {
  FaceLook look = scene.bench.display.faces();
  look.colours = FaceColours::kVoxels;
  scene.bench.display.set_faces(look);
}

void set_interpolation(MadeScene& scene, bool on) {
  SampleLook look = scene.bench.display.samples();
  look.interpolate = on;
  scene.bench.display.set_samples(look);
}

struct Compared {
  int pixels = 0;
  int alike = 0;
};

// Pixels on faces against the colour that a section would give the nearest sample there.
Compared compare_with_samples(const MadeScene& scene, const QImage& image) {
  const project::VolumeRecord& record = scene.bench.document.volumes().front();
  const volume::VolumeReader reader(scene.bench.document.project().volume_path(record));
  const survey::Index dims = reader.info().dims;
  std::vector<float> samples(static_cast<std::size_t>(dims[0] * dims[1] * dims[2]));
  reader.read({{0, 0, 0}, dims}, samples);
  const SectionReader::VolumeFacts facts = facts_of(reader.info().statistics);
  const SampleColours colours(scene.bench.display.samples(), &facts);
  Compared result;
  for (int y = 10; y < image.height(); y += 3) {
    for (int x = 10; x < image.width(); x += 3) {
      const SceneView::Under under = scene.view->under(QPointF(x + 0.5, y + 0.5));
      if (under.item.kind != Item::Kind::kFace) continue;
      const auto whole = [](double at) { return static_cast<std::int64_t>(std::floor(at + 0.5)); };
      const std::array<std::int64_t, 3> at{whole(under.place.i), whole(under.place.j), whole(under.place.k)};
      if (at[0] < 0 || at[1] < 0 || at[2] < 0 || at[0] >= dims[0] || at[1] >= dims[1] || at[2] >= dims[2])
        continue;
      const QRgb wanted =
          colours.colour_of(samples[static_cast<std::size_t>((at[0] * dims[1] + at[1]) * dims[2] + at[2])]);
      const QRgb got = image.pixel(x, y);
      ++result.pixels;
      result.alike += std::abs(qRed(got) - qRed(wanted)) <= 12 &&
                      std::abs(qGreen(got) - qGreen(wanted)) <= 12 &&
                      std::abs(qBlue(got) - qBlue(wanted)) <= 12;
    }
  }
  return result;
}

}  // namespace

class VoxelFacesTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void faces_have_the_colours_of_sections();
  void samples_stay_while_a_node_moves();
  void a_missing_volume_is_told();
};

void VoxelFacesTest::faces_have_the_colours_of_sections() {
  MadeScene scene;
  QVERIFY(scene.settle());
  const QImage variance = scene.grabbed("before_voxels");
  show_voxels(scene);
  set_interpolation(scene, false);
  QVERIFY(scene.settle());
  const QImage cells = scene.grabbed("voxels");
  const Compared found = compare_with_samples(scene, cells);
  QVERIFY2(found.pixels > 400, qPrintable(QString::number(found.pixels)));
  // Borders between voxels are mixed, and lines of the box and pillars lie over some.
  QVERIFY2(found.alike > 0.8 * found.pixels,
           qPrintable(QStringLiteral("%1 of %2").arg(found.alike).arg(found.pixels)));
  QVERIFY(compare_with_samples(scene, variance).alike < 0.2 * found.pixels);
  // Another map, another gain: the same samples, no reading.
  SampleLook look = scene.bench.display.samples();
  look.colour_map = QStringLiteral("seismic");
  look.gain = 2;
  scene.bench.display.set_samples(look);
  QVERIFY(scene.settle());
  const Compared again = compare_with_samples(scene, scene.grabbed("voxels_seismic"));
  QVERIFY2(again.alike > 0.7 * again.pixels,
           qPrintable(QStringLiteral("%1 of %2").arg(again.alike).arg(again.pixels)));
  set_interpolation(scene, true);
  QVERIFY(scene.settle());
  const QImage smooth = scene.grabbed("voxels_smooth");
  const Compared between = compare_with_samples(scene, smooth);
  QVERIFY(between.alike < again.alike);          // it runs from sample to sample
  QVERIFY(between.alike > 0.15 * again.pixels);  // about the same samples
  // Coarse frames show them, too, and exaggeration moves them along.
  scene.bench.display.set_exaggeration(2);
  set_interpolation(scene, false);
  QVERIFY(scene.settle());
  const Compared taller = compare_with_samples(scene, scene.grabbed("voxels_taller"));
  QVERIFY2(taller.alike > 0.7 * taller.pixels,
           qPrintable(QStringLiteral("%1 of %2").arg(taller.alike).arg(taller.pixels)));
}

void VoxelFacesTest::samples_stay_while_a_node_moves() {
  MadeScene scene;
  show_voxels(scene);
  set_interpolation(scene, false);
  QVERIFY(scene.settle());
  const Fault edited = scene.bench.document.faults().front();
  const Id id = edited.record.id;
  scene.bench.selection.set_active_fault(id);
  std::vector<survey::Pillar> pillars = edited.pillars;
  pillars[1].nodes[1].position.x += 12;  // half a line
  scene.bench.document.show_provisionally(id, pillars);
  scene.remake(id);
  Q_EMIT scene.bench.surfaces.surfaces_changed({id});
  QVERIFY(scene.settle());
  const Compared dragged = compare_with_samples(scene, scene.grabbed("voxels_dragged"));
  QVERIFY2(dragged.alike > 0.7 * dragged.pixels,
           qPrintable(QStringLiteral("%1 of %2").arg(dragged.alike).arg(dragged.pixels)));
  scene.bench.document.end_provisional();
  scene.remake(id);
  Q_EMIT scene.bench.surfaces.surfaces_changed({id});
  QVERIFY(scene.settle());
  const Compared released = compare_with_samples(scene, scene.grabbed("voxels_released"));
  QVERIFY(released.alike > 0.7 * released.pixels);
}

void VoxelFacesTest::a_missing_volume_is_told() {
  MadeScene scene;
  QVERIFY(scene.settle());
  std::filesystem::remove(scene.bench.document.project().volume_path(scene.bench.document.volumes().front()));
  QSignalSpy failures(&scene.bench.document, &Document::failed);
  show_voxels(scene);
  QTRY_COMPARE(failures.size(), 1);
  QVERIFY(scene.settle());  // and the faces are plain
}

static const RegisterTest<VoxelFacesTest> kRegistered;

}  // namespace footwall::ui

#include "voxel_faces_test.moc"
