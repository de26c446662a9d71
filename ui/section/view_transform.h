// Between a section's plane (u to the right, v down, both in voxels) and the pixels of a view, in world
// proportions.
#pragma once
#include <QPointF>
#include <QRectF>

#include "ui/model/section.h"

namespace footwall::ui {

// A plane in world units.
struct PlaneFrame {
  PlaneSize size;
  double metres_per_u = 1;
  double metres_per_v = 1;
  bool upward = false;   // v grows up the screen: a slice whose lines would show mirrored otherwise
  bool vertical = true;  // v is time or depth, and may be stretched to fill the view
};

// velocity: m/s for a time survey; 0: 1 ms is drawn as 1 m.
PlaneFrame frame_of(const Section& section, const survey::Geometry& survey, double velocity);

// What of a plane is shown, whatever the size of the view.
struct ShownPart {
  bool fits = true;  // all of it; the numbers below follow from the view then
  bool true_proportions = false;
  PlanePoint centre;
  double pixels_per_metre = 1;  // along u
  double stretch = 1;
};

class ViewTransform {
 public:
  // Keeps the place in the middle and the scale; before the first fit() shows nothing sensible.
  void set_frame(const PlaneFrame& frame);
  const PlaneFrame& frame() const { return frame_; }
  void set_area(const QRectF& area);
  const QRectF& area() const { return area_; }

  // The whole plane; a vertical one stretched by the round factor that fills the view best, or by 1.
  void fit(bool true_proportions = false);
  // Of the plane, with a margin; the stretch stays.
  void show(const PlanePoint& low, const PlanePoint& high);
  void zoom(const QPointF& at, double factor);     // the place under `at` stays
  void stretch(const QPointF& at, double factor);  // of v alone
  void pan(const QPointF& by);
  ShownPart part() const { return {fitted_, true_proportions_, centre_, scale_, stretch_}; }
  // False, and no change, for numbers that no view has.
  bool show_part(const ShownPart& part);
  // This centre, and `height` voxels from top to bottom.
  void show_around(const PlanePoint& centre, double height, double stretch);
  // The same of v alone: u keeps its place and its scale.
  void show_heights(double centre, double height);

  QPointF to_pixels(const PlanePoint& p) const;
  PlanePoint to_plane(const QPointF& p) const;
  double pixels_per_u() const { return scale_ * frame_.metres_per_u; }
  double pixels_per_v() const { return scale_ * stretch_ * frame_.metres_per_v; }  // > 0 also where upward
  double pixels_per_metre() const { return scale_; }                               // along u
  double stretch() const { return stretch_; }
  bool is_fitted() const { return fitted_; }

 private:
  void clamp();
  void clamp_centre();

  PlaneFrame frame_;
  QRectF area_{0, 0, 100, 100};
  PlanePoint centre_;
  double scale_ = 1;
  double stretch_ = 1;
  bool fitted_ = false;
  bool true_proportions_ = false;  // of the last fit()
};

}  // namespace footwall::ui
