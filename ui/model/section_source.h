// Sections out of one volume file, by way of its chunks: what a chunk costs (disk, hash) is paid once for all
// sections that pass through it, whatever their direction.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "storage/volume/volume_reader.h"
#include "ui/model/lru.h"
#include "ui/model/section_reader.h"

namespace footwall::ui {

// By the number of the opened file and of the chunk in it.
using ChunkCache = Lru<std::pair<std::uint64_t, std::int64_t>, std::vector<float>>;

// For one thread.
class SectionSource {
 public:
  // origin: of the volume in the survey's index space. number: another one for every source that shares the
  // cache. Throws what VolumeReader throws.
  SectionSource(const std::filesystem::path& path, std::uint64_t number, const survey::Index& origin,
                ChunkCache& cache);

  const volume::VolumeInfo& info() const { return reader_.info(); }

  // Nothing where stop() said so, which is asked before each chunk that must be read. Throws kInvalid for a
  // line that has no end or too many samples, else as VolumeReader::read.
  std::optional<SectionSamples> read(Id volume, const Section& section, const survey::Geometry& survey,
                                     const std::function<bool()>& stop);

 private:
  // Null: stopped. The chunk holds the volume's box_of(place) alone.
  std::shared_ptr<const std::vector<float>> chunk(const survey::Index& place,
                                                  const std::function<bool()>& stop);
  survey::Box box_of(const survey::Index& place) const;
  bool fill_plane(SectionSamples& samples, int fixed, int across, int down,
                  const std::function<bool()>& stop);
  bool fill_line(SectionSamples& samples, const std::function<bool()>& stop);

  volume::VolumeReader reader_;
  std::uint64_t number_;
  survey::Index origin_;
  survey::Index counts_{};  // chunks
  ChunkCache& cache_;
};

// What clips and colours need to know; see SectionReader::VolumeFacts.
SectionReader::VolumeFacts facts_of(const volume::Statistics& statistics);

}  // namespace footwall::ui
