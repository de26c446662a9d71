#include "ui/panels/properties.h"

#include <QDateTime>
#include <QLocale>
#include <algorithm>
#include <cmath>

#include "engine/extract/face_geometry.h"
#include "storage/base/error.h"
#include "storage/survey/lattice.h"
#include "ui/model/unit_text.h"

namespace footwall::ui {
namespace {

using Rows = std::vector<std::pair<QString, QString>>;

QString tr(const char* text) {
  return QCoreApplication::translate("Properties", text);
}

QString text_of(std::string_view text) {
  return QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size()));
}

QString number(std::int64_t value) {
  return QLocale(QLocale::English).toString(static_cast<qlonglong>(value));
}

QString short_number(double value) {
  return std::isnan(value) ? QStringLiteral("–") : QString::number(value, 'g', 5);
}

// "today 14:06", else the day.
QString time_text(const std::string& utc) {
  const QDateTime when = QDateTime::fromString(QString::fromStdString(utc), Qt::ISODate).toLocalTime();
  if (!when.isValid()) return QString::fromStdString(utc);
  if (when.date() == QDate::currentDate()) return tr("today %1").arg(when.toString(QStringLiteral("HH:mm")));
  return when.toString(QStringLiteral("yyyy-MM-dd HH:mm"));
}

QString area_text(double square_metres) {
  return square_metres >= 1e5 ? tr("%1 km²").arg(square_metres / 1e6, 0, 'f', 2)
                              : tr("%1 m²").arg(square_metres, 0, 'f', 0);
}

void add_fault(const Fault& fault, const Workbench& bench, Properties& to) {
  const project::FaultRecord& record = fault.record;
  to.title = tr("Fault %1").arg(QString::fromStdString(record.name));
  const auto interpolated =
      std::ranges::count(fault.pillars, survey::PillarKind::kInterpolated, &survey::Pillar::kind);
  std::size_t nodes = 0;
  for (const survey::Pillar& pillar : fault.pillars) nodes += pillar.nodes.size();
  const QString pillars = QString::number(fault.pillars.size());
  to.rows.emplace_back(
      tr("pillars"), interpolated == 0 ? pillars : tr("%1 (%2 interpolated)").arg(pillars).arg(interpolated));
  to.rows.emplace_back(tr("nodes"), number(static_cast<std::int64_t>(nodes)));
  const auto surface = bench.surfaces.surface(record.id);
  if (surface && bench.document.survey()) {
    to.rows.emplace_back(tr("faces"), number(static_cast<std::int64_t>(surface->faces.size())));
    const auto velocity = velocity_of(bench.document.project());
    const ShapeFacts shape = shape_facts(*surface, *bench.document.survey(), velocity);
    const bool by_velocity = velocity && bench.document.survey()->domain == survey::Domain::kTime;
    to.rows.emplace_back(tr("area"),
                         !shape.area   ? tr("%1 voxels² (no velocity)").arg(std::lround(shape.area_voxels))
                         : by_velocity ? tr("%1 (v %2 m/s)").arg(area_text(*shape.area)).arg(*velocity)
                                       : area_text(*shape.area));
    if (shape.dip_low) {
      to.rows.emplace_back(tr("dip"), tr("%1–%2°, mean %3°")
                                          .arg(std::lround(*shape.dip_low))
                                          .arg(std::lround(*shape.dip_high))
                                          .arg(std::lround(*shape.dip_mean)));
    }
  }
  const QString problem = bench.surfaces.problem(record.id);
  if (!problem.isEmpty()) to.rows.emplace_back(tr("surface"), problem);
  to.rows.emplace_back(tr("modified"), time_text(record.modified));
  if (record.locked) to.rows.emplace_back(tr("locked"), tr("cannot be edited"));
}

