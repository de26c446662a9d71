// How the scene is drawn: the layer of all that stands still in slices, what moves over it, and the coarse
// scene.
#include <algorithm>
#include <cmath>

#include "storage/base/error.h"
#include "ui/model/sample_colours.h"
#include "ui/scene3d/scene_drawing.h"

namespace footwall::ui {

Pass SceneDrawing::pass_now() const {
  Pass pass;
  pass.camera = seen();
  pass.whole = pass.camera.view_projection;
  pass.width = pass.whole_width = std::max(1, static_cast<int>(std::lround(view_.width() * pixel_)));
  pass.height = pass.whole_height = std::max(1, static_cast<int>(std::lround(view_.height() * pixel_)));
  pass.pixel = pixel_;
  pass.heights = heights_;
  return pass;
}

std::vector<SceneDrawing::Step> SceneDrawing::steps_of(const std::set<Id>& without_faults,
                                                       Id without_plane) const {
  std::vector<Step> steps{{.kind = Step::Kind::kBackground}};
  for (const Id fault : shown_faults()) {
    if (without_faults.contains(fault)) continue;
    const std::size_t count = meshes_.face_count(fault);
    for (std::size_t first = 0; first < count; first += kWorkPerSlice) {
      steps.push_back({Step::Kind::kFaces, fault, first, std::min(kWorkPerSlice, count - first)});
    }
  }
  for (const IsosurfaceLook& look : shown_shapes()) {
    const std::size_t count = shapes_.triangle_count(look.id);
    for (std::size_t first = 0; first < count; first += kWorkPerSlice) {
      steps.push_back({Step::Kind::kIsosurface, look.id, first, std::min(kWorkPerSlice, count - first)});
    }
  }
  for (const Display::ShownSection& shown : workbench_.display.sections()) {
    if (shown.in_scene && shown.id != without_plane)
      steps.push_back({.kind = Step::Kind::kPlane, .id = shown.id});
  }
  steps.push_back({.kind = Step::Kind::kPicture});
  steps.push_back({.kind = Step::Kind::kMarks});
  steps.push_back({.kind = Step::Kind::kLabels});
  return steps;
}

void SceneDrawing::start(Layer& layer, const std::set<Id>& without_faults, Id without_plane) {
  layer.steps = steps_of(without_faults, without_plane);
  layer.next = 0;
  layer.loose_faults = without_faults;
  layer.loose_plane = without_plane;
  layer.under_way = true;
}

void SceneDrawing::begin(GLuint target, const Pass& pass) {
  Gl& gl = *gl_;
  gl.glBindFramebuffer(GL_FRAMEBUFFER, target);
  gl.glViewport(0, 0, pass.width, pass.height);
  gl.glEnable(GL_DEPTH_TEST);
  gl.glDepthFunc(GL_LEQUAL);
  gl.glDepthMask(GL_TRUE);
  gl.glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl.glDisable(GL_BLEND);
  gl.glDisable(GL_CULL_FACE);
  gl.glDisable(GL_SCISSOR_TEST);
  gl.glDisable(GL_STENCIL_TEST);
  meshes_.look_through(gl, pass);
}

bool SceneDrawing::go_on(Layer& layer, const Pass& pass) {
  while (layer.next < layer.steps.size() && has_budget_left()) draw_step(pass, layer.steps[layer.next++]);
  return layer.next == layer.steps.size();
}

void SceneDrawing::draw_step(const Pass& pass, const Step& step) {
  Gl& gl = *gl_;
  switch (step.kind) {
    case Step::Kind::kBackground:
      return draw_background(pass);
    case Step::Kind::kFaces:
      spend(meshes_.draw(gl, step.id, colouring_of(step.id), step.first, step.count));
      return;
    case Step::Kind::kIsosurface:
      spend(shapes_.draw(gl, pass, step.id, colour_of(step.id), step.first, step.count));
      return;
    case Step::Kind::kPlane:
      return draw_plane(pass, step.id);
    case Step::Kind::kPicture:
      return picture_.draw(gl, pass);
    case Step::Kind::kMarks:
      marks_.draw(gl, pass, box_, false);
      marks_.draw(gl, pass, pillars_, true);
      marks_.draw(gl, pass, nodes_, true);
      return;
    case Step::Kind::kLabels:
      marks_.draw(gl, pass, labels_);
      return;
  }
}

void SceneDrawing::draw_background(const Pass& pass) {
  Gl& gl = *gl_;
  gl.glClearDepth(1);
  gl.glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  const auto rgb = [](const QColor& c) { return std::array<float, 3>{c.redF(), c.greenF(), c.blueF()}; };
  background_.set(gl, "top", rgb(colours_.top));
  background_.set(gl, "bottom", rgb(colours_.bottom));
  const auto whole = static_cast<float>(pass.whole_height);
  background_.set(gl, "part",
                  std::array{static_cast<float>(pass.whole_height - pass.top - pass.height) / whole,
                             static_cast<float>(pass.height) / whole});
  background_.use(gl);
  gl.glDepthMask(GL_FALSE);
  gl.glBindVertexArray(background_layout_);
  gl.glDrawArrays(GL_TRIANGLES, 0, 3);
  gl.glDepthMask(GL_TRUE);
}

void SceneDrawing::draw_plane(const Pass& pass, Id plane) {
  const SectionSamples* samples = planes_.samples(plane);
  if (samples == nullptr || !frame_) return;
  const SampleLook& look = workbench_.display.samples();
  const SampleColours as_in_sections(look, workbench_.sections.facts(samples->volume));
  const std::array<float, 2> range{static_cast<float>(as_in_sections.low()),
                                   static_cast<float>(as_in_sections.high())};
  const PlaneLook how{range, colours_named(look.colour_map), look.interpolate};
  // Where the samples are from: those of a plane that moves may come a little later.
  planes_.draw(*gl_, pass, plane, place_of(samples->section, *frame_), how);
}

std::array<float, 3> SceneDrawing::colour_of(Id isosurface) const {
  const auto& all = workbench_.display.isosurfaces();
  const auto found = std::ranges::find(all, isosurface, &IsosurfaceLook::id);
  const QColor colour(found == all.end() ? QString() : found->colour);
  if (!colour.isValid()) return {0.6F, 0.6F, 0.6F};
  return {colour.redF(), colour.greenF(), colour.blueF()};
}

void SceneDrawing::draw_shapes_quickly(const Pass& pass) {
  const std::vector<IsosurfaceLook> shown = shown_shapes();
  std::size_t level = 0;
  const auto all_of = [&](std::size_t at) {
    std::size_t all = 0;
    for (const IsosurfaceLook& look : shown) all += shapes_.coarse_count(look.id, at);
    return all;
  };
  while (level + 1 < IsosurfaceShape::kCoarse.size() && all_of(level) > kQuickShapeTriangles) ++level;
  std::size_t drawn = 0;
  for (const IsosurfaceLook& look : shown) {
    if (drawn > kQuickShapeTriangles) break;
    drawn += spend(shapes_.draw_coarse(*gl_, pass, look.id, colour_of(look.id), level));
  }
}

int SceneDrawing::quick_level() const {
  const std::set<Id> shown = shown_faults();
  const auto last = static_cast<int>(FaultMeshes::kCoarse.size()) - 1;
  for (int level = -1; level < last; ++level) {
    std::size_t all = 0;
    for (const Id fault : shown)
      all += level < 0 ? meshes_.face_count(fault) : meshes_.coarse_count(fault, level);
    if (all <= kQuickTriangles) return level;
  }
  return last;
}

// Pixels of the picture along each side of one that is drawn while the camera moves.
int SceneDrawing::pixels_at_once(const Pass& pass) const {
  if (!is_software_) return 1;
  int side = 1;
  while (pass.width / side * (pass.height / side) > kQuickPixels) ++side;
  return side;
}

// All but letters with few triangles, into the bound target.
void SceneDrawing::draw_quickly(const Pass& quick) {
  ++counters.coarse_frames;
  draw_background(quick);
  const std::set<Id> shown = shown_faults();
  const int level = quick_level();
  std::size_t drawn = 0;
  for (const Id fault : shown) {
    if (drawn > kQuickTriangles) break;
    const std::size_t count = meshes_.face_count(fault);
    if (count == 0) continue;
    FaceColouring how = colouring_of(fault);
    how.edges = how.edges && level < 0;
    drawn += spend(level < 0 ? meshes_.draw(*gl_, fault, how, 0, count)
                             : meshes_.draw_coarse(*gl_, fault, how, level));
  }
  draw_shapes_quickly(quick);
  for (const Display::ShownSection& section : workbench_.display.sections()) {
    if (section.in_scene) draw_plane(quick, section.id);
  }
  for (const auto kind : {Step::Kind::kPicture, Step::Kind::kMarks}) draw_step(quick, {.kind = kind});
  marks_.draw(*gl_, quick, loose_lines_, true);
}

// A frame of a moving camera with fewer pixels, spread over the framebuffer; letters are as sharp as ever,
// and over all.
void SceneDrawing::paint_small(GLuint framebuffer, const Pass& pass, int side) {
  Pass quick = pass;
  quick.quick = true;
  quick.width = quick.whole_width = (pass.width + side - 1) / side;
  quick.height = quick.whole_height = (pass.height + side - 1) / side;
  quick.pixel = pass.pixel / side;
  quick_target_.resize(*gl_, quick.width, quick.height, 1);
  begin(quick_target_.name(), quick);
  draw_quickly(quick);
  marks_.draw(*gl_, quick, over_lines_, false, Marks::kLift);
  draw_hover(quick);
  gl_->glBlitNamedFramebuffer(quick_target_.name(), framebuffer, 0, 0, quick.width, quick.height, 0, 0,
                              pass.width, pass.height, GL_COLOR_BUFFER_BIT, GL_LINEAR);
  begin(framebuffer, pass);
  gl_->glDisable(GL_DEPTH_TEST);
  marks_.draw(*gl_, pass, labels_);
  draw_flat(pass);
}

void SceneDrawing::draw_loose(const Pass& pass) {
  // What the layer shown lacks, and what may have another shape by now.
  std::set<Id> faults = loose_faults();
  faults.insert(front_.loose_faults.begin(), front_.loose_faults.end());
  const std::set<Id> shown = shown_faults();
  for (const Id fault : faults) {
    if (!shown.contains(fault)) continue;
    const std::size_t count = meshes_.face_count(fault);
    const FaceColouring how = colouring_of(fault);
    spend(count <= kLooseTriangles ? meshes_.draw(*gl_, fault, how, 0, count)
                                   : meshes_.draw_coarse(*gl_, fault, how, 0));
  }
  for (const Id plane : std::set<Id>{front_.loose_plane, loose_plane_}) {
    const bool is_shown =
        std::ranges::any_of(workbench_.display.sections(),
                            [plane](const Display::ShownSection& s) { return s.id == plane && s.in_scene; });
    if (is_shown) draw_plane(pass, plane);
  }
}

void SceneDrawing::draw_over(const Pass& pass) {
  refresh_loose_marks();
  marks_.draw(*gl_, pass, loose_lines_, true);
  marks_.draw(*gl_, pass, loose_dots_, true);
  gl_->glDisable(GL_DEPTH_TEST);
  marks_.draw(*gl_, pass, through_lines_, true);
  gl_->glEnable(GL_DEPTH_TEST);
}

void SceneDrawing::copy(const GlTarget& from, GLuint to, GLbitfield what) {
  gl_->glBlitNamedFramebuffer(from.name(), to, 0, 0, from.width(), from.height(), 0, 0, from.width(),
                              from.height(), what, GL_NEAREST);
}

bool SceneDrawing::has_work() const {
  if (gl_ == nullptr) return false;
  const auto has_mesh = [this](const auto& entry) { return meshes_.has(entry.first); };
  if (!meshes_to_upload_.empty() || !numbers_to_upload_.empty() || !samples_to_upload_.empty() ||
      !shapes_to_upload_.empty() || picture_to_upload_ || std::ranges::any_of(voxels_to_upload_, has_mesh)) {
    return true;
  }
  if (moving_) return false;
  return front_old_ || back_.under_way || !front_valid_ || (fine_wanted_ && !fine_valid_);
}

bool SceneDrawing::work() {
  work_ = 0;
  while (has_budget_left() && upload_one()) continue;
  if (moving_ || !has_budget_left()) return has_work();
  refresh_range();
  if (const int level = quick_level(); level >= 0 && coarse_made_ != level) {
    const std::set<Id> loose = loose_faults();
    for (const Id fault : shown_faults()) {
      if (!has_budget_left()) return true;
      if (loose.contains(fault) || !meshes_.make_coarse(*gl_, fault, level)) continue;
      work_ += meshes_.face_count(fault);
    }
    coarse_made_ = level;
  }
  const Pass pass = pass_now();
  if (front_old_ || (!front_valid_ && !back_.under_way)) {
    front_old_ = false;
    start(back_, loose_faults(), loose_plane_);
    static_marks_old_ = true;
  }
  if (back_.under_way || (fine_wanted_ && !fine_valid_)) {
    refresh_static_marks();
    if (std::exchange(camera_marks_old_, false)) refresh_camera_marks(pass, view_, texts_);
  }
  if (back_.under_way) {
    back_target_.resize(*gl_, pass.width, pass.height, 1);
    begin(back_target_.name(), pass);
    if (go_on(back_, pass)) {
      back_.under_way = false;
      std::swap(back_, front_);
      std::swap(back_target_, front_target_);
      front_valid_ = true;
      ++counters.layers;
    }
    gl_->glFinish();
    return has_work();
  }
  if (!fine_wanted_ || fine_valid_) return has_work();
  if (!fine_.under_way) start(fine_, {}, 0);
  fine_samples_.resize(*gl_, pass.width, pass.height, kFineSamples);
  begin(fine_samples_.name(), pass);
  if (go_on(fine_, pass)) {
    draw_over(pass);
    fine_.under_way = false;
    fine_target_.resize(*gl_, pass.width, pass.height, 1);
    copy(fine_samples_, fine_target_.name(), GL_COLOR_BUFFER_BIT);
    copy(fine_samples_, fine_target_.name(), GL_DEPTH_BUFFER_BIT);
    fine_valid_ = true;
  }
  gl_->glFinish();
  return has_work();
}

void SceneDrawing::paint(GLuint framebuffer) {
  ++counters.frames;
  counters.frame_triangles = 0;
  // A fault under the mouse must be on its way at once.
  for (const Id fault : loose_faults()) {
    if (meshes_to_upload_.contains(fault)) upload(fault, true);
    if (numbers_to_upload_.contains(fault)) upload_numbers(fault);
  }
  const auto waiting = samples_to_upload_.find(loose_plane_);
  if (waiting != samples_to_upload_.end()) {
    planes_.put(*gl_, waiting->first, waiting->second);
    samples_to_upload_.erase(waiting);
  }
  refresh_range();
  const Pass pass = pass_now();
  // Frames of planes and what is hovered change without the layer.
  std::vector<Line> over;
  for (const Display::ShownSection& shown : workbench_.display.sections()) add_frame_lines(over, shown.id);
  over_lines_.set(*gl_, over);
  if (!front_valid_) {
    refresh_static_marks();
    if (std::exchange(camera_marks_old_, false)) refresh_camera_marks(pass, view_, texts_);
    refresh_loose_marks();
    if (const int side = pixels_at_once(pass); side > 1) return paint_small(framebuffer, pass, side);
  }
  frame_target_.resize(*gl_, pass.width, pass.height, 1);
  if (front_valid_) {
    const GlTarget& from = fine_valid_ ? fine_target_ : front_target_;
    copy(from, frame_target_.name(), GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    begin(frame_target_.name(), pass);
    if (!fine_valid_) draw_loose(pass);
    draw_over(pass);
  } else {
    Pass quick = pass;
    quick.quick = true;
    begin(frame_target_.name(), quick);
    draw_quickly(quick);
    marks_.draw(*gl_, quick, labels_);
  }
  marks_.draw(*gl_, pass, over_lines_, false, Marks::kLift);
  draw_hover(pass);
  draw_flat(pass);
  copy(frame_target_, framebuffer, GL_COLOR_BUFFER_BIT);
  gl_->glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
}

void SceneDrawing::draw_flat(const Pass& pass) {
  if (std::exchange(flat_old_, false)) refresh_flat(view_, texts_, pixel_, true);
  if (std::exchange(selecting_old_, false)) {
    std::vector<Sprite> sprites;
    if (selecting_.size() > 1) sprites.push_back(selecting_sprite(selecting_, colours_.accent, pixel_));
    selecting_sprite_.set(*gl_, sprites);
  }
  marks_.draw(*gl_, pass, flat_sprites_);
  marks_.draw(*gl_, pass, selecting_sprite_);
}

QImage SceneDrawing::picture(const QSize& size, double scale) {
  const std::size_t before = work_;
  while (upload_one()) continue;
  refresh_range();
  refresh_static_marks();
  refresh_loose_marks();
  const QSizeF view(size.width() / scale, size.height() / scale);
  Pass whole;
  whole.camera = camera.camera(view);
  whole.whole = whole.camera.view_projection;
  whole.width = whole.whole_width = size.width();
  whole.height = whole.whole_height = size.height();
  whole.pixel = scale;
  whole.heights = heights_;
  TextImages texts;
  texts.set_style(font_, colours_.bottom, scale);
  refresh_camera_marks(whole, view, texts);
  refresh_flat(view, texts, scale, false);
  std::vector<Line> frames;
  for (const Display::ShownSection& shown : workbench_.display.sections()) add_frame_lines(frames, shown.id);
  over_lines_.set(*gl_, frames);
  const std::vector<Step> steps = steps_of({}, 0);
  QImage image(size, QImage::Format_RGBA8888);
  if (image.isNull()) throw Error(ErrorCode::kMemory, "there is no memory for a picture of this size");
  for (int top = 0; top < size.height(); top += kTile) {
    for (int left = 0; left < size.width(); left += kTile) {
      Pass part = whole;
      part.left = left;
      part.top = top;
      part.width = std::min(kTile, size.width() - left);
      part.height = std::min(kTile, size.height() - top);
      // within() says where the whole camera's picture goes in the target: the tile is a window into it.
      const double w = part.width;
      const double h = part.height;
      part.camera =
          whole.camera.within(-left / w, (size.width() - left) / w, -top / h, (size.height() - top) / h);
      tile_samples_.resize(*gl_, part.width, part.height, kFineSamples);
      tile_target_.resize(*gl_, part.width, part.height, 1);
      begin(tile_samples_.name(), part);
      for (const Step& step : steps) draw_step(part, step);
      marks_.draw(*gl_, part, loose_lines_, true);
      marks_.draw(*gl_, part, loose_dots_, true);
      marks_.draw(*gl_, part, over_lines_, false);
      marks_.draw(*gl_, part, flat_sprites_);
      copy(tile_samples_, tile_target_.name(), GL_COLOR_BUFFER_BIT);
      QImage tile(part.width, part.height, QImage::Format_RGBA8888);
      gl_->glBindFramebuffer(GL_READ_FRAMEBUFFER, tile_target_.name());
      gl_->glPixelStorei(GL_PACK_ALIGNMENT, 4);
      gl_->glReadPixels(0, 0, part.width, part.height, GL_RGBA, GL_UNSIGNED_BYTE, tile.bits());
      for (int row = 0; row < part.height; ++row) {
        std::copy_n(tile.constScanLine(part.height - 1 - row), 4 * part.width,
                    image.scanLine(top + row) + 4 * left);
      }
    }
  }
  tile_samples_.release(*gl_);
  tile_target_.release(*gl_);
  camera_marks_old_ = flat_old_ = true;
  work_ = before;
  return image.convertToFormat(QImage::Format_RGB888);
}

}  // namespace footwall::ui
