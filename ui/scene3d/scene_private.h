// What a SceneView keeps: what is drawn (scene_drawing.h) and what the mouse is doing.
#pragma once
#include <QElapsedTimer>
#include <QPolygonF>
#include <QTimer>

#include "ui/model/face_voxels.h"
#include "ui/scene3d/scene_drawing.h"

namespace footwall::ui {

struct SceneView::Private {
  Private(SceneView& owner, Workbench& workbench_)
      : view(owner), workbench(workbench_), voxels(workbench_.document), drawing(workbench_) {}

  enum class Mouse { kNone, kOrbit, kPan, kZoom, kPlane, kPicking, kPressed, kSelecting };

  SceneView& view;
  Workbench& workbench;
  FaceVoxels voxels;
  SceneDrawing drawing;
  Gl gl;
  QTimer work_timer;  // slices of work while there is any
  QTimer rest_timer;  // the camera stands still
  QTimer fine_timer;  // nothing has changed for a while
  QTimer soon_timer;  // a frame waits for what is about to come
  bool was_settled = true;
  bool fitted = false;
  bool placed = false;  // the camera, by a size or by words
  // The words that set the camera last, and where it stood then: angles round, words must not.
  QString camera_words;
  std::array<double, 9> numbers_of_words{};

  // One asker for each plane: the reader keeps the newest request of each.
  std::map<Id, std::unique_ptr<QObject>> askers;
  std::map<Id, std::pair<Id, Section>> asked;  // volume and section
  std::map<std::uint64_t, render::Matrix4> pictures_asked;
  std::uint64_t last_picture = 0;
  int passes = 0;

  // Triangles of isosurfaces that were made, for another graphics context.
  std::map<Id, std::shared_ptr<const IsosurfaceShape>> shapes;
  std::unique_ptr<IsosurfaceMaker> maker;  // made when first needed
  std::set<Id> shapes_awaited;

  Mouse mouse = Mouse::kNone;
  QPointF pressed_at, last_at;
  bool travelled = false;
  Id plane = 0;                  // being dragged
  std::int64_t plane_index = 0;  // when the drag began
  render::Vec3 plane_grip, plane_step;
  Qt::MouseButton pressed_button = Qt::NoButton;
  bool lasso = false;  // else a box
  bool space_held = false;
  // On which picking took the press: what the hand does stays on it, whatever comes between.
  std::optional<Section> pressed_on;
  QPolygonF selecting;  // box or lasso under way, in pixels

  void connect_models();
  void take_style();
  void survey_changed();
  void show_place(const survey::IndexPoint& place, double reach);
  void sections_changed();
  void ask_for_samples();
  void ask_for_picture();
  void ask_for_voxels();
  void ask_for_shapes();
  void shape_came(const std::shared_ptr<const IsosurfaceShape>& shape);
  void shape_failed(Id isosurface, double value, const QString& message, const QString& hint);
  void show_shape_share(double fraction);
  void give_what_is_there();
  std::array<double, 9> camera_numbers() const;
  void stop_waiting();
  void picture_came(const std::shared_ptr<const Picture>& picture);
  void camera_moved();
  void changed();  // something is to be drawn
  // The same, but what follows within a moment is drawn in the same frame: on a processor that draws each
  // frame costs as much as all the rest of a drag.
  void changed_soon();
  void do_work();
  QSizeF size() const { return QSizeF(view.size()); }

  // Pointing.
  bool may_be_near(Id fault, const QPointF& pixel, const render::Camera& camera) const;
  // A node, or a pillar by one of its segments.
  struct Mark {
    Item item;
    int segment = -1;
    std::vector<survey::IndexPoint> nodes;  // the one, or the segment's two
  };
  std::optional<Mark> mark_at(const QPointF& pixel, double nearest) const;
  void put_on_its_section(const Mark& mark, const QPointF& pixel, Under* under) const;
  std::optional<PlaneHit> hit_on(const Section& section, const QPointF& pixel) const;
  Id frame_at(const QPointF& pixel) const;
  Pointer pointer_of(const Under& under, const QPointF& pixel, Qt::MouseButton button,
                     Qt::KeyboardModifiers modifiers, ulong time) const;
  void hover(const QPointF& pixel, const QMouseEvent& event);
  void begin_plane_drag(Id plane, const QPointF& pixel);
  void drag_plane(const QPointF& pixel);
  void put_plane_back();
  double along_step(const QPointF& pixel) const;
  // factor: of the distance; what is under the pixel stays there.
  void zoom_at(const QPointF& pixel, double factor);
  void show_pointer();

  // Selecting by box and lasso.
  void extend_selecting(const QPointF& at);
  void stop_selecting();
  void select_within(const QPolygonF& region, bool extend);
  // The nearest opaque thing along the view's axis under a pixel; infinite where there is none.
  double depth_at(const QPointF& pixel, const render::Camera& camera) const;
};

}  // namespace footwall::ui
