// What the scene has on the graphics card, and how its layers are drawn. Every call that draws needs the
// context current.
#pragma once
#include <QFont>
#include <QPolygonF>
#include <optional>
#include <set>

#include "ui/model/sample_colours.h"
#include "ui/scene3d/fault_meshes.h"
#include "ui/scene3d/isosurface_meshes.h"
#include "ui/scene3d/isosurface_picture.h"
#include "ui/scene3d/marks.h"
#include "ui/scene3d/panels.h"
#include "ui/scene3d/scene_view.h"
#include "ui/scene3d/section_planes.h"
#include "ui/scene3d/survey_box.h"

namespace footwall::ui {

// What has to be drawn again.
struct DrawingMarks {
  std::vector<Line> lines;
  std::vector<Dot> dots;
};

class SceneDrawing {
 public:
  explicit SceneDrawing(Workbench& workbench);

  // Throws Error.
  void build(Gl& gl);
  void release();
  bool is_built() const { return gl_ != nullptr; }
  bool has_budget_left() const { return work_ < kWorkPerSlice; }

  // --- what is shown; these only note what changed ---
  SceneSource source;
  OrbitCamera camera;
  void set_style(const SceneColours& colours, const QFont& font, double pixel);
  void set_view(const QSizeF& view) { view_ = view; }
  void survey_changed();  // or the exaggeration
  void surfaces_changed(const std::set<Id>& faults);
  void numbers_changed(const std::set<Id>& faults);
  void pillars_changed(const std::set<Id>& faults);
  void selection_changed();
  void content_changed();  // of what stands still
  void loose_changed();    // of what may move, alone
  void camera_moved();
  void set_moving(bool moving);
  void want_fine();
  // Samples around a fault, for faces that show them; null: none.
  void put_voxels(Id fault, std::shared_ptr<const VoxelBricks> bricks);
  void put_samples(Id plane, std::shared_ptr<const SectionSamples> samples);
  void put_picture(std::shared_ptr<const Picture> picture, const render::Matrix4& view_projection);
  void clear_picture();
  // Triangles of an isosurface; those of the display that are shown as triangles are drawn.
  void put_shape(std::shared_ptr<const IsosurfaceShape> shape);
  void drop_shape(Id isosurface);
  void isosurfaces_changed();
  void flat_changed() { flat_old_ = true; }     // what lies flat on the scene
  void set_selecting(const QPolygonF& region);  // the box or lasso under the mouse, in pixels; may be empty
  void set_loose_plane(Id plane);
  void set_hot_plane(Id plane);  // whose frame is hovered or dragged
  bool has_mouse = false;        // the mouse is in this view
  double picture_share = 1;      // of a picture under way; 1: none is
  double shape_share = 1;        // of an isosurface's triangles under way; 1: none are
  bool voxels_are_there = true;  // no samples around faults are awaited
  // Of the volume that faces show, where the sections' reader has not opened it.
  const SectionReader::VolumeFacts* voxel_facts = nullptr;

  // --- drawing ---
  // A bounded part of what is to be done; true while something is left.
  bool work();
  bool has_work() const;
  bool has_front() const { return front_valid_; }
  bool is_fine() const { return fine_valid_; }
  // The picture of now into the framebuffer.
  void paint(GLuint framebuffer);
  // The whole scene as an image, in tiles.
  QImage picture(const QSize& size, double scale);

  // --- asked by the mouse ---
  const std::optional<render::SceneFrame>& frame() const { return frame_; }
  const std::optional<render::SceneFrame>& flat() const { return flat_; }  // at exaggeration 1
  const FaultGeometry* geometry(Id fault) const;
  std::set<Id> shown_faults() const;
  std::vector<IsosurfaceLook> shown_shapes() const;  // isosurfaces as triangles
  const IsosurfaceShape* shape(Id isosurface) const { return shapes_.shape(isosurface); }
  double heights() const { return heights_; }
  render::Vec3 flat_of(const survey::WorldPoint& p) const;  // scene metres at exaggeration 1
  render::Camera seen() const { return camera.camera(view_); }
  SceneCounters counters;

 private:
  struct Step {
    enum class Kind { kBackground, kFaces, kIsosurface, kPlane, kPicture, kMarks, kLabels };
    Kind kind = Kind::kBackground;
    Id id = 0;
    std::size_t first = 0, count = 0;
  };
  struct Layer {
    std::vector<Step> steps;
    std::size_t next = 0;
    std::set<Id> loose_faults;
    Id loose_plane = 0;
    bool under_way = false;
  };
  static constexpr std::size_t kWorkPerSlice = 15'000;         // triangles
  static constexpr std::size_t kQuickTriangles = 20'000;       // while the camera moves
  static constexpr std::size_t kQuickShapeTriangles = 12'000;  // of all isosurfaces, while the camera moves
  static constexpr std::size_t kLooseTriangles = 20'000;       // of one fault that is being edited
  static constexpr int kFineSamples = 4;
  static constexpr int kQuickPixels = 250'000;  // of a frame while the camera moves, without a graphics card
  static constexpr int kTile = 1024;

