#include "ui/model/face_values.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace footwall::ui {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kFewestSamples = 30;  // below, a face is left out of rankings

}  // namespace

void FaceValues::set_surface(std::shared_ptr<const FaultSurface> surface) {
  const std::shared_ptr<const FaultSurface> before = std::exchange(surface_, std::move(surface));
  const auto former_places = std::exchange(places_, {});
  const auto former_values = std::exchange(values_, {});
  const auto former_stale = std::exchange(stale_, {});
  if (surface_ == nullptr) return;
  const std::size_t count = surface_->faces.size();
  stale_.assign(count, 1);
  moved_.assign(count, 1);
  std::vector<std::size_t> from(count, former_stale.size());
  for (std::size_t f = 0; f < count; ++f) {
    const std::pair<Id, std::int32_t> name{surface_->faces[f].panel, surface_->faces[f].n};
    places_.emplace_hint(places_.end(), name, f);
    const auto found = former_places.find(name);
    if (found == former_places.end()) continue;
    from[f] = found->second;
    const bool stands = before->lattice[found->second] == surface_->lattice[f];
    stale_[f] = stands ? former_stale[found->second] : std::uint8_t{1};
    moved_[f] = stands ? 0 : 1;
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
  return found == places_.end() ? stale_.size() : found->second;
}

std::vector<double>& FaceValues::column(const std::string& statistic) {
  std::vector<double>& values = values_[statistic];
  values.resize(stale_.size(), kUnknown);
  return values;
}

void FaceValues::set(Id panel, std::int32_t number, const survey::LatticeTriangle* corners,
                     const std::string& statistic, double value) {
  const std::size_t place = place_of(panel, number);
  if (place == stale_.size()) return;
  column(statistic)[place] = value;
  stale_[place] = corners != nullptr && *corners != surface_->lattice[place] ? 1 : 0;
}

void FaceValues::set_geometry(std::size_t face, const std::string& statistic, double value) {
  geometry_.insert(statistic);
  column(statistic)[face] = value;
}

void FaceValues::scale(const std::string& product, const std::string& factor, const std::string& other) {
  const auto a = values_.find(factor);
  const auto b = values_.find(other);
  if (a == values_.end() || b == values_.end()) return;
  std::vector<double>& into = column(product);
  for (std::size_t f = 0; f < into.size(); ++f) into[f] = a->second[f] * b->second[f];
}

void FaceValues::mark_stale_since_sent() {
  for (std::size_t f = 0; f < stale_.size(); ++f) stale_[f] |= moved_[f];
}

bool FaceValues::any_stale() const {
  return std::ranges::any_of(stale_, [](std::uint8_t stale) { return stale != 0; });
}

std::shared_ptr<const FaceNumbers> FaceValues::numbers(const std::string& statistic) const {
  const auto found = values_.find(statistic);
  if (found == values_.end()) return nullptr;
  auto numbers = std::make_shared<FaceNumbers>();
  numbers->values = found->second;
  numbers->stale = stale_;
  if (is_geometry(statistic)) numbers->stale.assign(stale_.size(), 0);
  numbers->hatched.assign(stale_.size(), 0);
  if (const auto counts = values_.find("count"); counts != values_.end()) {
    for (std::size_t f = 0; f < stale_.size(); ++f) {
      numbers->hatched[f] = counts->second[f] < kFewestSamples ? 1 : 0;
    }
  }
  return numbers;
}

}  // namespace footwall::ui
