#include "engine/session/part_file.h"

#include "engine/extract/face_numbers.h"
#include "engine/session/fault_summary.h"
#include "storage/base/error.h"
#include "storage/base/hash.h"
#include "storage/base/text.h"
#include "storage/volume/column_file.h"

namespace footwall::session {
namespace {

constexpr const char* kFormat = "footwall part";
constexpr const char* kVersion = "3";
constexpr const char* kMend = "run the job again";
constexpr const char* kNone = "none";

using Ints = std::vector<std::int64_t>;
using Numbers = std::vector<double>;

using extract::kFaceNumbers;

struct Shape {
  const char* name;
  double extract::FaceGeometry::*member;
};
constexpr std::array kShapes{Shape{"area", &extract::FaceGeometry::area},
                             Shape{"area_voxels", &extract::FaceGeometry::area_voxels},
                             Shape{"dip", &extract::FaceGeometry::dip},
                             Shape{"dip_azimuth", &extract::FaceGeometry::dip_azimuth},
                             Shape{"normal_i", &extract::FaceGeometry::normal_i},
                             Shape{"normal_j", &extract::FaceGeometry::normal_j},
                             Shape{"normal_k", &extract::FaceGeometry::normal_k},
                             Shape{"metres_along_normal", &extract::FaceGeometry::metres_along_normal}};

enum Place : std::size_t { kOwner, kN, kVertices, kCount, kNulls, kOutside, kNumbers };
constexpr std::size_t kShape = kNumbers + kFaceNumbers.size();
constexpr std::size_t kBlobEnds = kShape + kShapes.size();
constexpr std::size_t kBlobs = kBlobEnds + 1;

// The table of a part without its values: what is written first, and what is asked for when reading.
volume::ColumnTable empty_table() {
  volume::ColumnTable table;
  for (const char* name : {"format", "version", "fault", "name", "part_hash", "whole", "whole_face"})
    table.texts[name];
  table.columns = {{"owner", {}, Ints()},
                   {"n", {}, std::vector<std::int32_t>()},
                   {"vertices", {3, 3}, std::vector<std::int32_t>()},
                   {"count", {}, Ints()},
                   {"nulls", {}, Ints()},
                   {"outside", {}, std::vector<std::uint8_t>()}};
  for (const extract::FaceNumber& each : kFaceNumbers)
    table.columns.push_back({std::string(each.name), {}, Numbers()});
  for (const Shape& each : kShapes) table.columns.push_back({each.name, {}, Numbers()});
  table.columns.push_back({"blob_ends", {}, Ints(), true});
  table.columns.push_back({"blobs", {}, std::vector<std::uint8_t>(), true});
  return table;
}

template <typename T>
std::vector<T>& column(volume::ColumnTable& table, std::size_t place) {
  return std::get<std::vector<T>>(table.columns[place].values);
}

void put_blobs(const std::vector<extract::FaceBlobs>& blobs, std::size_t faces, volume::ColumnTable& table) {
  std::string& names = table.texts["whole_face"];
  auto& ends = column<std::int64_t>(table, kBlobEnds);
  auto& bytes = column<std::uint8_t>(table, kBlobs);
  for (const extract::FaceBlobs& each : blobs) {
    require(each.offsets.size() == faces + 1, "a result of every face");
    names += (names.empty() ? "" : ",") + each.computation;
    const auto start = static_cast<std::int64_t>(bytes.size());
    for (std::size_t f = 1; f <= faces; ++f) {
      ends.push_back(start + static_cast<std::int64_t>(each.offsets[f]));
    }
    const auto* first = reinterpret_cast<const std::uint8_t*>(each.bytes.data());
    bytes.insert(bytes.end(), first, first + each.bytes.size());
  }
  if (names.empty()) names = kNone;
}

std::vector<extract::FaceBlobs> taken_blobs(volume::ColumnTable& table, std::size_t faces, const Error& odd) {
  std::vector<extract::FaceBlobs> all;
  const auto& ends = column<std::int64_t>(table, kBlobEnds);
  const auto& bytes = column<std::uint8_t>(table, kBlobs);
  std::size_t next = 0;
  std::int64_t start = 0;
  if (table.texts["whole_face"] != kNone) {
    for (const std::string_view name : text::split(table.texts["whole_face"], ',')) {
      if (ends.size() - next < faces) throw odd;
      extract::FaceBlobs& blobs = all.emplace_back(extract::FaceBlobs{std::string(name), {0}, {}});
      const std::int64_t first = start;
      for (std::size_t f = 0; f < faces; ++f, ++next) {
        if (ends[next] < start || ends[next] > static_cast<std::int64_t>(bytes.size())) throw odd;
        start = ends[next];
        blobs.offsets.push_back(static_cast<std::uint64_t>(start - first));
      }
      const auto* from = reinterpret_cast<const std::byte*>(bytes.data());
      blobs.bytes.assign(from + first, from + start);
    }
  }
  if (next != ends.size() || start != static_cast<std::int64_t>(bytes.size())) throw odd;
  return all;
}

}  // namespace

std::filesystem::path part_path(const std::filesystem::path& output, std::int64_t fault) {
  return output / ("fault-" + std::to_string(fault) + ".part.h5");
}

void write_part(const Part& part, const std::filesystem::path& path) {
  require(part.statistics.size() == part.faces.size() && part.geometry.size() == part.faces.size(),
          "statistics and geometry of every face");
  require(!part.name.empty(), "a fault's name");
  volume::ColumnTable table = empty_table();
  table.texts = {{"format", kFormat},
                 {"version", kVersion},
                 {"fault", std::to_string(part.fault)},
                 {"name", part.name},
                 {"part_hash", to_hex(part.hash)},
                 {"whole", fault_summary(part.whole).dump()}};
  table.rows = static_cast<std::int64_t>(part.faces.size());
  for (std::size_t f = 0; f < part.faces.size(); ++f) {
    const extract::Face& face = part.faces[f];
    const extract::FaceStatistics& statistics = part.statistics[f];
    const extract::FaceGeometry& geometry = part.geometry[f];
    column<std::int64_t>(table, kOwner).push_back(face.owner);
    column<std::int32_t>(table, kN).push_back(face.n);
    auto& vertices = column<std::int32_t>(table, kVertices);
    for (const survey::LatticePoint& p : face.triangle) vertices.insert(vertices.end(), {p.i, p.j, p.k});
    column<std::int64_t>(table, kCount).push_back(statistics.count);
    column<std::int64_t>(table, kNulls).push_back(statistics.nulls);
    column<std::uint8_t>(table, kOutside).push_back(static_cast<std::uint8_t>(statistics.outside));
    for (std::size_t v = 0; v < kFaceNumbers.size(); ++v)
      column<double>(table, kNumbers + v).push_back(statistics.*kFaceNumbers[v].member);
    for (std::size_t v = 0; v < kShapes.size(); ++v)
      column<double>(table, kShape + v).push_back(geometry.*kShapes[v].member);
  }
  put_blobs(part.blobs, part.faces.size(), table);
  volume::write_column_file(table, path);
}

Part read_part(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) {
    throw Error(ErrorCode::kNotFound, "there is no part file " + path.string(), kMend);
  }
  const Error odd(ErrorCode::kFormat, path.string() + " is not a whole part file", kMend);
  volume::ColumnTable table;
  try {
    table = volume::read_column_file(path, empty_table());
  } catch (const Error& error) {
    if (error.code() == ErrorCode::kFormat) throw odd;
    throw Error(error.code(), error.message(), kMend);
  }
  const auto fault = text::integer(table.texts["fault"]);
  if (table.texts["format"] != kFormat || table.texts["version"] != kVersion || !fault) throw odd;
  Part part;
  part.fault = *fault;
  part.name = table.texts["name"];
  part.hash = hash_from_hex(table.texts["part_hash"]);
  try {
    part.whole = fault_from_summary(nlohmann::json::parse(table.texts["whole"], nullptr, false));
  } catch (const Error&) {
    throw odd;
  }
  const auto count = static_cast<std::size_t>(table.rows);
  part.blobs = taken_blobs(table, count, odd);
  part.faces.resize(count);
  part.statistics.resize(count);
  part.geometry.resize(count);
  for (std::size_t f = 0; f < count; ++f) {
    extract::Face& face = part.faces[f];
    face.fault = part.fault;
    face.owner = column<std::int64_t>(table, kOwner)[f];
    face.n = column<std::int32_t>(table, kN)[f];
    for (std::size_t v = 0; v < 3; ++v) {
      const std::int32_t* p = column<std::int32_t>(table, kVertices).data() + 9 * f + 3 * v;
      face.triangle[v] = {p[0], p[1], p[2]};
    }
    extract::FaceStatistics& statistics = part.statistics[f];
    statistics.count = column<std::int64_t>(table, kCount)[f];
    statistics.nulls = column<std::int64_t>(table, kNulls)[f];
    const std::uint8_t outside = column<std::uint8_t>(table, kOutside)[f];
    if (outside > 2) throw odd;
    statistics.outside = static_cast<extract::Outside>(outside);
    for (std::size_t v = 0; v < kFaceNumbers.size(); ++v)
      statistics.*kFaceNumbers[v].member = column<double>(table, kNumbers + v)[f];
    for (std::size_t v = 0; v < kShapes.size(); ++v)
      part.geometry[f].*kShapes[v].member = column<double>(table, kShape + v)[f];
  }
  return part;
}

}  // namespace footwall::session
