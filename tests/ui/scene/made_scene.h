// A scene over a small synthetic project, with surfaces, colours and samples made up here: nothing waits for
// an engine.
#pragma once
#include <QDir>
#include <QTest>
#include <cmath>
#include <map>

#include "ui/sample_project.h"
#include "ui/scene3d/scene_view.h"

namespace footwall::ui {

// The fault's pillars joined by `rows` x `columns` cells between neighbours.
inline std::shared_ptr<FaultSurface> joined(const Document& document, Id fault, int rows, int columns) {
  auto surface = std::make_shared<FaultSurface>();
  surface->fault = fault;
  std::vector<std::vector<survey::WorldPoint>> courses;
  for (const survey::Pillar& pillar : document.shown_pillars(fault)) {
    if (pillar.nodes.size() < 2) continue;
    auto& course = courses.emplace_back();
    for (int row = 0; row <= rows; ++row) {
      const double at = static_cast<double>(row) / rows * static_cast<double>(pillar.nodes.size() - 1);
      const auto n = std::min(static_cast<std::size_t>(at), pillar.nodes.size() - 2);
      const survey::WorldPoint& a = pillar.nodes[n].position;
      const survey::WorldPoint& b = pillar.nodes[n + 1].position;
      const double t = at - static_cast<double>(n);
      course.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z)});
    }
  }
  for (std::size_t p = 0; p + 1 < courses.size(); ++p) {
    const auto first = static_cast<std::int32_t>(surface->vertices.size());
    for (int column = 0; column <= columns; ++column) {
      for (int row = 0; row <= rows; ++row) {
        const double t = static_cast<double>(column) / columns;
        const survey::WorldPoint& a = courses[p][static_cast<std::size_t>(row)];
        const survey::WorldPoint& b = courses[p + 1][static_cast<std::size_t>(row)];
        surface->vertices.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z)});
      }
    }
    std::int32_t n = 0;
    for (int column = 0; column < columns; ++column) {
      for (int row = 0; row < rows; ++row) {
        const std::int32_t a = first + column * (rows + 1) + row;
        const std::int32_t b = a + rows + 1;
        surface->faces.push_back({static_cast<std::int64_t>(p), n++, {a, b, a + 1}});
        surface->faces.push_back({static_cast<std::int64_t>(p), n++, {b, b + 1, a + 1}});
      }
    }
  }
  return surface;
}

// Of three pillars each, in rows through a survey of 48 x 40 lines and 64 samples.
inline void add_many_faults(Document& document, int count) {
  const survey::Geometry survey = *document.survey();
  document.edit("Many", [&](project::Interpretation& now) {
    for (int n = 0; n < count; ++n) {
      const Id fault = now.add_fault("many " + std::to_string(n));
      for (int p = 0; p < 3; ++p) {
        const double i = 2 + 44.0 * (n % 20) / 20;
        const double j = 2 + 36.0 * (n / 20) / 10 + p;
        const std::array nodes{survey.world_of({i, j, 2}), survey.world_of({i + 1, j, 30}),
                               survey.world_of({i + 3, j, 61})};
        now.add_pillar(fault, survey::PillarKind::kInterpreted, nodes);
      }
    }
  });
}

class MadeScene {
 public:
  explicit MadeScene(const survey::Index& size = {48, 40, 64}, int rows = 14, int columns = 5)
      : project("faulted", size), bench(project.open(), {}), rows_(rows), columns_(columns) {
    // A small project's middle planes would hide its faults.
    while (!bench.display.sections().empty())
      bench.display.remove_section(bench.display.sections().front().id);
    inline_plane = bench.display.add_section({.kind = Section::Kind::kInline, .index = size[0] - 2});
    slice_plane = bench.display.add_section({.kind = Section::Kind::kSlice, .index = size[2] - 2});
    for (const Fault& fault : bench.document.faults()) remake(fault.record.id);
    bench.display.set_exaggeration(1);
    const Id shown = bench.display.volume();
    bench.display.set_volume(0);  // nothing is asked of the real reader
    view = std::make_unique<SceneView>(bench);
    view->setPalette(dark());
    view->set_source(
        {[this](Id fault) { return surfaces.contains(fault) ? surfaces[fault] : nullptr; },
         [this](Id fault, const QString&) { return numbers.contains(fault) ? numbers[fault] : nullptr; },
         [this](Id, const QString&) { return freshness; },
         [](const std::set<Id>&, const QString&) { return std::optional(std::pair(0.0, 0.42)); },
         [] {
           project::StatisticRecord variance;
           variance.name = "variance";
           variance.unit_rule = "amplitude^2";
           return std::vector{variance};
         },
         [this](const PictureRequest& request) {
           asked = request;
           return has_engine ? ++pictures : 0;
         },
         [this](QObject* asker, Id volume, const Section& section) { give(asker, volume, section); }});
    bench.display.set_volume(shown);
    view->resize(900, 700);
    view->show();
  }

