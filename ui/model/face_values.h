// Statistics of a fault's faces through changes of its surface: faces keep their names (panel, number), so what is known
// of a face stays known until it moves, and is marked stale then until it is computed again.
#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ui/model/surfaces.h"

namespace footwall::ui {

class FaceValues {
 public:
  // The surface that the values are of from now on.
  void set_surface(std::shared_ptr<const FaultSurface> surface);
  // Values of faces by their names, one of each column a face; they are good for a face as it stands where its entry in
  // `corners` is its own, or where there are no corners. Names that the surface does not have are passed over.
  void set(std::span<const Id> panels, std::span<const std::int32_t> numbers,
           std::span<const survey::LatticeTriangle> corners,
           const std::map<std::string, std::span<const double>>& columns);
  // What follows from the faces' places alone (FaultSurface::geometry); never stale.
  bool is_geometry(const std::string& statistic) const {
    return surface_ != nullptr && surface_->geometry.contains(statistic);
  }
  // product = factor * other, face by face.
  void scale(const std::string& product, const std::string& factor, const std::string& other);
  // Of an answer that was computed before the surface was last set: faces that moved since are stale after all.
  void mark_stale_since_sent();
  // What is not of the faces' places alone was computed from another volume.
  void mark_all_stale() { stale_.assign(stale_.size(), 1); }
  bool is_known(const std::string& statistic) const { return find(statistic) != nullptr; }
  // Of faces with any value, whether one is stale; of all faces, whether one has none.
  bool any_stale() const;
  // One value a face; null where nothing is known of the statistic.
  const std::vector<double>* find(const std::string& statistic) const;
  std::shared_ptr<const FaceNumbers> numbers(const std::string& statistic) const;

 private:
  std::vector<double>& column(const std::string& statistic);

  std::shared_ptr<const FaultSurface> surface_;
  std::map<std::string, std::vector<double>> values_;
  std::vector<std::uint8_t> stale_;
  std::vector<std::uint8_t> moved_;  // by the last set_surface()
};

}  // namespace footwall::ui
