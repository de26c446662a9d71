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
  const auto former_values = std::exchange(values_, {});
  const auto former_stale = std::exchange(stale_, {});
  if (surface_ == nullptr) return;
  const std::size_t count = surface_->faces.size();
  stale_.assign(count, 1);
  moved_.assign(count, 1);
  if (before == nullptr) return;
  std::vector<std::size_t> from(count, former_stale.size());
  for (std::size_t f = 0; f < count; ++f) {
    const std::size_t place = before->place_of(surface_->faces[f].panel, surface_->faces[f].n, f);
    if (place == before->faces.size()) continue;
    from[f] = place;
    const bool stands = before->lattice[place] == surface_->lattice[f];
    stale_[f] = stands ? former_stale[place] : std::uint8_t{1};
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

const std::vector<double>* FaceValues::find(const std::string& statistic) const {
  if (surface_ == nullptr) return nullptr;
  if (const auto found = surface_->geometry.find(statistic); found != surface_->geometry.end()) return &found->second;
  const auto found = values_.find(statistic);
  return found == values_.end() ? nullptr : &found->second;
}

std::vector<double>& FaceValues::column(const std::string& statistic) {
  std::vector<double>& values = values_[statistic];
  values.resize(stale_.size(), kUnknown);
  return values;
}

void FaceValues::set(std::span<const Id> panels, std::span<const std::int32_t> numbers,
                     std::span<const survey::LatticeTriangle> corners,
                     const std::map<std::string, std::span<const double>>& columns) {
  if (surface_ == nullptr) return;
  std::vector<std::size_t> places(panels.size());
  std::size_t guess = 0;
  for (std::size_t n = 0; n < panels.size(); ++n) {
    const std::size_t place = places[n] = surface_->place_of(panels[n], numbers[n], guess);
    if (place == stale_.size()) continue;
    guess = place + 1;
    stale_[place] = !corners.empty() && corners[n] != surface_->lattice[place] ? 1 : 0;
  }
  for (const auto& [statistic, values] : columns) {
    if (is_geometry(statistic)) continue;
    std::vector<double>& into = column(statistic);
    for (std::size_t n = 0; n < places.size(); ++n) {
      if (places[n] < into.size()) into[places[n]] = values[n];
    }
  }
}

void FaceValues::scale(const std::string& product, const std::string& factor, const std::string& other) {
  const std::vector<double>* a = find(factor);
  const std::vector<double>* b = find(other);
  if (a == nullptr || b == nullptr) return;
  std::vector<double>& into = column(product);
  for (std::size_t f = 0; f < into.size(); ++f) into[f] = (*a)[f] * (*b)[f];
}

void FaceValues::mark_stale_since_sent() {
  for (std::size_t f = 0; f < stale_.size(); ++f) stale_[f] |= moved_[f];
}

bool FaceValues::any_stale() const {
  return std::ranges::any_of(stale_, [](std::uint8_t stale) { return stale != 0; });
}

std::shared_ptr<const FaceNumbers> FaceValues::numbers(const std::string& statistic) const {
  const std::vector<double>* values = find(statistic);
  if (values == nullptr) return nullptr;
  auto numbers = std::make_shared<FaceNumbers>();
  numbers->values = *values;
  numbers->stale = stale_;
  if (is_geometry(statistic)) numbers->stale.assign(stale_.size(), 0);
  numbers->hatched.assign(stale_.size(), 0);
  if (const std::vector<double>* counts = find("count")) {
    for (std::size_t f = 0; f < stale_.size(); ++f) numbers->hatched[f] = (*counts)[f] < kFewestSamples ? 1 : 0;
  }
  return numbers;
}

}  // namespace footwall::ui
