// Statistics of a fault's faces through changes of its surface: faces keep their names (panel, number), so
// what is known of a face stays known until it moves, and is marked stale then until it is computed again.
// Each statistic by itself: offsets come later than the others.
#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "ui/model/surfaces.h"

namespace footwall::ui {

class FaceValues {
 public:
  // The surface that the values are of from now on.
  void set_surface(std::shared_ptr<const FaultSurface> surface);
  // Values of a face by its name, good for the face as it stands where `corners` are its own, or given none.
  // Names that the surface does not have are passed over.
  void set(Id panel, std::int32_t number, const survey::LatticeTriangle* corners, const std::string& statistic,
           double value);
  // What follows from the face's place alone, by its number in the surface; never stale.
  void set_geometry(std::size_t face, const std::string& statistic, double value);
  bool is_geometry(const std::string& statistic) const { return geometry_.contains(statistic); }
  // product = factor * other, face by face.
  void scale(const std::string& product, const std::string& factor, const std::string& other);
  // Of an answer that was computed before the surface was last set: faces that moved since are stale after all.
  void mark_stale_since_sent(const std::string& statistic);
  // What is not of the faces' places alone was computed from another volume, or along another normal.
  void mark_stale(const std::string& statistic);
  void mark_all_stale();
  bool is_known(const std::string& statistic) const { return values_.contains(statistic); }
  // Whether a face has no value of it, or one of before it moved.
  bool any_stale(const std::string& statistic) const;
  const std::map<std::string, std::vector<double>>& values() const { return values_; }
  std::shared_ptr<const FaceNumbers> numbers(const std::string& statistic) const;

 private:
  std::size_t place_of(Id panel, std::int32_t number) const;  // size of moved_ where there is none
  std::vector<double>& column(const std::string& statistic);

  std::shared_ptr<const FaultSurface> surface_;
  std::map<std::pair<Id, std::int32_t>, std::size_t> places_;
  std::map<std::string, std::vector<double>> values_;
  std::map<std::string, std::vector<std::uint8_t>> stale_;  // of the same statistics
  std::vector<std::uint8_t> moved_;  // by the last set_surface()
  std::set<std::string> geometry_;
};

}  // namespace footwall::ui
