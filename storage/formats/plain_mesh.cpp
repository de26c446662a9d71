#include "storage/formats/plain_mesh.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>

#include "storage/base/error.h"
#include "storage/base/partial_file.h"
#include "storage/base/text.h"

namespace footwall::formats {
namespace {

static_assert(std::endian::native == std::endian::little, "binary values are taken as they are");

constexpr std::size_t kLimit = std::size_t{1} << 34;
constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();

struct Property {
  std::string name;
  std::string type;
};
struct Header {
  bool binary = false;
  std::int64_t vertices = 0;
  std::int64_t faces = 0;
  std::vector<Property> of_vertex;
  std::string count_type;  // of a face's list
  std::string index_type;
  std::size_t end = 0;  // where the values begin
};

std::size_t size_of(std::string_view type) {
  for (const auto& [name, size] : {std::pair<std::string_view, std::size_t>{"char", 1},
                                   {"int8", 1},
                                   {"uchar", 1},
                                   {"uint8", 1},
                                   {"short", 2},
                                   {"int16", 2},
                                   {"ushort", 2},
                                   {"uint16", 2},
                                   {"int", 4},
                                   {"int32", 4},
                                   {"uint", 4},
                                   {"uint32", 4},
                                   {"float", 4},
                                   {"float32", 4},
                                   {"double", 8},
                                   {"float64", 8}}) {
    if (type == name) return size;
  }
  throw Error(ErrorCode::kFormat, fmt::format("a PLY file has no type '{}'", type));
}

template <class T>
double value_as(const char* at) {
  T value;
  std::memcpy(&value, at, sizeof(T));
  return static_cast<double>(value);
}

double value_at(const char* at, std::string_view type) {
  if (type == "float" || type == "float32") return value_as<float>(at);
  if (type == "double" || type == "float64") return value_as<double>(at);
  if (type == "char" || type == "int8") return value_as<std::int8_t>(at);
  if (type == "uchar" || type == "uint8") return value_as<std::uint8_t>(at);
  if (type == "short" || type == "int16") return value_as<std::int16_t>(at);
  if (type == "ushort" || type == "uint16") return value_as<std::uint16_t>(at);
  if (type == "int" || type == "int32") return value_as<std::int32_t>(at);
  return value_as<std::uint32_t>(at);
}

Header header_of(std::string_view bytes) {
  Header header;
  std::size_t at = 0;
  std::string element;
  bool has_format = false;
  const auto odd = [](std::string_view line) {
    return Error(ErrorCode::kFormat, fmt::format("the PLY header's line '{}' makes no sense", line));
  };
  while (true) {
    const std::size_t end = bytes.find('\n', at);
    if (end == std::string_view::npos) throw Error(ErrorCode::kFormat, "the PLY header does not end");
    const std::string_view line = bytes.substr(at, end - at);
    at = end + 1;
    const std::vector<std::string_view> words = text::words(text::trimmed(line));
    if (words.empty() || words[0] == "ply" || words[0] == "comment" || words[0] == "obj_info") continue;
    if (words[0] == "end_header") break;
    if (words[0] == "format" && words.size() >= 2) {
      if (words[1] == "binary_big_endian")
        throw Error(ErrorCode::kUnsupported, "a big-endian PLY file cannot be read",
                    "write it as text or little endian");
      header.binary = words[1] == "binary_little_endian";
      has_format = header.binary || words[1] == "ascii";
    } else if (words[0] == "element" && words.size() == 3) {
      const auto count = text::integer(words[2]);
      if (!count || *count < 0 || *count > kMost) throw odd(line);
      if (element == "face")
        throw Error(ErrorCode::kUnsupported, "a PLY file with elements behind the faces cannot be read");
      element = words[1];
      if (element == "vertex") {
        header.vertices = *count;
      } else if (element == "face") {
        header.faces = *count;
      } else if (*count > 0) {
        throw Error(ErrorCode::kUnsupported,
                    fmt::format("a PLY file with elements '{}' cannot be read", element));
      }
    } else if (words[0] == "property" && words.size() == 3 && element == "vertex") {
      size_of(words[1]);
      header.of_vertex.push_back({std::string(words[2]), std::string(words[1])});
    } else if (words[0] == "property" && words.size() == 5 && words[1] == "list" && element == "face" &&
               header.index_type.empty()) {
      header.count_type = words[2];
      header.index_type = words[3];
      size_of(words[2]);
      size_of(words[3]);
    } else {
      throw odd(line);
    }
  }
  if (!has_format || (header.faces > 0 && header.index_type.empty()))
    throw Error(ErrorCode::kFormat, "the PLY header does not say how its faces are stored");
  header.end = at;
  return header;
}

// The file's values one after the other.
class Values {
 public:
  Values(std::string_view bytes, bool binary) : bytes_(bytes), binary_(binary) {}
  double next(std::string_view type) {
    if (binary_) {
      const std::size_t size = size_of(type);
      if (bytes_.size() < size) throw Error(ErrorCode::kFormat, "the PLY file ends too early");
      const double value = value_at(bytes_.data(), type);
      bytes_.remove_prefix(size);
      return value;
    }
    const std::size_t first = bytes_.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos) throw Error(ErrorCode::kFormat, "the PLY file ends too early");
    bytes_.remove_prefix(first);
    const std::size_t size = std::min(bytes_.find_first_of(" \t\r\n"), bytes_.size());
    const auto value = text::number(bytes_.substr(0, size));
    if (!value) throw Error(ErrorCode::kFormat, fmt::format("'{}' is no number", bytes_.substr(0, size)));
    bytes_.remove_prefix(size);
    return *value;
  }

