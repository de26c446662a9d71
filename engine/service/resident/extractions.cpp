#include "engine/service/resident/extractions.h"

#include <algorithm>

#include "engine/extract/computations.h"
#include "engine/service/resident/memory_needs.h"
#include "storage/survey/moved_lattice.h"

namespace footwall::service {
namespace {

constexpr std::size_t kMost = 4;
// Names that wait for an extraction that is never asked for again.
constexpr std::size_t kTouchedAnyhow = 100000;

}  // namespace

extract::FaceChanges Extraction::changes(const FaceModel::Faces& model) const {
  extract::FaceChanges changes;
  for (const extract::FaceIdentity& name : touched) {
    const auto now = model.find(name);
    const auto place = incremental->place_of(name);
    if (now == model.end()) {
      if (place) changes.removed.push_back(name);
      continue;
    }
    const extract::Face face{name.fault, name.owner, name.n, survey::in_volume(now->second, origin)};
    if (!place) {
      changes.added.push_back(face);
    } else if (*incremental->face(*place) != face) {
      changes.changed.push_back(face);
    }
  }
  return changes;
}

Extraction& Extractions::of(const OpenVolume& volume, const extract::Options& options) {
  const auto found = std::find_if(all_.begin(), all_.end(), [&](const Extraction& each) {
    return each.volume == volume.checksum && each.options == options;
  });
  if (found != all_.end()) {
    all_.splice(all_.begin(), all_, found);
    return all_.front();
  }
  Extraction fresh;
  fresh.volume = volume.checksum;
  fresh.origin = volume.info.origin;
  fresh.options = options;
  if (!extract::asks_for(options, "offset")) {
    fresh.incremental =
        std::make_unique<extract::Incremental>(*volume.survey, volume.info.statistics.max_abs, options);
  }
  if (all_.size() == kMost) all_.pop_back();
  all_.push_front(std::move(fresh));
  return all_.front();
}

void Extractions::touch(std::span<const extract::FaceIdentity> names, std::size_t faces) {
  for (Extraction& each : all_) each.touched.insert(names.begin(), names.end());
  // So that the faces of scripts that number them anew each time do not pile up: such an extraction is begun
  // again when it is asked for.
  all_.remove_if([&](const Extraction& each) { return each.touched.size() > kTouchedAnyhow + 2 * faces; });
}

std::int64_t Extractions::memory_bytes() const {
  std::int64_t faces = 0;
  for (const Extraction& each : all_)
    faces += each.incremental ? static_cast<std::int64_t>(each.incremental->size()) : 0;
  return extraction_stays(faces);
}

void Extractions::forget(const std::string& volume) {
  all_.remove_if([&](const Extraction& each) { return each.volume == volume; });
}

}  // namespace footwall::service
