// What is shown and how, as against what is true: kept with the project (setting "studio.display"), not under
// undo.
#pragma once
#include <QJsonObject>
#include <QObject>
#include <QString>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "ui/model/section.h"
#include "ui/model/selection.h"

namespace footwall::ui {

// How samples of a volume become colours.
struct SampleLook {
  QString colour_map = QStringLiteral("grey");
  double clip_percentile = 99;  // of |value|; of value for a volume without a sign
  double gain = 1;
  std::optional<bool> interpolate;  // unset: where a sample covers at most 6 pixels
  bool wiggle = false;
  friend bool operator==(const SampleLook&, const SampleLook&) = default;
};

enum class FaceColours { kStatistic, kVoxels, kPlain };

// How faces become colours.
struct FaceLook {
  FaceColours colours = FaceColours::kStatistic;
  QString statistic = QStringLiteral("variance");
  Id run = 0;                       // whose numbers are shown; 0: what is known now
  QString colour_map;               // empty: the statistic's own
  std::optional<double> low, high;  // unset: 2nd and 98th percentile over all faults shown
  bool edges = false;
  friend bool operator==(const FaceLook&, const FaceLook&) = default;
};

// An isosurface in the scene.
struct IsosurfaceLook {
  Id id = 0;
  Id volume = 0;
  double value = 0;
  QString colour = QStringLiteral("#c9a3e8");
  bool as_picture = true;  // by the engine, with its depths; else its triangles
  bool visible = true;
  QString name = {};  // empty: its volume and value
  friend bool operator==(const IsosurfaceLook&, const IsosurfaceLook&) = default;
};

class Display final : public QObject {
  Q_OBJECT

 public:
  explicit Display(Document& document, QObject* parent = nullptr);

  // The volume that sections show; 0 where the project has none.
  Id volume() const { return volume_; }
  void set_volume(Id volume);
  // How its samples become colours; each volume keeps its own.
  const SampleLook& samples() const { return samples_; }
  void set_samples(const SampleLook& look);
  const FaceLook& faces() const { return faces_; }
  void set_faces(const FaceLook& look);
  // Its numbers on the faces, which are coloured by a statistic then; 0: what is known now, as where that run
  // is deleted.
  void show_run(Id run);

  bool is_visible(const Item& item) const { return !hidden_.contains({item.kind, item.id}); }
  void set_visible(const Item& item, bool visible);

  const std::vector<IsosurfaceLook>& isosurfaces() const { return isosurfaces_; }
  Id add_isosurface(Id volume, double value);
  void change_isosurface(const IsosurfaceLook& look);  // by id
  void remove_isosurface(Id id);
  // One that was removed, as it was.
  void put_back_isosurface(const IsosurfaceLook& look);

  // The sections of the tiled views; each is also a plane of the scene where visible there.
  struct ShownSection {
    Id id = 0;
    Section section;
    bool in_scene = true;
    bool linked = true;  // shows the cursor of the others, and moves as they do
    friend bool operator==(const ShownSection&, const ShownSection&) = default;
  };
  const std::vector<ShownSection>& sections() const { return sections_; }
  Id add_section(const Section& section);
  void move_section(Id id, const Section& section);
  void change_section(const ShownSection& section);  // by id
  void remove_section(Id id);

  // What a linked section shows after it was panned, zoomed, stretched or fitted, for the other linked ones.
  struct LinkedView {
    Id by = 0;
    Section::Kind kind = Section::Kind::kInline;
    bool fits = false;  // the whole plane; the numbers below are unused then
    bool true_proportions = false;
    PlanePoint centre;
    double height = 1;  // voxels from top to bottom
    double stretch = 1;
  };
  void show_linked(const LinkedView& view) { Q_EMIT linked_view_moved(view); }

  // Lines that X and Z move by as the user set it; unset: by the tool (Picking::step_lines()).
  const std::optional<int>& own_step() const { return own_step_; }
  void set_own_step(std::optional<int> lines);
  bool steps_after_pillar() const {
    return steps_after_pillar_;
  }  // a section moves on where a pillar was ended on it
  void set_steps_after_pillar(bool on);
  bool snaps_to_section() const {
    return snaps_to_section_;
  }  // a moved node lies exactly on the section's plane
  bool snaps_to_samples() const { return snaps_to_samples_; }  // nodes lie on samples
  void set_snapping(bool to_section, bool to_samples);
  double fade_distance() const {
    return fade_distance_;
  }  // voxels up to which pillars off the section are drawn
  void set_fade_distance(double voxels);
  double exaggeration() const { return exaggeration_; }  // of heights in the scene, > 0
  void set_exaggeration(double factor);
  bool perspective() const { return perspective_; }
  void set_perspective(bool on);

  // Where the mouse points, shared by all views; nothing where it points at no place.
  const std::optional<survey::IndexPoint>& cursor() const { return cursor_; }
  void set_cursor(const std::optional<survey::IndexPoint>& place);
  // The cursor to a place, in the middle of every view that follows, with so many voxels around it.
  void show_place(const survey::IndexPoint& place, double reach);

  QJsonObject to_json() const;
  // Takes what it understands; the rest keeps its default.
  void from_json(const QJsonObject& json);

 Q_SIGNALS:
  void samples_changed();  // volume or look
  void faces_changed();
  void visibility_changed();
  void isosurfaces_changed();
  void sections_changed();
  void cursor_moved();
  // Views that follow move there, and show so many voxels around it.
  void place_shown(const footwall::survey::IndexPoint& place, double reach);
  void linked_view_moved(const footwall::ui::Display::LinkedView& view);
  void scene_changed();  // exaggeration, perspective, fade distance, step, snapping
  void changed();        // anything that to_json() holds

 private:
  bool has_run(Id run) const;
  SampleLook first_look(Id volume) const;
  void take_volume(Id volume);

  Document& document_;
  Id volume_ = 0;
  SampleLook samples_;              // of volume_
  std::map<Id, SampleLook> looks_;  // of those shown before
  FaceLook faces_;
  std::set<std::pair<Item::Kind, Id>> hidden_;
  std::vector<IsosurfaceLook> isosurfaces_;
  std::vector<ShownSection> sections_;
  Id last_id_ = 0;
  std::optional<int> own_step_;
  bool steps_after_pillar_ = false;
  bool snaps_to_section_ = true;
  bool snaps_to_samples_ = false;
  double fade_distance_ = 15;
  double exaggeration_ = 1;
  bool perspective_ = true;
  std::optional<survey::IndexPoint> cursor_;
};

}  // namespace footwall::ui
