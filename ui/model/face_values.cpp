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
  moved_.clear();
  if (surface_ == nullptr) return;
  const std::size_t count = surface_->faces.size();
  const std::size_t nowhere = before == nullptr ? 0 : before->faces.size();
  moved_.assign(count, 1);
  std::vector<std::size_t> from(count, nowhere);
  for (std::size_t f = 0; f < count; ++f) {
    const std::pair<Id, std::int32_t> name{surface_->faces[f].panel, surface_->faces[f].n};
    places_.emplace_hint(places_.end(), name, f);
    const auto found = former_places.find(name);
    if (found == former_places.end()) continue;
    from[f] = found->second;
    moved_[f] = before->lattice[found->second] == surface_->lattice[f] ? 0 : 1;
  }
  for (const auto& [statistic, old] : former_values) {
    const std::vector<std::uint8_t>& old_stale = former_stale.at(statistic);
    std::vector<double>& now = column(statistic);
    std::vector<std::uint8_t>& stale = stale_[statistic];
    for (std::size_t f = 0; f < count; ++f) {
      if (from[f] >= old.size()) continue;
      now[f] = old[from[f]];
      stale[f] = moved_[f] != 0 ? std::uint8_t{1} : old_stale[from[f]];
    }
  }
}

std::size_t FaceValues::place_of(Id panel, std::int32_t number) const {
  const auto found = places_.find({panel, number});
  return found == places_.end() ? moved_.size() : found->second;
}

std::vector<double>& FaceValues::column(const std::string& statistic) {
  std::vector<double>& values = values_[statistic];
  if (values.size() != moved_.size()) {
    values.resize(moved_.size(), kUnknown);
    stale_[statistic].resize(moved_.size(), 1);
  }
  return values;
}

void FaceValues::set(Id panel, std::int32_t number, const survey::LatticeTriangle* corners,
                     const std::string& statistic, double value) {
  const std::size_t place = place_of(panel, number);
  if (place == moved_.size()) return;
  column(statistic)[place] = value;
  stale_[statistic][place] = corners != nullptr && *corners != surface_->lattice[place] ? 1 : 0;
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
  stale_[product] = stale_[is_geometry(factor) ? other : factor];
}

void FaceValues::mark_stale_since_sent(const std::string& statistic) {
  const auto found = stale_.find(statistic);
  if (found == stale_.end()) return;
  for (std::size_t f = 0; f < moved_.size(); ++f) found->second[f] |= moved_[f];
}

void FaceValues::mark_stale(const std::string& statistic) {
  const auto found = stale_.find(statistic);
  if (found != stale_.end() && !is_geometry(statistic)) found->second.assign(moved_.size(), 1);
}

void FaceValues::mark_all_stale() {
  for (const auto& [statistic, values] : values_) mark_stale(statistic);
}

bool FaceValues::any_stale(const std::string& statistic) const {
  const auto found = stale_.find(statistic);
  if (found == stale_.end() || is_geometry(statistic)) return false;
  return std::ranges::any_of(found->second, [](std::uint8_t stale) { return stale != 0; });
}

std::shared_ptr<const FaceNumbers> FaceValues::numbers(const std::string& statistic) const {
  const auto found = values_.find(statistic);
  if (found == values_.end()) return nullptr;
  auto numbers = std::make_shared<FaceNumbers>();
  numbers->values = found->second;
  numbers->stale = stale_.at(statistic);
  if (is_geometry(statistic)) numbers->stale.assign(moved_.size(), 0);
  numbers->hatched.assign(moved_.size(), 0);
  if (const auto counts = values_.find("count"); counts != values_.end()) {
    for (std::size_t f = 0; f < moved_.size(); ++f) {
      numbers->hatched[f] = counts->second[f] < kFewestSamples ? 1 : 0;
    }
  }
  return numbers;
}

}  // namespace footwall::ui
