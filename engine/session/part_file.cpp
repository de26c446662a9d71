#include "engine/session/part_file.h"

#include <hdf5.h>

#include <cstring>
#include <utility>

#include "storage/base/error.h"
#include "storage/base/hash.h"
#include "storage/base/partial_file.h"
#include "storage/base/text.h"

namespace footwall::session {
namespace {

constexpr const char* kFormat = "footwall part";
constexpr std::int32_t kVersion = 1;

// HDF5 prints its own stack of errors otherwise; ours say what matters.
class Quiet {
 public:
  Quiet() {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Quiet() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

class Handle {
 public:
  Handle(hid_t id, herr_t (*closer)(hid_t)) : id_(id), closer_(closer) {}
  ~Handle() {
    if (id_ >= 0) closer_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }
  bool good() const { return id_ >= 0; }
  herr_t close() { return closer_(std::exchange(id_, -1)); }

 private:
  hid_t id_;
  herr_t (*closer_)(hid_t);
};

// The columns of a part as plain arrays, written and read by the same table.
struct Columns {
  std::vector<std::int64_t> owner, count, nulls;
  std::vector<std::int32_t> n, vertices;
  std::vector<std::uint8_t> outside;
  std::array<std::vector<double>, 12> values;
};
constexpr std::array<const char*, 12> kValueNames{"mean",          "variance", "min",         "max",
                                                  "discontinuity", "area",     "area_voxels", "dip",
                                                  "dip_azimuth",   "normal_i", "normal_j",    "normal_k"};

std::array<double*, 12> fields(extract::FaceStatistics& s, extract::FaceGeometry& g) {
  return {&s.mean,        &s.variance, &s.min,         &s.max,      &s.discontinuity, &g.area,
          &g.area_voxels, &g.dip,      &g.dip_azimuth, &g.normal_i, &g.normal_j,      &g.normal_k};
}

// Calls visit(name, type in memory, type in the file, numbers per face, vector) for every column.
template <typename Visit>
void each_column(Columns& columns, Visit&& visit) {
  visit("owner", H5T_NATIVE_INT64, H5T_STD_I64LE, 1, columns.owner);
  visit("n", H5T_NATIVE_INT32, H5T_STD_I32LE, 1, columns.n);
  visit("vertices", H5T_NATIVE_INT32, H5T_STD_I32LE, 9, columns.vertices);
  visit("count", H5T_NATIVE_INT64, H5T_STD_I64LE, 1, columns.count);
  visit("nulls", H5T_NATIVE_INT64, H5T_STD_I64LE, 1, columns.nulls);
  visit("outside", H5T_NATIVE_UINT8, H5T_STD_U8LE, 1, columns.outside);
  for (std::size_t v = 0; v < kValueNames.size(); ++v) {
    visit(kValueNames[v], H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE, 1, columns.values[v]);
  }
}

std::uint64_t check_of(Columns& columns) {
  Hasher hasher;
  each_column(columns, [&](const char*, hid_t, hid_t, hsize_t, const auto& column) {
    hasher.add(std::as_bytes(std::span(column)));
  });
  return hasher.value();
}

Columns columns_of(const Part& part) {
  require(part.statistics.size() == part.faces.size() && part.geometry.size() == part.faces.size(),
          "statistics and geometry of every face");
  Columns columns;
  for (std::size_t f = 0; f < part.faces.size(); ++f) {
    const extract::Face& face = part.faces[f];
    extract::FaceStatistics statistics = part.statistics[f];
    extract::FaceGeometry geometry = part.geometry[f];
    columns.owner.push_back(face.owner);
    columns.n.push_back(face.n);
    for (const survey::LatticePoint& p : face.triangle)
      columns.vertices.insert(columns.vertices.end(), {p.i, p.j, p.k});
    columns.count.push_back(statistics.count);
    columns.nulls.push_back(statistics.nulls);
    columns.outside.push_back(static_cast<std::uint8_t>(statistics.outside));
    const auto values = fields(statistics, geometry);
    for (std::size_t v = 0; v < values.size(); ++v) columns.values[v].push_back(*values[v]);
  }
  return columns;
}

void write_text(hid_t file, const char* name, const std::string& text, const std::filesystem::path& path) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  // A text of no length has no HDF5 type: one zero byte stands for it.
  H5Tset_size(type, text.size() + 1);
  H5Tset_cset(type, H5T_CSET_UTF8);
  const Handle attribute(H5Acreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (!attribute.good() || H5Awrite(attribute, type, text.c_str()) < 0) {
    throw Error(ErrorCode::kIo, "cannot write " + path.string(), "is the disk full?");
  }
}

void write_whole(const Part& part, const std::filesystem::path& path) {
  const Error failed(ErrorCode::kIo, "cannot write " + path.string(),
                     "is the disk full, or the folder read-only?");
  Columns columns = columns_of(part);
  Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
  if (!file.good()) throw failed;
  write_text(file, "format", kFormat, path);
  write_text(file, "version", std::to_string(kVersion), path);
  write_text(file, "fault", std::to_string(part.fault), path);
  write_text(file, "name", part.name, path);
  write_text(file, "part_hash", to_hex(part.hash), path);
  write_text(file, "check", to_hex(check_of(columns)), path);
  each_column(columns, [&](const char* name, hid_t memory, hid_t stored, hsize_t width, const auto& column) {
    const hsize_t dims[3] = {part.faces.size(), 3, 3};
    const Handle space(H5Screate_simple(width == 9 ? 3 : 1, dims, nullptr), H5Sclose);
    const Handle set(H5Dcreate2(file, name, stored, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
    if (!set.good() ||
        (!column.empty() && H5Dwrite(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, column.data()) < 0)) {
      throw failed;
    }
  });
  if (file.close() < 0) throw failed;
}

std::string read_text(hid_t file, const char* name, const Error& odd) {
  const Handle attribute(H5Aopen(file, name, H5P_DEFAULT), H5Aclose);
  if (!attribute.good()) throw odd;
  const Handle type(H5Aget_type(attribute), H5Tclose);
  const Handle space(H5Aget_space(attribute), H5Sclose);
  constexpr std::size_t kLongest = 1 << 16;
  const std::size_t size = H5Tget_size(type);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0 || size == 0 || size > kLongest ||
      H5Sget_simple_extent_npoints(space) != 1) {
    throw odd;
  }
  std::string text(size + 1, '\0');
  if (H5Aread(attribute, type, text.data()) < 0) throw odd;
  text.resize(std::strlen(text.c_str()));
  return text;
}

template <typename T>
void read_column(hid_t file, const char* name, hid_t memory, hid_t stored, hsize_t width,
                 std::vector<T>& column, std::optional<hsize_t>& faces, const Error& odd) {
  const Handle set(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose);
  if (!set.good()) throw odd;
  const Handle space(H5Dget_space(set), H5Sclose);
  const Handle type(H5Dget_type(set), H5Tclose);
  const int rank = width == 9 ? 3 : 1;
  hsize_t dims[3] = {0, 3, 3};
  if (H5Tequal(type, stored) <= 0 || H5Sget_simple_extent_ndims(space) != rank ||
      H5Sget_simple_extent_dims(space, dims, nullptr) != rank ||
      (rank == 3 && (dims[1] != 3 || dims[2] != 3))) {
    throw odd;
  }
  if (faces && *faces != dims[0]) throw odd;
  faces = dims[0];
  // No more is allocated than the file really holds.
  const hsize_t bytes = dims[0] * width * sizeof(T);
  if (dims[0] > (hsize_t{1} << 40) || (bytes > 0 && H5Dget_storage_size(set) < bytes)) throw odd;
  column.resize(static_cast<std::size_t>(dims[0] * width));
  if (!column.empty() && H5Dread(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, column.data()) < 0) throw odd;
}

}  // namespace

std::filesystem::path part_path(const std::filesystem::path& output, std::int64_t fault) {
  return output / ("fault-" + std::to_string(fault) + ".part.h5");
}

void write_part(const Part& part, const std::filesystem::path& path) {
  const Quiet quiet;
  PartialFile partial(path);
  write_whole(part, partial.path());
  partial.commit();
}

Part read_part(const std::filesystem::path& path) {
  const Quiet quiet;
  if (!std::filesystem::exists(path)) {
    throw Error(ErrorCode::kNotFound, "there is no part file " + path.string(), "run the job again");
  }
  const Error odd(ErrorCode::kFormat, path.string() + " is not a whole part file", "run the job again");
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (!file.good()) throw odd;
  if (read_text(file, "format", odd) != kFormat ||
      read_text(file, "version", odd) != std::to_string(kVersion)) {
    throw odd;
  }
  Columns columns;
  std::optional<hsize_t> faces;
  each_column(columns, [&](const char* name, hid_t memory, hid_t stored, hsize_t width, auto& column) {
    read_column(file, name, memory, stored, width, column, faces, odd);
  });
  if (read_text(file, "check", odd) != to_hex(check_of(columns))) {
    throw Error(ErrorCode::kCorrupt, path.string() + " was altered: its checksum differs",
                "run the job again");
  }
  Part part;
  const auto fault = text::integer(read_text(file, "fault", odd));
  if (!fault) throw odd;
  part.fault = *fault;
  part.name = read_text(file, "name", odd);
  part.hash = hash_from_hex(read_text(file, "part_hash", odd));
  const auto count = static_cast<std::size_t>(faces.value_or(0));
  part.faces.resize(count);
  part.statistics.resize(count);
  part.geometry.resize(count);
  for (std::size_t f = 0; f < count; ++f) {
    extract::Face& face = part.faces[f];
    face.fault = part.fault;
    face.owner = columns.owner[f];
    face.n = columns.n[f];
    for (std::size_t v = 0; v < 3; ++v) {
      const std::int32_t* p = columns.vertices.data() + 9 * f + 3 * v;
      face.triangle[v] = {p[0], p[1], p[2]};
    }
    extract::FaceStatistics& statistics = part.statistics[f];
    statistics.count = columns.count[f];
    statistics.nulls = columns.nulls[f];
    if (columns.outside[f] > 2) throw odd;
    statistics.outside = static_cast<extract::Outside>(columns.outside[f]);
    const auto values = fields(statistics, part.geometry[f]);
    for (std::size_t v = 0; v < values.size(); ++v) *values[v] = columns.values[v][f];
  }
  return part;
}

}  // namespace footwall::session
