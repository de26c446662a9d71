// The 3D scene: survey box, section planes, pillars, faults in their colours, isosurfaces. Scene frame:
// metres east, north, up from the survey's centre (engine/render/scene_frame.h), a time survey with the
// project's "velocity".
//
// All that stands still is kept as a picture with depths, made in slices of bounded work; a mouse move draws
// that picture, the fault being edited and the plane being moved, or, while the camera moves, a coarse scene
// of a bounded number of triangles.
#pragma once
#include <functional>
#include <memory>

#include "ui/model/workbench.h"
#include "ui/scene3d/gl_widget.h"
#include "ui/scene3d/orbit_camera.h"

namespace footwall::ui {

// Where surfaces, samples and pictures come from; by default the workbench's models.
struct SceneSource {
  std::function<std::shared_ptr<const FaultSurface>(Id)> surface;
  std::function<std::shared_ptr<const FaceNumbers>(Id, const QString&)> numbers;
  std::function<Freshness(Id, const QString&)> freshness;
  std::function<std::optional<std::pair<double, double>>(const std::set<Id>&, const QString&)> range;
  std::function<std::vector<project::StatisticRecord>()> statistics;
  std::function<std::uint64_t(const PictureRequest&)> draw;
  std::function<void(QObject* asker, Id volume, const Section&)> ask;  // as SectionReader::ask
  // Whether what draw() was asked for is under way, not put off until an engine is started. Empty: it is.
  std::function<bool()> is_drawing = {};
};

// Work done so far.
struct SceneCounters {
  std::uint64_t frames = 0;
  std::uint64_t coarse_frames = 0;    // of those, drawn with few triangles because the camera moved
  std::uint64_t layers = 0;           // pictures of all that stands still, finished
  std::uint64_t triangles = 0;        // of faults, everywhere
  std::uint64_t frame_triangles = 0;  // of the last frame alone
  std::uint64_t uploads = 0;          // of whole meshes to the graphics card
  double longest_slice_ms = 0;        // of work between events
};

class SceneView final : public GlWidget {
  Q_OBJECT

 public:
  explicit SceneView(Workbench& workbench, QWidget* parent = nullptr);
  ~SceneView() override;

  void fit();
  // The selection, or all where nothing is selected.
  void frame_selection();
  void look(StandardView view);
  const OrbitCamera& camera() const;
  // "x,y,z;x,y,z;x,y,z": eye, target and up in scene metres, as views keep it and `footwall render --camera`
  // takes it.
  QString camera_text() const;
  // Before the first size and without words it looks nowhere.
  bool has_camera() const;
  // False for other words.
  bool set_camera_text(const QString& text);

  // The scene with its colour bar in pixels of any size, drawn in tiles; scale: of lines and letters, 1 as on
  // the screen. Null, and why, where it cannot be drawn.
  QImage picture(const QSize& size, double scale, QString* problem);
  bool export_png(const QString& path, const QSize& size, double scale, QString* problem);

  // What lies under a pixel of the view, and where.
  struct Under {
    Item item;         // node, pillar, face or section; nothing
    int segment = -1;  // of a pillar: its first node's number
    // The nearest thing hit is a section plane, `plane` of the display; or the node or pillar lies on it.
    bool on_plane = false;
    bool on_frame = false;  // a plane's frame, by which it is dragged
    Id plane = 0;
    survey::IndexPoint place;  // of what was hit, where something was
    bool hit = false;
  };
  Under under(const QPointF& pixel) const;
  // Of a place in index space; nothing where it is behind the eye.
  std::optional<QPointF> pixel_of(const survey::IndexPoint& place) const;

  const SceneCounters& counters() const;
  void reset_counters();
  // Nothing is left to upload or to draw finer.
  bool is_settled() const;
  void set_source(SceneSource source);

 Q_SIGNALS:
  void camera_changed();
  void settled();

 protected:
  QString start_gl() override;
  void paint_gl(GLuint framebuffer) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void keyReleaseEvent(QKeyEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;
  bool event(QEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  struct Private;
  // Scene metres, clamped to the survey's voxels.
  survey::IndexPoint index_at(const render::Vec3& scene) const;

  std::unique_ptr<Private> d_;
};

}  // namespace footwall::ui
