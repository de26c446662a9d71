#include "ui/model/face_values.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace footwall::ui {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kFewestSamples = 30;  // below, a face is left out of rankings

// Offsets are computed apart from the rest, when a gesture is over.
enum Family : std::size_t { kWithMoves, kLate };

Family family_of(const std::string& statistic) {
  return comes_late(QString::fromStdString(statistic)) ? kLate : kWithMoves;
}

std::set<Family> families_of(const std::map<std::string, std::vector<double>>& columns) {
  std::set<Family> families;
  for (const auto& [statistic, values] : columns) families.insert(family_of(statistic));
  return families;
}

}  // namespace

void FaceValues::set_surface(std::shared_ptr<const FaultSurface> surface) {
  const std::shared_ptr<const FaultSurface> before = std::exchange(surface_, std::move(surface));
  const auto former_values = std::exchange(values_, {});
  const auto former_computed = std::exchange(computed_at_, {});
  if (surface_ == nullptr) return;
  const std::size_t count = surface_->faces.size();
  for (auto& places : computed_at_) places.assign(count, std::nullopt);
  if (before == nullptr) return;
  std::vector<std::size_t> from(count, before->faces.size());
  for (std::size_t f = 0; f < count; ++f) {
    const std::size_t place = before->place_of(surface_->faces[f].panel, surface_->faces[f].n, f);
    if (place == before->faces.size()) continue;
    from[f] = place;
    for (const Family family : {kWithMoves, kLate}) computed_at_[family][f] = former_computed[family][place];
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
  if (const auto found = surface_->geometry.find(statistic); found != surface_->geometry.end())
    return &found->second;
  const auto found = values_.find(statistic);
  return found == values_.end() ? nullptr : &found->second;
}

std::vector<double>& FaceValues::column(const std::string& statistic) {
  std::vector<double>& values = values_[statistic];
  values.resize(surface_->faces.size(), kUnknown);
  return values;
}

void FaceValues::set(std::span<const Id> panels, std::span<const std::int32_t> numbers,
                     std::span<const survey::LatticeTriangle> corners,
                     const std::map<std::string, std::vector<double>>& columns) {
  if (surface_ == nullptr) return;
  const std::set<Family> families = families_of(columns);
  std::vector<std::size_t> places(panels.size());
  std::size_t guess = 0;
  for (std::size_t n = 0; n < panels.size(); ++n) {
    const std::size_t place = places[n] = surface_->place_of(panels[n], numbers[n], guess);
    if (place == surface_->faces.size()) continue;
    guess = place + 1;
    for (const Family family : families) computed_at_[family][place] = corners[n];
  }
  for (const auto& [statistic, values] : columns) {
    if (is_geometry(statistic)) continue;
    std::vector<double>& into = column(statistic);
    for (std::size_t n = 0; n < places.size(); ++n) {
      if (places[n] < into.size()) into[places[n]] = values[n];
    }
  }
}

void FaceValues::take(const std::vector<Id>& panels, const std::vector<std::int32_t>& numbers,
                      const std::map<std::string, std::vector<double>>& statistics,
                      const std::vector<std::size_t>& rows, const FaultSurface& computed_on) {
  const std::set<Family> families = families_of(statistics);
  std::vector<std::pair<std::size_t, std::size_t>> placed;  // row, place
  if (surface_ == nullptr) return;
  placed.reserve(rows.size());
  std::size_t guess = 0, former_guess = 0;
  for (const std::size_t row : rows) {
    const std::size_t place = surface_->place_of(panels[row], numbers[row], guess);
    const std::size_t former = computed_on.place_of(panels[row], numbers[row], former_guess);
    if (place == surface_->faces.size() || former == computed_on.faces.size()) continue;
    guess = place + 1;
    former_guess = former + 1;
    placed.emplace_back(row, place);
    for (const Family family : families) {
      // An offset is along the normal, whose side is the whole surface's.
      const bool turned = family == kLate && computed_on.side != surface_->side;
      computed_at_[family][place] = turned ? std::nullopt : std::optional(computed_on.lattice[former]);
    }
  }
  if (placed.empty()) return;
  for (const auto& [statistic, values] : statistics) {
    std::vector<double>& into = column(statistic);
    for (const auto& [row, place] : placed) into[place] = values[row];
  }
}

void FaceValues::scale(const std::string& product, const std::string& factor, const std::string& other) {
  const std::vector<double>* a = find(factor);
  const std::vector<double>* b = find(other);
  if (a == nullptr || b == nullptr) return;
  std::vector<double>& into = column(product);
  for (std::size_t f = 0; f < into.size(); ++f) into[f] = (*a)[f] * (*b)[f];
}

void FaceValues::mark_stale(const std::string& statistic) {
  std::ranges::fill(computed_at_[family_of(statistic)], std::nullopt);
}

void FaceValues::mark_all_stale() {
  for (auto& places : computed_at_) std::ranges::fill(places, std::nullopt);
}

std::vector<std::uint8_t> FaceValues::stale_faces(const std::string& statistic) const {
  if (surface_ == nullptr) return {};
  std::vector<std::uint8_t> stale(surface_->faces.size(), 0);
  if (is_geometry(statistic)) return stale;
  const auto& places = computed_at_[family_of(statistic)];
  for (std::size_t f = 0; f < stale.size(); ++f) stale[f] = places[f] != surface_->lattice[f] ? 1 : 0;
  return stale;
}

bool FaceValues::any_stale(const std::string& statistic) const {
  return std::ranges::count(stale_faces(statistic), 1) != 0;
}

std::shared_ptr<const FaceNumbers> FaceValues::numbers(const std::string& statistic) const {
  const std::vector<double>* values = find(statistic);
  if (values == nullptr) return nullptr;
  auto numbers = std::make_shared<FaceNumbers>();
  numbers->values = *values;
  const std::size_t count = surface_->faces.size();
  numbers->stale = stale_faces(statistic);
  numbers->hatched.assign(count, 0);
  if (const std::vector<double>* counts = find("count")) {
    for (std::size_t f = 0; f < count; ++f) numbers->hatched[f] = (*counts)[f] < kFewestSamples ? 1 : 0;
  }
  return numbers;
}

}  // namespace footwall::ui
