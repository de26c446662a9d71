// Faults as one section sees them: pillars projected to its plane, the cut of each mesh with it. Made when
// first needed, kept until they change.
#pragma once
#include <QColor>
#include <QPainter>
#include <map>
#include <set>
#include <vector>

#include "ui/model/workbench.h"
#include "ui/section/mesh_cut.h"
#include "ui/section/view_transform.h"

namespace footwall::ui {

// A node whose distance is at most half a voxel lies on the section.
inline constexpr double kOnSection = 0.5;

struct ShapedNode {
  Id id = 0;
  PlanePoint at;
  double distance = 0;  // voxels from the plane, signed
  bool on_section() const { return distance >= -kOnSection && distance <= kOnSection; }
};
struct ShapedPillar {
  Id id = 0;
  survey::PillarKind kind = survey::PillarKind::kInterpreted;
  std::vector<ShapedNode> nodes;
};
struct ShapedFault {
  std::vector<ShapedPillar> pillars;
  std::shared_ptr<const FaultSurface> surface;  // that the cut is of
  std::vector<CutSegment> cut;                  // for the mouse
  std::vector<CutLine> lines;                   // the same, for the eye
};

class FaultShapes {
 public:
  explicit FaultShapes(Workbench& bench) : bench_(bench) {}
  void set_section(const Section& section);
  void forget(const std::set<Id>& faults);
  const ShapedFault& of(Id fault);
  // Whether the fault has got another surface than the one that of() gave last.
  bool has_other_surface(Id fault) const;

  // What lies under the mouse within reach, nodes before pillars before the faces cut; of faults that are
  // shown.
  struct Hit {
    Item item;
    int segment = -1;  // of a pillar
  };
  Hit hit(const QPointF& mouse, const ViewTransform& view);

 private:
  Workbench& bench_;
  Section section_;
  std::map<Id, ShapedFault> shapes_;
};

// How a fault is drawn: with its cut, its pillars on and near the section, and its nodes on it.
struct FaultDrawing {
  QColor colour;
  QColor accent;   // of what is selected
  QColor outline;  // around nodes
  QColor active;   // of the active fault's pillars
  bool is_active = false;
  bool shows_pillars = true;
  double fade_distance = 5;  // voxels
  Item face;                 // the selected one, where it is of this fault
};
void draw_fault(QPainter& painter, const ShapedFault& fault, const ViewTransform& view,
                const FaultDrawing& how, const std::set<Id>& selected_pillars,
                const std::set<Id>& selected_nodes);
// Drawn again over it, larger and brighter: what lies under the mouse.
void draw_hovered(QPainter& painter, const ShapedFault& fault, const Item& item, const ViewTransform& view,
                  const FaultDrawing& how);

}  // namespace footwall::ui
