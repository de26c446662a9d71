// Statistics of a fault's faces through changes of its surface: faces keep their names (panel, number), so
// what is known of a face stays known until it moves, and is marked stale then until it is computed again.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ui/model/surfaces.h"

namespace footwall::ui {

class FaceValues {
 public:
  // The surface that the values are of from now on.
  void set_surface(std::shared_ptr<const FaultSurface> surface);
  // Values of faces by their names, one of each column a face, computed where their corners stood there.
  // Names that the surface does not have are passed over.
  void set(std::span<const Id> panels, std::span<const std::int32_t> numbers,
           std::span<const survey::LatticeTriangle> corners,
           const std::map<std::string, std::vector<double>>& columns);
  // Of many faces at once, as an engine answers: row r of all is of face (panels[r], numbers[r]), computed
  // where the face stood on that surface, which may be an older one. Takes the rows named.
  void take(const std::vector<Id>& panels, const std::vector<std::int32_t>& numbers,
            const std::map<std::string, std::vector<double>>& statistics,
            const std::vector<std::size_t>& rows, const FaultSurface& computed_on);
  // What follows from the faces' places alone (FaultSurface::geometry); never stale.
  bool is_geometry(const std::string& statistic) const {
    return surface_ != nullptr && surface_->geometry.contains(statistic);
  }
  // product = factor * other, face by face.
  void scale(const std::string& product, const std::string& factor, const std::string& other);
  // What is computed together with the statistic is of another volume, or along another normal: stale on all
  // faces.
  void mark_stale(const std::string& statistic);
  void mark_all_stale();
  bool is_known(const std::string& statistic) const { return find(statistic) != nullptr; }
  // Whether a face has no value of it, or that of another place than it has now.
  bool any_stale(const std::string& statistic) const;
  // One value a face; null where nothing is known of the statistic.
  const std::vector<double>* find(const std::string& statistic) const;
  std::shared_ptr<const FaceNumbers> numbers(const std::string& statistic) const;

 private:
  // One entry a face: 1 where its value is that of another place than it has now, or it has none.
  std::vector<std::uint8_t> stale_faces(const std::string& statistic) const;
  std::vector<double>& column(const std::string& statistic);

  std::shared_ptr<const FaultSurface> surface_;
  std::map<std::string, std::vector<double>> values_;
  // Where each face stood when its values were computed, those that come with every move and those that come
  // late; nothing where that is not known.
  std::array<std::vector<std::optional<survey::LatticeTriangle>>, 2> computed_at_;
};

}  // namespace footwall::ui
