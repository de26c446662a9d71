#include "ui/model/face_values.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace footwall::ui {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint64_t kNotTold = std::numeric_limits<std::uint64_t>::max();
constexpr double kFewestSamples = 30;  // below, a face is left out of rankings

// Offsets are computed apart from the rest, when a gesture is over.
enum Family : std::size_t { kWithMoves, kLate };

Family family_of(const std::string& statistic) {
  return statistic.starts_with("offset") ? kLate : kWithMoves;
}

}  // namespace

void FaceValues::set_surface(std::shared_ptr<const FaultSurface> surface) {
  const std::shared_ptr<const FaultSurface> before = std::exchange(surface_, std::move(surface));
  const auto former_places = std::exchange(places_, {});
  const auto former_values = std::exchange(values_, {});
  const auto former_computed = std::exchange(computed_at_, {});
  const auto former_moved = std::exchange(moved_under_, {});
  if (surface_ == nullptr) return;
  const std::size_t count = surface_->faces.size();
  for (auto& places : computed_at_) places.assign(count, std::nullopt);
  moved_under_.assign(count, kNotTold);
  std::vector<std::size_t> from(count, former_moved.size());
  for (std::size_t f = 0; f < count; ++f) {
    const std::pair<Id, std::int32_t> name{surface_->faces[f].panel, surface_->faces[f].n};
    places_.emplace_hint(places_.end(), name, f);
    const auto found = former_places.find(name);
    if (found == former_places.end()) continue;
    from[f] = found->second;
    for (const Family family : {kWithMoves, kLate})
      computed_at_[family][f] = former_computed[family][found->second];
    if (before->lattice[found->second] == surface_->lattice[f]) moved_under_[f] = former_moved[found->second];
  }
  for (const auto& [statistic, old] : former_values) {
    std::vector<double>& now = values_[statistic];
    now.assign(count, kUnknown);
    for (std::size_t f = 0; f < count; ++f) {
      if (from[f] < old.size()) now[f] = old[from[f]];
    }
  }
}

std::size_t FaceValues::place_of(Id panel, std::int32_t number) const {
  const auto found = places_.find({panel, number});
  return found == places_.end() ? moved_under_.size() : found->second;
}

std::vector<double>& FaceValues::column(const std::string& statistic) {
  std::vector<double>& values = values_[statistic];
  values.resize(moved_under_.size(), kUnknown);
  return values;
}

void FaceValues::set(Id panel, std::int32_t number, const survey::LatticeTriangle& corners,
                     const std::string& statistic, double value) {
  const std::size_t place = place_of(panel, number);
  if (place == moved_under_.size()) return;
  column(statistic)[place] = value;
  computed_at_[family_of(statistic)][place] = corners;
}

void FaceValues::take(const std::vector<Id>& panels, const std::vector<std::int32_t>& numbers,
                      const std::map<std::string, std::vector<double>>& statistics,
                      const std::vector<std::size_t>& rows, std::uint64_t edit) {
  std::set<Family> families;
  for (const auto& [statistic, values] : statistics) families.insert(family_of(statistic));
  std::vector<std::pair<std::size_t, std::size_t>> placed;  // row, place
  placed.reserve(rows.size());
  for (const std::size_t row : rows) {
    const std::size_t place = place_of(panels[row], numbers[row]);
    if (place == moved_under_.size()) continue;
    placed.emplace_back(row, place);
    for (const Family family : families) {
      computed_at_[family][place] =
          moved_under_[place] <= edit ? std::optional(surface_->lattice[place]) : std::nullopt;
    }
  }
  if (placed.empty()) return;
  for (const auto& [statistic, values] : statistics) {
    std::vector<double>& into = column(statistic);
    for (const auto& [row, place] : placed) into[place] = values[row];
  }
}

void FaceValues::tell_moved(std::uint64_t edit) {
  std::ranges::replace(moved_under_, kNotTold, edit);
}

void FaceValues::set_geometry(const std::string& statistic, std::vector<double> values) {
  geometry_.insert(statistic);
  values_[statistic] = std::move(values);
}

void FaceValues::scale(const std::string& product, const std::string& factor, const std::string& other) {
  const auto a = values_.find(factor);
  const auto b = values_.find(other);
  if (a == values_.end() || b == values_.end()) return;
  std::vector<double>& into = column(product);
  for (std::size_t f = 0; f < into.size(); ++f) into[f] = a->second[f] * b->second[f];
}

void FaceValues::mark_stale(const std::string& statistic) {
  std::ranges::fill(computed_at_[family_of(statistic)], std::nullopt);
}

void FaceValues::mark_all_stale() {
  for (auto& places : computed_at_) std::ranges::fill(places, std::nullopt);
}

bool FaceValues::is_stale(const std::string& statistic, std::size_t face) const {
  return computed_at_[family_of(statistic)][face] != surface_->lattice[face];
}

bool FaceValues::any_stale(const std::string& statistic) const {
  if (is_geometry(statistic)) return false;
  for (std::size_t f = 0; f < moved_under_.size(); ++f) {
    if (is_stale(statistic, f)) return true;
  }
  return false;
}

std::shared_ptr<const FaceNumbers> FaceValues::numbers(const std::string& statistic) const {
  const auto found = values_.find(statistic);
  if (found == values_.end()) return nullptr;
  auto numbers = std::make_shared<FaceNumbers>();
  numbers->values = found->second;
  const std::size_t count = moved_under_.size();
  numbers->stale.assign(count, 0);
  if (!is_geometry(statistic)) {
    for (std::size_t f = 0; f < count; ++f) numbers->stale[f] = is_stale(statistic, f) ? 1 : 0;
  }
  numbers->hatched.assign(count, 0);
  if (const auto counts = values_.find("count"); counts != values_.end()) {
    for (std::size_t f = 0; f < count; ++f) numbers->hatched[f] = counts->second[f] < kFewestSamples ? 1 : 0;
  }
  return numbers;
}

}  // namespace footwall::ui