void add_pillar(const survey::Pillar& pillar, const Fault* fault, Properties& to) {
  to.title = tr("Pillar %1").arg(pillar.id);
  if (fault != nullptr) to.rows.emplace_back(tr("fault"), QString::fromStdString(fault->record.name));
  to.rows.emplace_back(tr("kind"), text_of(survey::name_of(pillar.kind)));
  to.rows.emplace_back(tr("nodes"), QString::number(pillar.nodes.size()));
  if (pillar.kind == survey::PillarKind::kInterpolated) {
    to.rows.emplace_back(tr("between"), tr("pillars %1 and %2, at %3 %")
                                            .arg(pillar.parent_a)
                                            .arg(pillar.parent_b)
                                            .arg(std::lround(100 * pillar.parameter)));
  }
}

void add_node(Id id, const Workbench& bench, Properties& to) {
  const Fault* fault = bench.document.fault_of_node(id);
  if (fault == nullptr) return;
  to.title = tr("Node");
  to.rows.emplace_back(tr("fault"), QString::fromStdString(fault->record.name));
  for (const survey::Pillar& pillar : fault->pillars) {
    const auto node = std::ranges::find(pillar.nodes, id, &survey::PillarNode::id);
    if (node == pillar.nodes.end()) continue;
    to.rows.emplace_back(
        tr("pillar"),
        tr("%1, node %2 of %3").arg(pillar.id).arg(node - pillar.nodes.begin() + 1).arg(pillar.nodes.size()));
    const auto& survey = bench.document.survey();
    const QString unit = survey ? QString::fromStdString(survey->horizontal_unit) : QString();
    const QString z_unit = survey ? text_of(survey::name_of(survey->vertical_unit)) : QString();
    to.rows.emplace_back(QStringLiteral("X"),
                         QStringLiteral("%1 %2").arg(node->position.x, 0, 'f', 1).arg(unit));
    to.rows.emplace_back(QStringLiteral("Y"),
                         QStringLiteral("%1 %2").arg(node->position.y, 0, 'f', 1).arg(unit));
    to.rows.emplace_back(QStringLiteral("z"),
                         QStringLiteral("%1 %2").arg(node->position.z, 0, 'f', 1).arg(z_unit));
    if (!survey) continue;
    const survey::IndexPoint at = survey->index_of(node->position);
    to.rows.emplace_back(tr("inline"),
                         QString::number(survey->inlines.first + at.i * survey->inlines.step, 'f', 2));
    to.rows.emplace_back(tr("crossline"),
                         QString::number(survey->crosslines.first + at.j * survey->crosslines.step, 'f', 2));
  }
}

void add_face(const Item& face, const Workbench& bench, Properties& to) {
  const Fault* fault = bench.document.fault(face.id);
  const auto surface = bench.surfaces.surface(face.id);
  if (fault == nullptr || !surface) return;
  to.title = tr("Face %1 of %2").arg(face.number).arg(QString::fromStdString(fault->record.name));
  const auto found = std::ranges::find_if(surface->faces, [&](const project::MeshFace& one) {
    return one.panel == face.panel && one.n == face.number;
  });
  if (found == surface->faces.end()) return;
  const auto place = static_cast<std::size_t>(found - surface->faces.begin());
  if (const auto& run = bench.shown_numbers.run())
    to.rows.emplace_back(tr("numbers"), tr("of %1; places as now").arg(words_for(*run)));
  for (const project::StatisticRecord& statistic : bench.surfaces.statistics()) {
    const auto numbers = bench.shown_numbers.numbers(face.id, QString::fromStdString(statistic.name));
    if (!numbers || place >= numbers->values.size()) continue;
    QString text = short_number(numbers->values[place]);
    if (const QString unit = unit_text(statistic.unit_rule); !unit.isEmpty()) text += QLatin1Char(' ') + unit;
    if (place < numbers->stale.size() && numbers->stale[place] != 0)
      text = tr("%1 (before it moved)").arg(text);
    to.rows.emplace_back(QString::fromStdString(statistic.name), text);
  }
}