  Pass pass_now() const;
  std::set<Id> loose_faults() const;
  bool upload_one();
  void upload(Id fault, bool loose);
  void upload_numbers(Id fault);
  void refresh_range();
  void refresh_static_marks();
  void refresh_camera_marks(const Pass& pass, const QSizeF& view, TextImages& texts);
  void refresh_loose_marks();
  void refresh_flat(const QSizeF& view, TextImages& texts, double pixel, bool with_state);
  DrawingMarks pillar_marks(Id fault, bool loose) const;
  void add_frame_lines(std::vector<Line>& lines, Id plane) const;
  void add_fault_lines(std::vector<Line>& lines, Id fault) const;
  // The edges of a face that is shown.
  void add_face_lines(std::vector<Line>& lines, const Item& face, const QColor& colour, float width) const;
  void add_pillar_lines(std::vector<Line>& lines, const survey::Pillar& pillar, const QColor& colour,
                        float width) const;
  std::vector<Step> steps_of(const std::set<Id>& without_faults, Id without_plane) const;
  void start(Layer& layer, const std::set<Id>& without_faults, Id without_plane);
  bool go_on(Layer& layer, const Pass& pass);
  void draw_step(const Pass& pass, const Step& step);
  void draw_background(const Pass& pass);
  void draw_plane(const Pass& pass, Id plane);
  int quick_level() const;  // of coarse faces; -1: all
  void draw_quickly(const Pass& quick);
  void paint_small(GLuint framebuffer, const Pass& pass, int side);
  int pixels_at_once(const Pass& pass) const;
  std::array<float, 3> colour_of(Id isosurface) const;
  void draw_shapes_quickly(const Pass& pass);
  void draw_loose(const Pass& pass);
  void draw_over(const Pass& pass);
  void draw_hover(const Pass& pass);
  void draw_flat(const Pass& pass);  // colour bar, arrow, the region under the mouse
  void begin(GLuint target, const Pass& pass);
  void copy(const GlTarget& from, GLuint to, GLbitfield what);
  FaceColouring colouring_of(Id fault) const;
  SampleColours sample_colours() const;
  render::Matrix4 to_voxels() const;
  std::optional<ColourBar> voxel_bar() const;
  GLuint colours_named(const QString& name) const;
  QString missing_for(const QString& statistic) const;
  std::optional<ColourBar> colour_bar() const;
  std::size_t spend(std::size_t triangles);

  Workbench& workbench_;
  Gl* gl_ = nullptr;
  SceneColours colours_;
  QFont font_;
  double pixel_ = 1;
  QSizeF view_{1, 1};
  std::optional<render::SceneFrame> frame_;  // exaggerated
  std::optional<render::SceneFrame> flat_;
  double heights_ = 1;
  int frame_number_ = 0;  // another one means other positions
  std::map<Id, int> uploaded_in_;

  FaultMeshes meshes_;
  SectionPlanes planes_;
  Marks marks_;
  IsosurfacePicture picture_;
  IsosurfaceMeshes shapes_;
  GlProgram background_;
  GLuint background_layout_ = 0;
  mutable std::map<QString, GLuint> colour_tables_;
  MarkBatch<Line> box_, pillars_, loose_lines_, through_lines_, over_lines_, hover_lines_;
  MarkBatch<Dot> nodes_, loose_dots_, hover_dots_;
  SpriteBatch labels_, flat_sprites_, selecting_sprite_;
  TextImages texts_;

  std::set<Id> meshes_to_upload_, numbers_to_upload_;
  std::set<Id> standing_picks_;     // selected pillars of faults that are not loose
  std::optional<int> coarse_made_;  // the level that all standing faults have
  std::map<Id, std::shared_ptr<const SectionSamples>> samples_to_upload_;
  std::map<Id, std::shared_ptr<const VoxelBricks>> voxels_to_upload_;
  std::map<Id, std::shared_ptr<const IsosurfaceShape>> shapes_to_upload_;  // null: to go
  std::optional<std::pair<std::shared_ptr<const Picture>, render::Matrix4>> picture_to_upload_;
  bool static_marks_old_ = true, camera_marks_old_ = true, loose_marks_old_ = true, flat_old_ = true,
       selecting_old_ = false;
  QPolygonF selecting_;
  std::optional<std::pair<double, double>> range_;
  std::optional<ColourBar> bar_;
  bool range_old_ = true;  // range_ and bar_ are

  GlTarget frame_target_, quick_target_, front_target_, back_target_, fine_target_, fine_samples_,
      tile_target_, tile_samples_;
  Layer front_, back_, fine_;
  bool is_software_ = false;  // the processor draws
  bool front_valid_ = false, front_old_ = true, fine_valid_ = false, fine_wanted_ = false, moving_ = false;
  Id loose_plane_ = 0, hot_plane_ = 0;
  std::size_t work_ = 0;
};

}  // namespace footwall::ui