  static QPalette dark() {
    QPalette palette;
    palette.setColor(QPalette::Window, QColor(0x1e, 0x21, 0x26));
    palette.setColor(QPalette::WindowText, QColor(0xd6, 0xda, 0xe0));
    palette.setColor(QPalette::Highlight, QColor(0x4a, 0xa3, 0xdf));
    return palette;
  }

  // The surface from the pillars shown, and numbers for it; tells nobody.
  void remake(Id fault) { remake(fault, rows_, columns_); }
  void remake(Id fault, int rows, int columns) {
    const auto surface = joined(bench.document, fault, rows, columns);
    auto values = std::make_shared<FaceNumbers>();
    for (std::size_t n = 0; n < surface->faces.size(); ++n) {
      const double x = static_cast<double>(n) / static_cast<double>(surface->faces.size());
      values->values.push_back(0.2 + 0.15 * std::sin(9 * x) +
                               0.05 * std::sin(static_cast<double>(n * 7919 % 101)));
    }
    values->stale.assign(surface->faces.size(), 0);
    values->hatched.assign(surface->faces.size(), 0);
    surfaces[fault] = surface;
    numbers[fault] = values;
  }

  // All of them; with how many triangles they have.
  struct Remade {
    std::set<Id> faults{};
    std::size_t triangles = 0;
  };
  Remade remake_all() {
    Remade all;
    for (const Fault& fault : bench.document.faults()) {
      remake(fault.record.id);
      all.faults.insert(fault.record.id);
      all.triangles += surfaces[fault.record.id]->faces.size();
    }
    return all;
  }

  void give(QObject* asker, Id volume, const Section& section) {
    const PlaneSize size = size_of(section, *bench.document.survey());
    auto samples = std::make_shared<SectionSamples>();
    samples->volume = volume;
    samples->section = section;
    samples->columns = static_cast<int>(size.width);
    samples->rows = static_cast<int>(size.height);
    for (int row = 0; row < samples->rows; ++row) {
      for (int column = 0; column < samples->columns; ++column) {
        const survey::IndexPoint p =
            index_of(section, {static_cast<double>(column), static_cast<double>(row)});
        samples->values.push_back(static_cast<float>(std::sin(0.6 * p.k + 0.05 * p.i + std::sin(0.1 * p.j))));
      }
    }
    Q_EMIT bench.sections.ready(asker, samples);
  }

  // Everything drawn as well as it will be.
  bool settle() const {
    return QTest::qWaitFor([this] { return view->is_settled(); }, 30000);
  }
  // What the window shows; kept in the folder FOOTWALL_PICTURES where that is set.
  QImage grabbed(const QString& name) const {
    const QImage image = view->grab_frame().convertToFormat(QImage::Format_RGB32);
    const QString folder = qEnvironmentVariable("FOOTWALL_PICTURES");
    if (!folder.isEmpty()) image.save(QDir(folder).filePath(name + QStringLiteral(".png")));
    return image;
  }
  Id first_fault() const { return bench.document.faults().front().record.id; }

  SampleProject project;
  Workbench bench;
  std::map<Id, std::shared_ptr<const FaultSurface>> surfaces;
  std::map<Id, std::shared_ptr<const FaceNumbers>> numbers;
  Freshness freshness = Freshness::kFresh;
  PictureRequest asked;
  std::uint64_t pictures = 0;
  bool has_engine = true;
  Id inline_plane = 0, slice_plane = 0;
  std::unique_ptr<SceneView> view;

 private:
  int rows_, columns_;
};

}  // namespace footwall::ui