void add_volume(const project::VolumeRecord& volume, const project::Project& project, Properties& to) {
  to.title = tr("Volume %1").arg(QString::fromStdString(volume.name));
  to.rows.emplace_back(tr("size"),
                       tr("%1 × %2 × %3").arg(volume.dims[0]).arg(volume.dims[1]).arg(volume.dims[2]));
  to.rows.emplace_back(tr("role"), QString::fromStdString(volume.role));
  to.rows.emplace_back(tr("range"), tr("%1 to %2").arg(short_number(volume.min), short_number(volume.max)));
  to.rows.emplace_back(tr("mean"), tr("%1 ± %2").arg(short_number(volume.mean), short_number(volume.stddev)));
  to.rows.emplace_back(tr("nulls"), number(volume.null_count));
  to.rows.emplace_back(tr("live traces"), number(volume.live_traces));
  to.rows.emplace_back(tr("on disk"), QLocale(QLocale::English).formattedDataSize(volume.bytes));
  to.rows.emplace_back(tr("source"), QString::fromStdString(volume.source));
  to.rows.emplace_back(tr("file"), QString::fromStdString(project.volume_path(volume).string()));
  to.rows.emplace_back(tr("checksum"), QString::fromStdString(volume.checksum));
}

void add_isosurface(const IsosurfaceLook& look, const Document& document, Properties& to) {
  to.title = look.name.isEmpty() ? tr("Isosurface") : tr("Isosurface %1").arg(look.name);
  const auto& volumes = document.volumes();
  const auto volume = std::ranges::find(volumes, look.volume, &project::VolumeRecord::id);
  const bool is_there = volume != volumes.end();
  to.rows.emplace_back(tr("volume"), is_there ? QString::fromStdString(volume->name) : tr("no volume"));
  QString value = short_number(look.value);
  if (is_there && volume->role != "other") value += QLatin1Char(' ') + QString::fromStdString(volume->role);
  to.rows.emplace_back(tr("value"), value);
  to.rows.emplace_back(tr("colour"), look.colour);
  to.rows.emplace_back(tr("shown as"),
                       look.as_picture ? tr("picture by the engine") : tr("mesh of triangles"));
  if (!look.visible) to.rows.emplace_back(tr("hidden"), tr("its ring in the project panel shows it"));
}

void add_survey(const Workbench& bench, Properties& to) {
  to.title = tr("Survey");
  const survey::Geometry& survey = *bench.document.survey();
  const QString unit = text_of(survey::name_of(survey.vertical_unit));
  const auto lines = [](const survey::LineAxis& axis) {
    return tr("%1–%2 by %3").arg(axis.first).arg(axis.last()).arg(axis.step);
  };
  to.rows.emplace_back(tr("inlines"), lines(survey.inlines));
  to.rows.emplace_back(tr("crosslines"), lines(survey.crosslines));
  to.rows.emplace_back(tr("samples"),
                       tr("%1, every %2 %3").arg(survey.samples).arg(survey.interval).arg(unit));
  to.rows.emplace_back(tr("from, to"),
                       QStringLiteral("%1–%2 %3")
                           .arg(survey.z0)
                           .arg(survey.z0 + static_cast<double>(survey.samples - 1) * survey.interval)
                           .arg(unit));
  to.rows.emplace_back(tr("domain"), text_of(survey::name_of(survey.domain)));
  to.rows.emplace_back(tr("CRS"), survey.crs.empty() ? tr("not stated") : QString::fromStdString(survey.crs));
  if (survey.domain == survey::Domain::kTime) {
    const auto velocity = velocity_of(bench.document.project());
    to.rows.emplace_back(tr("velocity"), velocity ? tr("%1 m/s").arg(*velocity) : tr("not set"));
  }
  for (const std::string& assumed : survey.assumed)
    to.rows.emplace_back(tr("assumed"), QString::fromStdString(assumed));
}

void add_run(const project::RunRecord& run, Properties& to) {
  to.title = run.name.empty() ? tr("Run %1").arg(run.id) : tr("Run %1").arg(QString::fromStdString(run.name));
  to.rows.emplace_back(tr("volume"), QString::fromStdString(run.volume));
  to.rows.emplace_back(tr("made"), time_text(run.when));
  const QJsonObject parameters = QJsonDocument::fromJson(QByteArray::fromStdString(run.parameters)).object();
  for (auto one = parameters.begin(); one != parameters.end(); ++one) {
    if (!one->isObject() && !one->isArray()) to.rows.emplace_back(one.key(), one->toVariant().toString());
  }
}

}  // namespace

