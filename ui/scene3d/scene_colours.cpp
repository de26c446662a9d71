// What colours the faces: range, colour tables, and the bar that says what they mean.
#include <QCoreApplication>
#include <algorithm>
#include <array>
#include <cmath>

#include "ui/model/unit_text.h"
#include "ui/scene3d/scene_drawing.h"

namespace footwall::ui {

using render::Vec3;

void SceneDrawing::refresh_range() {
  if (!std::exchange(range_old_, false)) return;
  const FaceLook& look = workbench_.display.faces();
  if (look.low && look.high) {
    range_ = {*look.low, *look.high};
  } else {
    range_ = source.range(shown_faults(), look.statistic);
    if (range_ && look.low) range_->first = *look.low;
    if (range_ && look.high) range_->second = *look.high;
  }
  bar_ = colour_bar();
  flat_old_ = true;
}

GLuint SceneDrawing::colours_named(const QString& name) const {
  const auto known = colour_tables_.find(name);
  if (known != colour_tables_.end()) return known->second;
  const render::ColourMap* map = &render::ColourMap::named("viridis");
  for (const render::ColourMap& one : render::ColourMap::all()) {
    if (QString::fromUtf8(one.name().data(), static_cast<qsizetype>(one.name().size())) == name) map = &one;
  }
  GLuint texture = 0;
  gl_->glCreateTextures(GL_TEXTURE_2D, 1, &texture);
  gl_->glTextureStorage2D(texture, 1, GL_RGBA8, 256, 1);
  gl_->glTextureSubImage2D(texture, 0, 0, 0, 256, 1, GL_RGBA, GL_UNSIGNED_BYTE, map->table().data());
  gl_->glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl_->glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  gl_->glTextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  return colour_tables_[name] = texture;
}

FaceColouring SceneDrawing::colouring_of(Id fault) const {
  const FaceLook& look = workbench_.display.faces();
  const Fault* record = workbench_.document.fault(fault);
  const QColor own(record == nullptr ? QString() : QString::fromStdString(record->record.colour));
  FaceColouring how;
  how.edges = look.edges;
  if (own.isValid()) how.plain_colour = {own.redF(), own.greenF(), own.blueF()};
  const Freshness state = source.freshness(fault, look.statistic);
  how.plain = look.colours != FaceColours::kStatistic || state == Freshness::kPlain || !range_;
  // Of a run the faces that have moved since are hatched, and no others.
  how.hatched = state == Freshness::kStale && !workbench_.shown_numbers.is_of_run(look.statistic);
  if (look.colours == FaceColours::kVoxels && frame_) {
    const SampleLook& samples = workbench_.display.samples();
    const SampleColours as_in_sections = sample_colours();
    how.plain = how.hatched = false;
    how.voxels = true;
    how.to_voxels = to_voxels();
    how.interpolate = samples.interpolate;
    how.range = {static_cast<float>(as_in_sections.low()), static_cast<float>(as_in_sections.high())};
    how.colours = colours_named(samples.colour_map);
    return how;
  }
  if (how.plain) return how;
  how.range = {static_cast<float>(range_->first), static_cast<float>(range_->second)};
  const std::string_view name = bar_ ? bar_->colours->name() : "viridis";
  how.colours = colours_named(QString::fromUtf8(name.data(), static_cast<qsizetype>(name.size())));
  return how;
}

SampleColours SceneDrawing::sample_colours() const {
  const SectionReader::VolumeFacts* facts = workbench_.sections.facts(workbench_.display.volume());
  return {workbench_.display.samples(), facts != nullptr ? facts : voxel_facts};
}

// The frame is an affine map of index space: its inverse.
render::Matrix4 SceneDrawing::to_voxels() const {
  const Vec3 zero = frame_->scene_of(survey::IndexPoint{0, 0, 0});
  const Vec3 a = frame_->scene_of(survey::IndexPoint{1, 0, 0}) - zero;
  const Vec3 b = frame_->scene_of(survey::IndexPoint{0, 1, 0}) - zero;
  const Vec3 c = frame_->scene_of(survey::IndexPoint{0, 0, 1}) - zero;
  const double det = dot(a, cross(b, c));
  render::Matrix4 inverse{};
  inverse[15] = 1;
  const std::array rows{cross(b, c), cross(c, a), cross(a, b)};
  for (std::size_t n = 0; n < 3; ++n) {
    const Vec3 row = rows[n] * (1 / det);
    inverse[4 * n] = row.x;
    inverse[4 * n + 1] = row.y;
    inverse[4 * n + 2] = row.z;
    inverse[4 * n + 3] = -dot(row, zero);
  }
  return inverse;
}

std::optional<ColourBar> SceneDrawing::voxel_bar() const {
  const auto& volumes = workbench_.document.volumes();
  const auto volume = std::ranges::find(volumes, workbench_.display.volume(), &project::VolumeRecord::id);
  const std::set<Id> shown = shown_faults();
  if (volume == volumes.end() || std::ranges::none_of(shown, [this](Id fault) { return meshes_.has(fault); }))
    return {};
  const SampleColours as_in_sections = sample_colours();
  ColourBar bar;
  bar.title = QString::fromStdString(volume->name);
  bar.unit = volume->role == "amplitude" ? QStringLiteral("amplitude") : QString();
  bar.range = {as_in_sections.low(), as_in_sections.high()};
  bar.state = voxels_are_there ? Freshness::kFresh : Freshness::kFollowing;
  bar.colours = &render::ColourMap::named("grey");
  for (const render::ColourMap& one : render::ColourMap::all()) {
    if (workbench_.display.samples().colour_map.toStdString() == one.name()) bar.colours = &one;
  }
  return bar;
}

// Why no face has a value of a statistic.
QString SceneDrawing::missing_for(const QString& statistic) const {
  const auto tr = [](const char* words) { return QCoreApplication::translate("SceneView", words); };
  if (workbench_.shown_numbers.is_of_run(statistic))
    return workbench_.shown_numbers.is_reading() ? tr("is being read") : tr("not in this run");
  const auto& survey = workbench_.document.survey();
  constexpr std::array kInMetres{"dip", "area", "metres_along_normal", "offset"};
  const bool in_metres =
      std::ranges::any_of(kInMetres, [&](const char* one) { return statistic == QLatin1String(one); });
  if (in_metres && survey && !survey->has_metric_depth() && !workbench_.document.velocity())
    return tr("needs a velocity (Survey > Velocity)");
  switch (workbench_.engine.state()) {
    case EngineLink::State::kOff:
    case EngineLink::State::kLost:
      return tr("the engine is off (Compute > Engine)");
    case EngineLink::State::kStarting:
      return tr("the engine starts");
    default:
      return {};
  }
}

std::optional<ColourBar> SceneDrawing::colour_bar() const {
  const FaceLook& look = workbench_.display.faces();
  if (look.colours == FaceColours::kVoxels) return voxel_bar();
  if (look.colours != FaceColours::kStatistic) return {};
  ColourBar bar;
  bar.title = look.statistic == QStringLiteral("variance")
                  ? QCoreApplication::translate("SceneView", "amplitude variance")
                  : QString(look.statistic).replace(u'_', u' ');
  QString map = look.colour_map;
  for (const project::StatisticRecord& statistic : source.statistics()) {
    if (QString::fromStdString(statistic.name) != look.statistic) continue;
    bar.unit = unit_text(statistic.unit_rule);
    if (map.isEmpty()) map = QString::fromStdString(statistic.colour_map);
  }
  bar.colours = &render::ColourMap::named("viridis");
  for (const render::ColourMap& one : render::ColourMap::all()) {
    if (QString::fromUtf8(one.name().data(), static_cast<qsizetype>(one.name().size())) == map)
      bar.colours = &one;
  }
  // The bar's state is that of the colours that are least worth.
  int shown = 0;
  bar.state = Freshness::kFresh;
  for (const Id fault : shown_faults()) {
    if (!meshes_.has(fault)) continue;
    ++shown;
    const Freshness state = source.freshness(fault, look.statistic);
    if (state == Freshness::kPlain) {
      ++bar.not_computed;
    } else {
      bar.state = std::max(bar.state, state);
    }
  }
  if (shown == 0) return {};
  if (workbench_.shown_numbers.is_of_run(look.statistic)) {
    bar.run = workbench_.shown_numbers.origin();
    if (workbench_.shown_numbers.is_reading()) bar.missing = missing_for(look.statistic);
  }
  if (range_) {
    bar.range = {range_->first, range_->second};
  } else {
    bar.state = Freshness::kPlain;
    bar.unit.clear();
    bar.missing = missing_for(look.statistic);
  }
  return bar;
}

}  // namespace footwall::ui