 private:
  std::string_view bytes_;
  bool binary_;
};

void add_normals(PlainMesh& mesh) {
  mesh.normals.assign(mesh.positions.size(), {0, 0, 0});
  for (const auto& t : mesh.triangles) {
    const auto& a = mesh.positions[static_cast<std::size_t>(t[0])];
    const auto& b = mesh.positions[static_cast<std::size_t>(t[1])];
    const auto& c = mesh.positions[static_cast<std::size_t>(t[2])];
    std::array<float, 3> normal{};
    for (std::size_t n = 0; n < 3; ++n) {
      const std::size_t p = (n + 1) % 3;
      const std::size_t q = (n + 2) % 3;
      normal[n] = (b[p] - a[p]) * (c[q] - a[q]) - (b[q] - a[q]) * (c[p] - a[p]);
    }
    for (const std::int32_t v : t) {
      for (std::size_t n = 0; n < 3; ++n) mesh.normals[static_cast<std::size_t>(v)][n] += normal[n];
    }
  }
  for (auto& n : mesh.normals) {
    const float size = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (float& each : n) each = size > 0 ? each / size : 0;
  }
}

PlainMesh read_ply(std::string_view bytes) {
  const Header header = header_of(bytes);
  Values values(bytes.substr(header.end), header.binary);
  PlainMesh mesh;
  bool has_normals = false;
  std::size_t coordinates = 0;
  for (const Property& p : header.of_vertex) {
    has_normals = has_normals || p.name == "nz";
    coordinates += p.name == "x" || p.name == "y" || p.name == "z" ? 1 : 0;
  }
  if (coordinates != 3) throw Error(ErrorCode::kFormat, "the PLY file's vertices have no x, y and z");
  for (std::int64_t v = 0; v < header.vertices; ++v) {
    std::array<float, 3> position{};
    std::array<float, 3> normal{};
    for (const Property& p : header.of_vertex) {
      const auto value = static_cast<float>(values.next(p.type));
      const char axis = p.name.back();
      const bool is_axis = axis >= 'x' && axis <= 'z';
      if (is_axis && p.name.size() == 1) position[static_cast<std::size_t>(axis - 'x')] = value;
      if (is_axis && p.name.size() == 2 && p.name[0] == 'n')
        normal[static_cast<std::size_t>(axis - 'x')] = value;
    }
    mesh.positions.push_back(position);
    if (has_normals) mesh.normals.push_back(normal);
  }
  for (std::int64_t f = 0; f < header.faces; ++f) {
    if (values.next(header.count_type) != 3)
      throw Error(ErrorCode::kUnsupported, fmt::format("face {} is no triangle", f), "triangulate the mesh");
    std::array<std::int32_t, 3> corners{};
    for (std::int32_t& corner : corners) {
      const double index = values.next(header.index_type);
      if (!(index >= 0 && index < static_cast<double>(header.vertices)))
        throw Error(ErrorCode::kFormat, fmt::format("face {} refers to a vertex that is not there", f));
      corner = static_cast<std::int32_t>(index);
    }
    mesh.triangles.push_back(corners);
  }
  if (!has_normals) add_normals(mesh);
  return mesh;
}

PlainMesh read_stl(std::string_view bytes) {
  constexpr std::size_t kHead = 84;
  constexpr std::size_t kTriangle = 50;
  std::uint32_t count = 0;
  if (bytes.size() >= kHead) std::memcpy(&count, bytes.data() + 80, sizeof count);
  if (bytes.size() != kHead + kTriangle * std::size_t{count} || count > kMost / 3)
    throw Error(ErrorCode::kFormat, "this is no PLY file and no binary STL file",
                "of STL files only binary ones can be read");
  PlainMesh mesh;
  for (std::size_t t = 0; t < count; ++t) {
    std::array<std::array<float, 3>, 4> values{};  // a normal, and the corners
    std::memcpy(values.data(), bytes.data() + kHead + kTriangle * t, sizeof values);
    const auto first = static_cast<std::int32_t>(3 * t);
    mesh.positions.insert(mesh.positions.end(), values.begin() + 1, values.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  add_normals(mesh);
  return mesh;
}

}  // namespace

PlainMesh read_plain_mesh(const std::filesystem::path& path) {
  const std::string bytes = read_whole_file(path, kLimit);
  try {
    return std::string_view(bytes).starts_with("ply") ? read_ply(bytes) : read_stl(bytes);
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("{}: {}", path.string(), error.message()), error.hint());
  }
}

}  // namespace footwall::formats
