// The scene and the models: what it asks of them, and what their changes mean for it.
#include <algorithm>
#include <cmath>

#include "ui/scene3d/scene_private.h"

namespace footwall::ui {
namespace {

using render::Vec3;

constexpr int kRestMilliseconds = 120;
constexpr int kFineMilliseconds = 350;
constexpr int kSoonMilliseconds = 30;

}  // namespace

void SceneView::Private::connect_models() {
  work_timer.setInterval(0);
  work_timer.setSingleShot(true);
  QObject::connect(&work_timer, &QTimer::timeout, &view, [this] { do_work(); });
  rest_timer.setInterval(kRestMilliseconds);
  rest_timer.setSingleShot(true);
  QObject::connect(&rest_timer, &QTimer::timeout, &view, [this] {
    drawing.set_moving(false);
    ask_for_picture();
    changed();
  });
  fine_timer.setInterval(kFineMilliseconds);
  fine_timer.setSingleShot(true);
  QObject::connect(&fine_timer, &QTimer::timeout, &view, [this] {
    drawing.want_fine();
    work_timer.start();
  });

  soon_timer.setInterval(kSoonMilliseconds);
  soon_timer.setSingleShot(true);
  QObject::connect(&soon_timer, &QTimer::timeout, &view, [this] { changed(); });

  Document& document = workbench.document;
  Display& display = workbench.display;
  // A hand in another view moves nodes, and an engine is there that will say their colours at once.
  const auto more_follows = [this](const std::set<Id>& faults) {
    const auto is_under_hand = [this](Id fault) { return workbench.document.is_provisional(fault); };
    return !drawing.has_mouse && workbench.engine.state() == EngineLink::State::kReady &&
           std::ranges::any_of(faults, is_under_hand);
  };
  QObject::connect(&document, &Document::survey_changed, &view, [this] { survey_changed(); });
  QObject::connect(&document, &Document::shapes_changed, &view,
                   [this, more_follows](const std::set<Id>& faults) {
                     drawing.pillars_changed(faults);
                     more_follows(faults) ? changed_soon() : changed();
                   });
  const auto all_again = [this] {
    std::set<Id> all;
    for (const Fault& fault : workbench.document.faults()) all.insert(fault.record.id);
    drawing.surfaces_changed(all);
    drawing.pillars_changed(all);
    drawing.content_changed();
    changed();
  };
  QObject::connect(&document, &Document::faults_changed, &view, all_again);
  QObject::connect(&document, &Document::faults_changed, &view, [this] { ask_for_voxels(); });
  QObject::connect(&voxels, &FaceVoxels::changed, &view, [this](const std::set<Id>& faults) {
    drawing.voxel_facts = voxels.facts();
    drawing.voxels_are_there = voxels.is_settled();
    for (const Id fault : faults) drawing.put_voxels(fault, voxels.bricks(fault));
    changed();
  });
  QObject::connect(&voxels, &FaceVoxels::failed, &view, [this](const QString& message, const QString& hint) {
    Q_EMIT workbench.document.failed(message, hint);
  });
  QObject::connect(&document, &Document::volumes_changed, &view, [this] {
    asked.clear();
    ask_for_samples();
    ask_for_voxels();
    ask_for_shapes();
  });
  QObject::connect(&workbench.surfaces, &Surfaces::surfaces_changed, &view,
                   [this, more_follows](const std::set<Id>& faults) {
                     drawing.surfaces_changed(faults);
                     ask_for_voxels();
                     more_follows(faults) ? changed_soon() : changed();
                   });
  QObject::connect(&workbench.surfaces, &Surfaces::numbers_changed, &view,
                   [this](const std::set<Id>& faults) {
                     drawing.numbers_changed(faults);
                     changed();
                   });
  QObject::connect(&workbench.shown_numbers, &ShownNumbers::numbers_changed, &view,
                   [this](const std::set<Id>& faults) {
                     drawing.numbers_changed(faults);
                     changed();
                   });
  QObject::connect(&workbench.surfaces, &Surfaces::offsets_changed, &view,
                   [this](const std::set<Id>& faults) {
                     if (!comes_late(workbench.display.faces().statistic)) return;
                     drawing.numbers_changed(faults);
                     changed();
                   });
  QObject::connect(&workbench.selection, &Selection::changed, &view, [this] {
    drawing.selection_changed();
    changed();
  });
  QObject::connect(&workbench.selection, &Selection::active_fault_changed, &view, [this] {
    drawing.content_changed();
    changed();
  });
  QObject::connect(&workbench.selection, &Selection::hover_changed, &view, [this] { view.update(); });
  QObject::connect(&display, &Display::samples_changed, &view, [this] {
    ask_for_samples();
    ask_for_voxels();
    drawing.numbers_changed({});
    drawing.content_changed();
    changed();
  });
  QObject::connect(&display, &Display::faces_changed, &view, [this] {
    ask_for_voxels();
    drawing.numbers_changed(drawing.shown_faults());
    drawing.content_changed();
    changed();
  });
  QObject::connect(&display, &Display::visibility_changed, &view, [this] {
    ask_for_voxels();
    drawing.pillars_changed(drawing.shown_faults());
    drawing.numbers_changed(drawing.shown_faults());
    drawing.content_changed();
    changed();
  });
  QObject::connect(&display, &Display::sections_changed, &view, [this] { sections_changed(); });
  QObject::connect(&display, &Display::isosurfaces_changed, &view, [this] {
    ask_for_picture();
    ask_for_shapes();
  });
  QObject::connect(&display, &Display::cursor_moved, &view, [this] {
    if (drawing.has_mouse || soon_timer.isActive()) return;
    workbench.picking.is_dragging() ? changed_soon() : view.update();
  });
  QObject::connect(&display, &Display::place_shown, &view,
                   [this](const survey::IndexPoint& place, double reach) { show_place(place, reach); });
  QObject::connect(&display, &Display::scene_changed, &view, [this] {
    Display& now = workbench.display;
    if (now.exaggeration() != drawing.heights()) {
      drawing.camera.stretch(now.exaggeration() / drawing.heights());
      drawing.survey_changed();
    }
    drawing.camera.set_perspective(now.perspective());
    camera_moved();
  });
  QObject::connect(&workbench.picking, &Picking::stroke_changed, &view, [this] {
    drawing.loose_changed();
    changed();
  });
  QObject::connect(&workbench.picking, &Picking::active_pillar_changed, &view, [this] {
    drawing.loose_changed();
    changed();
  });
  QObject::connect(&workbench.picking, &Picking::hint_changed, &view, [this] { show_pointer(); });
  QObject::connect(&workbench.picking, &Picking::tool_changed, &view, [this] { show_pointer(); });
  QObject::connect(&workbench.sections, &SectionReader::ready, &view,
                   [this](QObject* asker, const std::shared_ptr<const SectionSamples>& samples) {
                     for (const auto& [plane_id, one] : askers) {
                       if (one.get() != asker || !samples) continue;
                       drawing.put_samples(plane_id, samples);
                       changed();
                     }
                   });
  QObject::connect(&workbench.engine, &EngineLink::picture, &view,
                   [this](const std::shared_ptr<const Picture>& picture) { picture_came(picture); });
  QObject::connect(&workbench.engine, &EngineLink::failed, &view, [this] { stop_waiting(); });
  QObject::connect(&workbench.engine, &EngineLink::state_changed, &view, [this] {
    const EngineLink::State state = workbench.engine.state();
    if (state == EngineLink::State::kReady && last_picture == 0) ask_for_picture();
    if (state == EngineLink::State::kOff || state == EngineLink::State::kLost) stop_waiting();
  });
}

void SceneView::Private::show_place(const survey::IndexPoint& place, double reach) {
  if (!drawing.frame()) return;
  reach *= 2;  // a place in space takes more of what is around it than one on a section
  std::vector<Vec3> corners;
  for (const double i : {-reach, reach}) {
    for (const double j : {-reach, reach}) {
      for (const double k : {-reach, reach}) {
        corners.push_back(
            drawing.frame()->scene_of(survey::IndexPoint{place.i + i, place.j + j, place.k + k}));
      }
    }
  }
  drawing.camera.fit(size(), corners);
  camera_moved();
}

void SceneView::Private::survey_changed() {
  drawing.survey_changed();
  fitted = false;
  camera_moved();
  asked.clear();
  sections_changed();
  ask_for_voxels();
  ask_for_shapes();
}

void SceneView::Private::sections_changed() {
  // The plane that moved is drawn by itself from now on, so that its next step costs no layer.
  std::set<Id> here;
  for (const Display::ShownSection& shown : workbench.display.sections()) {
    if (!shown.in_scene) continue;
    here.insert(shown.id);
    const auto known = asked.find(shown.id);
    if (known != asked.end() && known->second.second != shown.section) drawing.set_loose_plane(shown.id);
  }
  const bool same = std::ranges::equal(here, askers, {}, {}, [](const auto& entry) { return entry.first; });
  if (!same) drawing.content_changed();
  std::erase_if(askers, [&](const auto& entry) { return !here.contains(entry.first); });
  std::erase_if(asked, [&](const auto& entry) { return !here.contains(entry.first); });
  for (const Id id : here) {
    if (!askers.contains(id)) askers[id] = std::make_unique<QObject>();
  }
  ask_for_samples();
  drawing.loose_changed();
  changed();
}

void SceneView::Private::ask_for_samples() {
  const Id volume = workbench.display.volume();
  if (volume == 0 || !workbench.document.survey()) return;
  for (const Display::ShownSection& shown : workbench.display.sections()) {
    const auto asker = askers.find(shown.id);
    if (asker == askers.end()) continue;
    const std::pair<Id, Section> wanted(volume, shown.section);
    const auto known = asked.find(shown.id);
    if (known != asked.end() && known->second == wanted) continue;
    asked[shown.id] = wanted;
    drawing.source.ask(asker->second.get(), volume, shown.section);
  }
}

// While a gesture is under way the samples of before serve: bricks reach some voxels beyond a face.
void SceneView::Private::ask_for_voxels() {
  std::vector<std::shared_ptr<const FaultSurface>> surfaces;
  const bool shown = workbench.display.faces().colours == FaceColours::kVoxels;
  for (const Id fault : shown ? drawing.shown_faults() : std::set<Id>()) {
    if (workbench.document.is_provisional(fault)) return;
    const auto surface = drawing.source.surface(fault);
    if (surface && !surface->faces.empty()) surfaces.push_back(surface);
  }
  voxels.want(shown ? workbench.display.volume() : 0, surfaces);
  drawing.voxel_facts = voxels.facts();
  drawing.voxels_are_there = voxels.is_settled();
}

// The triangles of isosurfaces that are shown by them, newest value first.
void SceneView::Private::ask_for_shapes() {
  const auto& flat = drawing.flat();
  std::vector<IsosurfaceRequest> requests;
  for (const IsosurfaceLook& look : workbench.display.isosurfaces()) {
    if (look.as_picture || !look.visible || !flat) continue;
    const auto& volumes = workbench.document.volumes();
    const auto volume = std::ranges::find(volumes, look.volume, &project::VolumeRecord::id);
    if (volume == volumes.end()) continue;
    const auto at = [&](double i, double j, double k) {
      const auto [x, y, z] = volume->origin;
      return flat->scene_of(survey::IndexPoint{static_cast<double>(x) + i, static_cast<double>(y) + j,
                                               static_cast<double>(z) + k});
    };
    const Vec3 zero = at(0, 0, 0);
    requests.push_back({.isosurface = look.id,
                        .volume = look.volume,
                        .name = volume->name,
                        .path = workbench.document.project().volume_path(*volume),
                        .checksum = volume->checksum,
                        .place = {zero, {at(1, 0, 0) - zero, at(0, 1, 0) - zero, at(0, 0, 1) - zero}},
                        .value = look.value});
  }
  const auto is_wanted = [&](Id id) {
    return std::ranges::find(requests, id, &IsosurfaceRequest::isosurface) != requests.end();
  };
  std::erase_if(shapes, [&](const auto& entry) { return !is_wanted(entry.first); });
  drawing.isosurfaces_changed();
  if (maker == nullptr && requests.empty()) return;
  if (maker == nullptr) {
    // Each on the maker's thread; the view's thread takes it if there is still a view.
    const auto in_window = [this](auto what) {
      QMetaObject::invokeMethod(&view, what, Qt::QueuedConnection);
    };
    IsosurfaceMaker::Events events;
    events.made = [this, in_window](std::shared_ptr<const IsosurfaceShape> shape) {
      in_window([this, shape = std::move(shape)] { shape_came(shape); });
    };
    events.progress = [this, in_window](double fraction) {
      in_window([this, fraction] { show_shape_share(fraction); });
    };
    events.failed = [this, in_window](const IsosurfaceRequest& request, const std::string& message,
                                      const std::string& hint) {
      in_window([this, id = request.isosurface, value = request.value,
                 message = QString::fromStdString(message),
                 hint = QString::fromStdString(hint)] { shape_failed(id, value, message, hint); });
    };
    maker = std::make_unique<IsosurfaceMaker>(std::move(events));
  }
  shapes_awaited = maker->want(std::move(requests));
  show_shape_share(0);
  changed();
}

void SceneView::Private::show_shape_share(double fraction) {
  const double share = shapes_awaited.empty() ? 1 : std::min(fraction, 0.99);
  if (std::exchange(drawing.shape_share, share) == share) return;
  drawing.flat_changed();
  view.update();
}

void SceneView::Private::shape_came(const std::shared_ptr<const IsosurfaceShape>& shape) {
  const auto& all = workbench.display.isosurfaces();
  const auto look = std::ranges::find(all, shape->isosurface, &IsosurfaceLook::id);
  if (look == all.end() || look->as_picture) return;
  if (look->value == shape->value) shapes_awaited.erase(shape->isosurface);
  show_shape_share(0);
  shapes[shape->isosurface] = shape;
  drawing.put_shape(shape);
  changed();
}

void SceneView::Private::shape_failed(Id isosurface, double value, const QString& message,
                                      const QString& hint) {
  const auto& all = workbench.display.isosurfaces();
  const auto look = std::ranges::find(all, isosurface, &IsosurfaceLook::id);
  if (look == all.end() || look->value != value || look->as_picture) return;  // overtaken
  shapes_awaited.erase(isosurface);
  // Triangles of another value would be taken for those of this one.
  shapes.erase(isosurface);
  drawing.drop_shape(isosurface);
  show_shape_share(0);
  changed();
  Q_EMIT workbench.document.failed(message, hint);
}

// To a graphics context that has just been made.
void SceneView::Private::give_what_is_there() {
  for (const Id fault : drawing.shown_faults()) {
    if (const auto bricks = voxels.bricks(fault)) drawing.put_voxels(fault, bricks);
  }
  for (const auto& [id, shape] : shapes) drawing.put_shape(shape);
}

void SceneView::Private::ask_for_picture() {
  const auto& frame = drawing.frame();
  if (!frame || view.size().isEmpty()) return;
  const render::Camera camera = drawing.seen();
  PictureRequest request;
  request.view_projection = camera.view_projection;
  const auto three = [](const Vec3& v) { return std::array{v.x, v.y, v.z}; };
  request.eye = three(camera.eye);
  request.right = three(camera.right);
  request.up = three(camera.up);
  request.forward = three(camera.forward);
  request.perspective = camera.perspective;
  request.width = static_cast<int>(std::lround(size().width() * view.devicePixelRatioF()));
  request.height = static_cast<int>(std::lround(size().height() * view.devicePixelRatioF()));
  for (const IsosurfaceLook& look : workbench.display.isosurfaces()) {
    if (!look.visible || !look.as_picture) continue;
    const auto& volumes = workbench.document.volumes();
    const auto volume = std::ranges::find(volumes, look.volume, &project::VolumeRecord::id);
    if (volume == volumes.end()) continue;
    PictureRequest::Isosurface one;
    one.volume = look.volume;
    one.value = static_cast<float>(look.value);
    one.colour = QColor(look.colour).rgba();
    const auto [i, j, k] = volume->origin;
    const survey::IndexPoint first{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
    const Vec3 zero = frame->scene_of(first);
    const std::array<Vec3, 3> columns{
        frame->scene_of(survey::IndexPoint{first.i + 1, first.j, first.k}) - zero,
        frame->scene_of(survey::IndexPoint{first.i, first.j + 1, first.k}) - zero,
        frame->scene_of(survey::IndexPoint{first.i, first.j, first.k + 1}) - zero};
    for (std::size_t n = 0; n < 3; ++n) {
      one.linear[n] = columns[n].x;
      one.linear[3 + n] = columns[n].y;
      one.linear[6 + n] = columns[n].z;
    }
    one.shift = three(zero);
    request.isosurfaces.push_back(one);
  }
  pictures_asked.clear();
  last_picture = 0;
  if (request.isosurfaces.empty()) {
    drawing.picture_share = 1;
    drawing.clear_picture();
    changed();
    return;
  }
  last_picture = drawing.source.draw(request);
  if (last_picture == 0) {  // no engine: nothing will come, and what is there is of another camera or value
    drawing.clear_picture();
    stop_waiting();
    return;
  }
  pictures_asked[last_picture] = request.view_projection;
  passes = 0;
  // Where there is no engine it comes when one is started: until then nothing is awaited, and what is there
  // is of another camera or value.
  const bool awaited = !drawing.source.is_drawing || drawing.source.is_drawing();
  drawing.picture_share = awaited ? 0 : 1;
  if (!awaited) drawing.clear_picture();
  drawing.loose_changed();
  changed();
}

// No picture will come for what was asked last.
void SceneView::Private::stop_waiting() {
  pictures_asked.clear();
  last_picture = 0;
  if (std::exchange(drawing.picture_share, 1) == 1) return;
  drawing.loose_changed();
  changed();
}

void SceneView::Private::picture_came(const std::shared_ptr<const Picture>& picture) {
  const auto asked_for = picture ? pictures_asked.find(picture->request) : pictures_asked.end();
  if (asked_for == pictures_asked.end()) return;  // an older camera's
  ++passes;
  drawing.picture_share = picture->last ? 1 : 1 - std::pow(0.6, passes);
  drawing.put_picture(picture, asked_for->second);
  changed();
}

}  // namespace footwall::ui
