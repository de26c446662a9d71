// NRRD: the header, the place it gives the volume, and every sample. A header may name files beside it: there
// are none beside a file in memory but this one.
#include "fuzz/memory_file.h"
#include "fuzz/target.h"
#include "storage/base/error.h"
#include "storage/formats/nrrd.h"

namespace footwall::fuzz {
namespace {

constexpr std::int64_t kMostSamples = 1 << 14;

// A corner of the volume reads the same twice.
bool reads_alike(const formats::nrrd::NrrdFile& file, const formats::raw::AxisOrder& order) {
  survey::Box box;
  for (std::size_t n = 0; n < 3; ++n) {
    // Axes stand in `order` from the slowest, in the header from the fastest.
    box.hi[static_cast<std::size_t>(order[n])] = file.header().axes[2 - n].size;
  }
  if (box.count() < 0 || box.count() > kMostSamples) {
    for (std::int64_t& end : box.hi) end = std::min<std::int64_t>(end, 8);
  }
  std::vector<float> values(static_cast<std::size_t>(box.count()), 1.0F);
  std::vector<float> again(values.size(), 2.0F);
  file.read_block(order, box, values);
  file.read_block(order, box, again);
  return std::equal(values.begin(), values.end(), again.begin(),
                    [](float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); });
}

bool run(const std::string& bytes) {
  const MemoryFile file(bytes);
  formats::nrrd::looks_like_nrrd(file.path());
  const formats::nrrd::NrrdFile nrrd(file.path(), "/dev/shm", {});
  const formats::raw::AxisOrder order = formats::nrrd::default_order(nrrd.header());
  if (!reads_alike(nrrd, order)) return false;
  formats::nrrd::Meaning meaning;
  meaning.domain_otherwise = survey::Domain::kDepth;
  meaning.unit_otherwise = survey::VerticalUnit::kMetre;
  formats::nrrd::geometry_of(nrrd.header(), order, meaning).geometry.validate();
  return true;
}

constexpr const char* kSmall =
    "NRRD0004\n# made\ntype: float\ndimension: 3\nspace: left-posterior-superior\nsizes: 2 3 4\n"
    "space directions: (1,0,0) (0,1,0) (0,0,2.5)\nkinds: domain domain domain\nendian: little\nencoding: "
    "raw\n"
    "space origin: (10,20,30)\n\n";

}  // namespace

Target fuzz_target() {
  return {
      {"_derived/*.nrrd", "bilgili+Voreen/resource/volumes/*.nrrd", "pyvista+vtk-data/Data/headsq/*.nhdr"},
      {kSmall + std::string(4 * 24, 'A'),
       "NRRD0001\ntype: uchar\ndimension: 2\nsizes: 3 2\nencoding: raw\n\nABCDEF"},
      run};
}

}  // namespace footwall::fuzz
