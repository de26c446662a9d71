#include "storage/formats/face_arrays.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "storage/base/error.h"
#include "storage/formats/detail/output_file.h"

namespace footwall::formats::face_arrays {
namespace {

static_assert(std::endian::native == std::endian::little);
static_assert(sizeof(survey::WorldPoint) == 3 * sizeof(double));

constexpr std::int64_t kAlignment = 8;

class Writer {
 public:
  explicit Writer(const std::filesystem::path& path) : out_(path) {}

  void begin(std::string name, std::string type, std::vector<std::int64_t> shape) {
    static constexpr std::array<std::byte, kAlignment> kZeros{};
    const std::int64_t over = offset_ % kAlignment;
    if (over > 0) put(std::span(kZeros).first(static_cast<std::size_t>(kAlignment - over)));
    arrays_.push_back({std::move(name), std::move(type), std::move(shape), offset_});
  }
  void put(std::span<const std::byte> bytes) {
    out_.write(bytes);
    offset_ += static_cast<std::int64_t>(bytes.size());
  }
  template <class Value>
  void put(const std::vector<Value>& values) {
    put(std::as_bytes(std::span(values)));
  }
  std::vector<Array> commit() {
    out_.commit();
    return std::move(arrays_);
  }

 private:
  detail::OutputFile out_;
  std::int64_t offset_ = 0;
  std::vector<Array> arrays_;
};

const std::vector<double>* values_of(const MeshTable& mesh, const std::string& statistic) {
  for (const FaceStatistic& known : mesh.statistics) {
    if (known.name == statistic) return &known.values;
  }
  return nullptr;
}

void put_triangles(Writer& out, std::span<const MeshTable> meshes, std::int64_t faces) {
  out.begin("triangles", "<i4", {faces, 3});
  std::int32_t first = 0;
  for (const MeshTable& mesh : meshes) {
    std::vector<std::array<std::int32_t, 3>> triangles = mesh.triangles;
    for (auto& triangle : triangles) {
      for (std::int32_t& corner : triangle) corner += first;
    }
    out.put(triangles);
    first += static_cast<std::int32_t>(mesh.vertices.size());
  }
  out.begin("fault", "<i4", {faces});
  for (std::size_t t = 0; t < meshes.size(); ++t) {
    out.put(std::vector<std::int32_t>(meshes[t].triangles.size(), static_cast<std::int32_t>(t)));
  }
}

void put_names(Writer& out, std::span<const MeshTable> meshes, std::int64_t faces) {
  std::size_t longest = 1;
  for (const MeshTable& mesh : meshes) {
    for (const std::string& name : mesh.face_ids) longest = std::max(longest, name.size());
  }
  out.begin("face", fmt::format("|S{}", longest), {faces});
  std::vector<char> cell(longest);
  for (const MeshTable& mesh : meshes) {
    for (const std::string& name : mesh.face_ids) {
      std::fill(std::copy(name.begin(), name.end(), cell.begin()), cell.end(), '\0');
      out.put(cell);
    }
  }
}

}  // namespace

std::vector<Array> write(const std::filesystem::path& path, std::span<const MeshTable> meshes) {
  std::int64_t vertices = 0;
  std::int64_t faces = 0;
  for (const MeshTable& mesh : meshes) {
    check(mesh);
    vertices += static_cast<std::int64_t>(mesh.vertices.size());
    faces += static_cast<std::int64_t>(mesh.triangles.size());
  }
  if (vertices > std::numeric_limits<std::int32_t>::max()) {
    throw Error(ErrorCode::kInvalid, fmt::format("{} vertices are more than one file holds", vertices),
                "choose one fault with --fault");
  }
  Writer out(path);
  out.begin("vertices", "<f8", {vertices, 3});
  for (const MeshTable& mesh : meshes) out.put(mesh.vertices);
  put_triangles(out, meshes, faces);
  put_names(out, meshes, faces);
  for (const std::string& statistic : statistic_names(meshes)) {
    out.begin("statistic:" + statistic, "<f8", {faces});
    for (const MeshTable& mesh : meshes) {
      const std::vector<double>* values = values_of(mesh, statistic);
      out.put(values != nullptr
                  ? *values
                  : std::vector<double>(mesh.triangles.size(), std::numeric_limits<double>::quiet_NaN()));
    }
  }
  return out.commit();
}

}  // namespace footwall::formats::face_arrays
