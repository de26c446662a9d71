// What changed, and its way to the graphics card.
#include "ui/scene3d/scene_drawing.h"

#include <algorithm>
#include <cmath>

#include "storage/base/error.h"
#include "storage/base/log.h"

namespace footwall::ui {
namespace {

using render::Vec3;

double velocity_of(const project::Project& project) {
  const auto text = project.setting("velocity");
  bool good = false;
  const double velocity = text ? QString::fromStdString(*text).toDouble(&good) : 0;
  return good && velocity > 0 && std::isfinite(velocity) ? velocity : 0;
}

}  // namespace

SceneDrawing::SceneDrawing(Workbench& workbench) : workbench_(workbench) {
  survey_changed();
}

void SceneDrawing::build(Gl& gl) {
  meshes_.build(gl);
  planes_.build(gl);
  marks_.build(gl);
  picture_.build(gl);
  shapes_.build(gl);
  background_.build(gl, QStringLiteral("screen.vert"), QStringLiteral("background.frag"));
  gl.glCreateVertexArrays(1, &background_layout_);
  const auto* renderer = reinterpret_cast<const char*>(gl.glGetString(GL_RENDERER));
  const QString name = QString::fromUtf8(renderer).toLower();
  is_software_ = name.contains(QStringLiteral("llvmpipe")) || name.contains(QStringLiteral("softpipe")) ||
                 name.contains(QStringLiteral("swiftshader"));
  gl_ = &gl;
  for (const Fault& fault : workbench_.document.faults()) meshes_to_upload_.insert(fault.record.id);
  content_changed();
}

void SceneDrawing::release() {
  if (gl_ == nullptr) return;
  Gl& gl = *gl_;
  meshes_.release(gl);
  planes_.release(gl);
  marks_.release(gl);
  picture_.release(gl);
  shapes_.release(gl);
  background_.release(gl);
  gl.glDeleteVertexArrays(1, &background_layout_);
  for (auto& [name, texture] : colour_tables_) gl.glDeleteTextures(1, &texture);
  colour_tables_.clear();
  for (auto* batch : {&box_, &pillars_, &loose_lines_, &through_lines_, &over_lines_, &hover_lines_})
    batch->release(gl);
  selecting_sprite_.release(gl);
  for (auto* batch : {&nodes_, &loose_dots_, &hover_dots_}) batch->release(gl);
  labels_.release(gl);
  flat_sprites_.release(gl);
  for (GlTarget* target : {&frame_target_, &quick_target_, &front_target_, &back_target_, &fine_target_,
                           &fine_samples_, &tile_target_, &tile_samples_}) {
    target->release(gl);
  }
  front_valid_ = fine_valid_ = back_.under_way = fine_.under_way = false;
  coarse_made_.reset();
  static_marks_old_ = camera_marks_old_ = true;
  gl_ = nullptr;
}

void SceneDrawing::set_style(const SceneColours& colours, const QFont& font, double pixel) {
  colours_ = colours;
  font_ = font;
  pixel_ = pixel;
  texts_.set_style(font, colours.bottom, pixel);
  static_marks_old_ = true;
  content_changed();
}

void SceneDrawing::survey_changed() {
  const auto& survey = workbench_.document.survey();
  frame_.reset();
  const std::optional<render::SceneFrame> former = std::exchange(flat_, std::nullopt);
  if (survey) {
    try {
      const double velocity = velocity_of(workbench_.document.project());
      flat_.emplace(*survey, 1, velocity);
      frame_.emplace(*survey, workbench_.display.exaggeration(), velocity);
      heights_ = workbench_.display.exaggeration();
      camera.set_corners(frame_->corners());
    } catch (const Error& error) {
      log::warn("the scene has no survey to show: " + error.message());
      frame_.reset();
      flat_.reset();
    }
  }
  const bool same = former && flat_ && former->geometry() == flat_->geometry() &&
                    former->corners()[7].z == flat_->corners()[7].z;
  if (!same) {
    ++frame_number_;
    for (const Fault& fault : workbench_.document.faults()) meshes_to_upload_.insert(fault.record.id);
  }
  static_marks_old_ = true;
  camera_moved();
}

void SceneDrawing::surfaces_changed(const std::set<Id>& faults) {
  const std::set<Id> loose = loose_faults();
  bool standing = false;
  for (const Id fault : faults) {
    meshes_to_upload_.insert(fault);
    standing = standing || !loose.contains(fault);
  }
  numbers_changed(faults);
  standing ? content_changed() : loose_changed();
}

void SceneDrawing::numbers_changed(const std::set<Id>& faults) {
  const std::set<Id> loose = loose_faults();
  const bool standing = std::ranges::any_of(faults, [&](Id fault) { return !loose.contains(fault); });
  numbers_to_upload_.insert(faults.begin(), faults.end());
  range_old_ = true;
  standing ? content_changed() : loose_changed();
}

void SceneDrawing::pillars_changed(const std::set<Id>& faults) {
  const std::set<Id> loose = loose_faults();
  loose_marks_old_ = true;
  for (const Id fault : faults) {
    if (workbench_.document.fault(fault) == nullptr && meshes_.has(fault)) meshes_to_upload_.insert(fault);
  }
  const bool standing = std::ranges::any_of(faults, [&](Id fault) { return !loose.contains(fault); });
  if (!standing) return loose_changed();
  static_marks_old_ = true;
  content_changed();
}

void SceneDrawing::selection_changed() {
  const std::set<Id> loose = loose_faults();
  std::set<Id> standing;
  for (const Id pillar : workbench_.selection.pillars()) {
    const Fault* fault = workbench_.document.fault_of_pillar(pillar);
    if (fault != nullptr && !loose.contains(fault->record.id)) standing.insert(pillar);
  }
  if (std::exchange(standing_picks_, standing) == standing) return loose_changed();
  static_marks_old_ = true;
  content_changed();
}

void SceneDrawing::content_changed() {
  front_old_ = true;
  loose_changed();
}

void SceneDrawing::loose_changed() {
  fine_valid_ = fine_wanted_ = false;
  fine_.under_way = false;
  loose_marks_old_ = flat_old_ = true;
}

void SceneDrawing::camera_moved() {
  front_valid_ = false;
  back_.under_way = false;
  camera_marks_old_ = true;
  content_changed();
}

void SceneDrawing::set_moving(bool moving) {
  moving_ = moving;
}

void SceneDrawing::want_fine() {
  fine_wanted_ = true;
}

void SceneDrawing::put_samples(Id plane, std::shared_ptr<const SectionSamples> samples) {
  samples_to_upload_[plane] = std::move(samples);
  plane == loose_plane_ ? loose_changed() : content_changed();
}

void SceneDrawing::put_voxels(Id fault, std::shared_ptr<const VoxelBricks> bricks) {
  if (bricks == nullptr && !meshes_.has(fault)) {
    voxels_to_upload_.erase(fault);
    return;
  }
  voxels_to_upload_[fault] = std::move(bricks);
  range_old_ = true;
  loose_faults().contains(fault) ? loose_changed() : content_changed();
}

void SceneDrawing::put_picture(std::shared_ptr<const Picture> picture,
                               const render::Matrix4& view_projection) {
  picture_to_upload_.emplace(std::move(picture), view_projection);
  content_changed();
}

void SceneDrawing::clear_picture() {
  picture_to_upload_.reset();
  if (!picture_.is_shown()) return;
  picture_.clear();
  content_changed();
}

void SceneDrawing::put_shape(std::shared_ptr<const IsosurfaceShape> shape) {
  const Id id = shape->isosurface;
  shapes_to_upload_[id] = std::move(shape);
  content_changed();
}

void SceneDrawing::drop_shape(Id isosurface) {
  shapes_to_upload_[isosurface] = nullptr;
  content_changed();
}

void SceneDrawing::isosurfaces_changed() {
  // Triangles that are not wanted any more leave the card.
  const auto& all = workbench_.display.isosurfaces();
  const auto is_wanted = [&](Id id) {
    return std::ranges::any_of(
        all, [id](const IsosurfaceLook& look) { return look.id == id && !look.as_picture; });
  };
  std::erase_if(shapes_to_upload_, [&](const auto& entry) { return !is_wanted(entry.first); });
  for (const Id id : shapes_.all()) {
    if (!is_wanted(id)) shapes_to_upload_[id] = nullptr;
  }
  content_changed();
}

void SceneDrawing::set_selecting(const QPolygonF& region) {
  selecting_ = region;
  selecting_old_ = true;
}

void SceneDrawing::set_loose_plane(Id plane) {
  if (plane == loose_plane_) return;
  loose_plane_ = plane;
  static_marks_old_ = true;
  content_changed();
}

void SceneDrawing::set_hot_plane(Id plane) {
  if (plane == hot_plane_) return;
  hot_plane_ = plane;
  loose_marks_old_ = flat_old_ = true;
}

std::set<Id> SceneDrawing::shown_faults() const {
  std::set<Id> shown;
  for (const Fault& fault : workbench_.document.faults()) {
    const Id id = fault.record.id;
    if (workbench_.display.is_visible({.kind = Item::Kind::kFault, .id = id})) shown.insert(id);
  }
  return shown;
}

std::vector<IsosurfaceLook> SceneDrawing::shown_shapes() const {
  std::vector<IsosurfaceLook> shown;
  for (const IsosurfaceLook& look : workbench_.display.isosurfaces()) {
    if (look.visible && !look.as_picture && shapes_.triangle_count(look.id) > 0) shown.push_back(look);
  }
  return shown;
}

std::set<Id> SceneDrawing::loose_faults() const {
  std::set<Id> loose;
  const Id active = workbench_.selection.active_fault();
  if (active != 0) loose.insert(active);
  for (const Fault& fault : workbench_.document.faults()) {
    if (workbench_.document.is_provisional(fault.record.id)) loose.insert(fault.record.id);
  }
  return loose;
}

const FaultGeometry* SceneDrawing::geometry(Id fault) const {
  return meshes_.geometry(fault);
}

Vec3 SceneDrawing::flat_of(const survey::WorldPoint& p) const {
  return flat_ ? flat_->scene_of(p) : Vec3{p.x, p.y, -p.z};
}

std::size_t SceneDrawing::spend(std::size_t triangles) {
  work_ += triangles;
  counters.triangles += triangles;
  counters.frame_triangles += triangles;
  return triangles;
}

bool SceneDrawing::upload_one() {
  if (gl_ == nullptr) return false;
  if (!meshes_to_upload_.empty()) {
    const Id fault = *meshes_to_upload_.begin();
    upload(fault, loose_faults().contains(fault));
    return true;
  }
  if (!numbers_to_upload_.empty()) {
    upload_numbers(*numbers_to_upload_.begin());
    return true;
  }
  if (!samples_to_upload_.empty()) {
    const auto first = samples_to_upload_.begin();
    planes_.put(*gl_, first->first, first->second);
    work_ += kWorkPerSlice / 4;
    samples_to_upload_.erase(first);
    return true;
  }
  // A mesh that is not there yet takes its samples later.
  const auto voxels =
      std::ranges::find_if(voxels_to_upload_, [this](const auto& entry) { return meshes_.has(entry.first); });
  if (voxels != voxels_to_upload_.end()) {
    meshes_.put_voxels(*gl_, voxels->first, voxels->second);
    work_ += kWorkPerSlice / 8 + (voxels->second ? voxels->second->count() * 4 : 0);
    voxels_to_upload_.erase(voxels);
    return true;
  }
  if (!shapes_to_upload_.empty()) {
    const auto first = shapes_to_upload_.begin();
    if (first->second != nullptr) {
      work_ += kWorkPerSlice;
      ++counters.uploads;
      shapes_.put(*gl_, first->second);
    } else {
      shapes_.remove(*gl_, first->first);
    }
    shapes_to_upload_.erase(first);
    return true;
  }
  if (picture_to_upload_) {
    picture_.put(*gl_, *picture_to_upload_->first, picture_to_upload_->second);
    picture_to_upload_.reset();
    return true;
  }
  return false;
}

void SceneDrawing::upload(Id fault, bool loose) {
  meshes_to_upload_.erase(fault);
  loose_marks_old_ = range_old_ = true;
  const auto surface = source.surface(fault);
  if (!surface || surface->faces.empty() || !flat_ || workbench_.document.fault(fault) == nullptr) {
    meshes_.remove(*gl_, fault);
    return;
  }
  const FaultGeometry* known = meshes_.geometry(fault);
  if (known != nullptr && known->shared_surface() == surface && uploaded_in_[fault] == frame_number_) return;
  uploaded_in_[fault] = frame_number_;
  auto geometry = std::make_shared<FaultGeometry>(
      surface, [this](const survey::WorldPoint& p) { return flat_->scene_of(p); });
  work_ += geometry->face_count();
  meshes_.put(*gl_, std::move(geometry));
  if (!loose) coarse_made_.reset();
  ++counters.uploads;
  upload_numbers(fault);
}

void SceneDrawing::upload_numbers(Id fault) {
  numbers_to_upload_.erase(fault);
  range_old_ = true;
  const auto numbers = source.numbers(fault, workbench_.display.faces().statistic);
  if (!numbers) return;
  meshes_.put_numbers(*gl_, fault, numbers->values, numbers->stale, numbers->hatched);
  work_ += meshes_.face_count(fault) / 4;
}

}  // namespace footwall::ui
