#include "engine/tasks/statistics.h"

#include <algorithm>
#include <functional>

namespace footwall::tasks {
namespace {

struct Column {
  const char* name;
  const char* unit_rule;
  const char* colour_map;
  const char* description;
  std::function<double(const session::Part&, std::size_t)> value;
};

template <class Member>
auto statistic(Member member) {
  return [member](const session::Part& part, std::size_t f) {
    return static_cast<double>(part.statistics[f].*member);
  };
}

template <class Member>
auto shape(Member member) {
  return [member](const session::Part& part, std::size_t f) {
    return static_cast<double>(part.geometry[f].*member);
  };
}

const std::vector<Column>& columns() {
  using S = extract::FaceStatistics;
  using G = extract::FaceGeometry;
  static const std::vector<Column> rows{
      {"count", "1", "viridis", "voxels with a value", statistic(&S::count)},
      {"nulls", "1", "viridis", "voxels without a value", statistic(&S::nulls)},
      {"outside", "1", "viridis", "0 inside the survey, 1 partly, 2 wholly outside", statistic(&S::outside)},
      {"mean", "amplitude", "red-white-blue", "mean amplitude", statistic(&S::mean)},
      {"variance", "amplitude^2", "viridis", "amplitude variance: sample variance of the amplitudes",
       statistic(&S::variance)},
      {"min", "amplitude", "red-white-blue", "smallest amplitude", statistic(&S::min)},
      {"max", "amplitude", "red-white-blue", "largest amplitude", statistic(&S::max)},
      {"discontinuity", "1", "cividis", "0 continuous to 1 discontinuous, independent of gain",
       statistic(&S::discontinuity)},
      {"contrast", "1", "red-white-blue",
       "discontinuity above that 6 voxels beside the face; higher is better", statistic(&S::contrast)},
      {"offset", "m", "red-white-blue",
       "how far beside the face the discontinuity is highest, along its normal",
       [](const session::Part& part, std::size_t f) {
         return part.statistics[f].offset_voxels * part.geometry[f].metres_along_normal;
       }},
      {"offset_voxels", "voxel", "red-white-blue", "the same in voxels, -8 to 8",
       statistic(&S::offset_voxels)},
      {"offset_score", "1", "cividis", "the discontinuity there", statistic(&S::offset_score)},
      {"area_voxels", "voxel^2", "viridis", "area in index space", shape(&G::area_voxels)},
      {"area", "m^2", "viridis", "area", shape(&G::area)},
      {"dip", "degrees", "viridis", "dip from the horizontal", shape(&G::dip)},
      {"dip_azimuth", "degrees", "viridis", "direction of dip, clockwise from north", shape(&G::dip_azimuth)},
      {"normal_i", "1", "red-white-blue", "unit normal in index space, inline component",
       shape(&G::normal_i)},
      {"normal_j", "1", "red-white-blue", "unit normal in index space, crossline component",
       shape(&G::normal_j)},
      {"normal_k", "1", "red-white-blue", "unit normal in index space, sample component",
       shape(&G::normal_k)}};
  return rows;
}

}  // namespace

std::vector<project::StatisticRecord> stored_statistics() {
  std::vector<project::StatisticRecord> records;
  for (const Column& column : columns()) {
    project::StatisticRecord record;
    record.name = column.name;
    record.unit_rule = column.unit_rule;
    record.colour_map = column.colour_map;
    record.description = column.description;
    records.push_back(record);
  }
  return records;
}

std::vector<project::StatisticRecord> known_statistics(const project::Project& project) {
  std::vector<project::StatisticRecord> known = stored_statistics();
  const std::size_t own = known.size();
  for (project::StatisticRecord& registered : project.statistics()) {
    const auto end = known.begin() + static_cast<std::ptrdiff_t>(own);
    if (std::none_of(known.begin(), end, [&](const auto& each) { return each.name == registered.name; }))
      known.push_back(std::move(registered));
  }
  return known;
}

std::map<std::string, std::vector<double>> columns_of(const session::Part& part) {
  std::map<std::string, std::vector<double>> values;
  for (const Column& column : columns()) {
    std::vector<double>& out = values[column.name];
    out.reserve(part.faces.size());
    for (std::size_t f = 0; f < part.faces.size(); ++f) out.push_back(column.value(part, f));
  }
  return values;
}

std::string unit_of(const project::StatisticRecord& statistic) {
  return statistic.unit_rule == "1" ? std::string() : statistic.unit_rule;
}

}  // namespace footwall::tasks
