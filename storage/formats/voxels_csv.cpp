#include "storage/formats/voxels_csv.h"

#include <fmt/format.h>

#include <cmath>

#include "storage/base/error.h"
#include "storage/base/text.h"
#include "storage/formats/detail/csv.h"
#include "storage/formats/detail/output_file.h"

namespace footwall::formats::voxels_csv {

struct Writer::State {
  detail::OutputFile out;
  survey::Geometry survey;
  Depth depth;
};

Writer::Writer(const std::filesystem::path& path, const survey::Geometry& survey, const Depth& depth)
    : state_(new State{detail::OutputFile(path), survey, depth}) {
  state_->out.write("fault,face,i,j,k,inline,crossline,z,value\n");
}

Writer::~Writer() = default;

void Writer::add(const std::string& fault, const std::string& face, std::span<const survey::Index> voxels,
                 std::span<const float> values) {
  require(voxels.size() == values.size(), "a value for every voxel");
  const survey::Geometry& survey = state_->survey;
  const std::string head = detail::csv_quoted(fault) + ',' + detail::csv_quoted(face);
  for (std::size_t n = 0; n < voxels.size(); ++n) {
    const auto& [i, j, k] = voxels[n];
    const double down = (survey.z0 + static_cast<double>(k) * survey.interval) * state_->depth.factor;
    state_->out.print("{},{},{},{},{},{},{},", head, i, j, k, survey.inlines.line_of(i),
                      survey.crosslines.line_of(j), text::shortest(state_->depth.up ? 0.0 - down : down));
    if (std::isnan(values[n])) {
      state_->out.write("\n");
    } else {
      state_->out.print("{}\n", values[n]);
    }
  }
}

void Writer::commit() {
  state_->out.commit();
}

}  // namespace footwall::formats::voxels_csv