std::optional<double> velocity_of(const project::Project& project) {
  const auto stored = project.setting("velocity");
  bool ok = false;
  const double value = stored ? QString::fromStdString(*stored).toDouble(&ok) : 0;
  return ok && std::isfinite(value) && value > 0 ? std::optional(value) : std::nullopt;
}

ShapeFacts shape_facts(const FaultSurface& surface, const survey::Geometry& survey,
                       std::optional<double> velocity) {
  ShapeFacts facts;
  const survey::Lattice lattice(survey);
  double area = 0, weighted_dip = 0;
  bool metric = !surface.faces.empty();
  for (const project::MeshFace& face : surface.faces) {
    survey::LatticeTriangle corners;
    for (std::size_t n = 0; n < 3; ++n) {
      corners[n] = lattice.from_index(surface.places[static_cast<std::size_t>(face.vertices[n])]);
    }
    const extract::FaceGeometry shape = extract::face_geometry(survey, corners, velocity);
    facts.area_voxels += shape.area_voxels;
    if (std::isnan(shape.area)) {
      metric = metric && shape.area_voxels == 0;  // of no extent; else not metric at all
      continue;
    }
    area += shape.area;
    if (std::isnan(shape.dip)) continue;
    weighted_dip += shape.area * shape.dip;
    facts.dip_low = std::min(facts.dip_low.value_or(shape.dip), shape.dip);
    facts.dip_high = std::max(facts.dip_high.value_or(shape.dip), shape.dip);
  }
  if (metric) facts.area = area;
  if (facts.dip_low && area > 0) facts.dip_mean = weighted_dip / area;
  if (!facts.dip_mean) facts.dip_low = facts.dip_high = std::nullopt;
  return facts;
}

Properties properties_of(const Item& item, const Workbench& bench) {
  Properties found;
  try {
    switch (item.kind) {
      case Item::Kind::kFault:
        if (const Fault* fault = bench.document.fault(item.id)) add_fault(*fault, bench, found);
        break;
      case Item::Kind::kPillar:
        if (const survey::Pillar* pillar = bench.document.pillar(item.id)) {
          add_pillar(*pillar, bench.document.fault_of_pillar(item.id), found);
        }
        break;
      case Item::Kind::kNode:
        add_node(item.id, bench, found);
        break;
      case Item::Kind::kFace:
        add_face(item, bench, found);
        break;
      case Item::Kind::kVolume: {
        const auto& volumes = bench.document.volumes();
        const auto volume = std::ranges::find(volumes, item.id, &project::VolumeRecord::id);
        if (volume != volumes.end()) add_volume(*volume, bench.document.project(), found);
        break;
      }
      case Item::Kind::kSurvey:
        if (bench.document.survey()) add_survey(bench, found);
        break;
      case Item::Kind::kRun:
        add_run(bench.document.project().run(item.id), found);
        break;
      case Item::Kind::kView: {
        const project::ViewRecord view = bench.document.project().view(item.name.toStdString());
        found.title = tr("View %1").arg(item.name);
        found.rows.emplace_back(tr("camera"), QString::fromStdString(view.camera));
        found.rows.emplace_back(tr("made"), time_text(view.when));
        break;
      }
      case Item::Kind::kIsosurface: {
        const auto& all = bench.display.isosurfaces();
        const auto look = std::ranges::find(all, item.id, &IsosurfaceLook::id);
        if (look != all.end()) add_isosurface(*look, bench.document, found);
        break;
      }
      case Item::Kind::kSection:
      case Item::Kind::kNone:
        break;
    }
  } catch (const Error& error) {
    found.rows.emplace_back(tr("error"), QString::fromStdString(error.message()));
  }
  return found;
}

}  // namespace footwall::ui
