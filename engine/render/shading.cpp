#include "engine/render/shading.h"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/render/section_samples.h"
#include "storage/base/error.h"

namespace footwall::render {
namespace {

// A headlight, a lamp at the upper left and soft ambient: colours carry values, so light changes them little,
// but surfaces that lie differently must be told apart where they meet.
constexpr double kAmbient = 0.68;
constexpr double kHeadlight = 0.28;
constexpr double kLamp = 0.20;
constexpr double kBackFace = 0.90;
constexpr double kEdgeDarkening = 0.20;
// Triangle edges fade in between these heights of a triangle, in pixels of the finished picture.
constexpr double kNoEdgesBelow = 5;
constexpr double kFullEdgesAbove = 14;

double light_on(const Vec3& a, const Vec3& b, const Vec3& c, const Camera& camera) {
  const Vec3 normal = cross(b - a, c - a);
  const double size = length(normal);
  if (!(size > 0)) return kAmbient;
  const double facing = dot(normal, camera.towards_eye((a + b + c) * (1.0 / 3))) / size;
  // The lit side is the one that is seen.
  const Vec3 lamp = camera.right * -0.66 + camera.up * 0.55 + camera.forward * -0.51;
  const double lit = std::max(0.0, dot(normal, lamp) / size * (facing < 0 ? -1 : 1));
  return (kAmbient + kHeadlight * std::abs(facing) + kLamp * lit) * (facing < 0 ? kBackFace : 1);
}

double edge_length(const ScreenVertex& a, const ScreenVertex& b) {
  return std::hypot(static_cast<double>(b.x) - a.x, static_cast<double>(b.y) - a.y) / kSubPixels;
}

double twice_area(const ScreenVertex& a, const ScreenVertex& b, double x, double y) {
  return ((static_cast<double>(b.x) - a.x) * (y - a.y) - (static_cast<double>(b.y) - a.y) * (x - a.x)) /
         (kSubPixels * kSubPixels);
}

// Shortens the segment to what lies before the eye and not far beside the picture; false if nothing does.
bool cut_to_view(Vec4& a, Vec4& b) {
  const auto inside_by = [](int plane, const Vec4& p) {
    switch (plane) {
      case 0:
        return p.w + p.z;
      case 1:
        return 2 * p.w + p.x;
      case 2:
        return 2 * p.w - p.x;
      case 3:
        return 2 * p.w + p.y;
      default:
        return 2 * p.w - p.y;
    }
  };
  double from = 0;
  double to = 1;
  for (int plane = 0; plane < 5; ++plane) {
    const double da = inside_by(plane, a);
    const double db = inside_by(plane, b);
    if (!(da > 0) && !(db > 0)) return false;
    if (!(da > 0)) from = std::max(from, da / (da - db));
    if (!(db > 0)) to = std::min(to, da / (da - db));
  }
  if (!(from < to)) return false;
  const auto at = [a, b](double share) {
    return Vec4{a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share, a.z + (b.z - a.z) * share,
                a.w + (b.w - a.w) * share};
  };
  if (from > 0)
    a = at(from + 1e-9 * (to - from));  // not on the plane itself, where rounding may put it outside
  if (to < 1) b = at(to - 1e-9 * (to - from));
  return true;
}

void check(const ColouredMesh& mesh) {
  check_indices(mesh.triangles, mesh.positions.size());
  if (mesh.face_colours.size() != mesh.triangles.size() ||
      (!mesh.face_hatched.empty() && mesh.face_hatched.size() != mesh.triangles.size())) {
    throw Error(ErrorCode::kInvalid,
                fmt::format("a mesh of {} triangles has {} face colours and {} hatch flags",
                            mesh.triangles.size(), mesh.face_colours.size(), mesh.face_hatched.size()));
  }
}

std::array<double, 9> inverse3(const std::array<double, 9>& m, bool& possible) {
  const auto minor = [&](std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
    return m[a] * m[d] - m[b] * m[c];
  };
  const double det = m[0] * minor(4, 5, 7, 8) - m[1] * minor(3, 5, 6, 8) + m[2] * minor(3, 4, 6, 7);
  possible = std::isfinite(1 / det);
  std::array<double, 9> inverse{minor(4, 5, 7, 8),  -minor(1, 2, 7, 8), minor(1, 2, 4, 5),
                                -minor(3, 5, 6, 8), minor(0, 2, 6, 8),  -minor(0, 2, 3, 5),
                                minor(3, 4, 6, 7),  -minor(0, 1, 6, 7), minor(0, 1, 3, 4)};
  for (double& v : inverse) v /= det;
  return inverse;
}

}  // namespace

PreparedScene::PreparedScene(const Scene& scene, const Camera& camera, const SampleGrid& grid, int threads)
    : grid_(grid), view_projection_(camera.view_projection) {
  std::size_t primitives = scene.sections.size() + scene.lines.size();
  for (const ColouredMesh& mesh : scene.meshes) {
    check(mesh);
    primitives += mesh.triangles.size();
  }
  if (primitives >= kNoPrimitive)
    throw Error(ErrorCode::kMemory, fmt::format("{} primitives are too many for one picture", primitives));
  for (const ColouredMesh& mesh : scene.meshes) add_mesh(mesh, camera, threads);
  for (const SectionPlane& section : scene.sections) add_section(section, camera);
  first_line_ = next_;
  for (const Polyline& line : scene.lines) add_line(line, camera);
}

void PreparedScene::add_mesh(const ColouredMesh& source, const Camera& camera, int threads) {
  Mesh mesh{&source, next_, std::vector<ScreenVertex>(source.positions.size()),
            std::vector<Rgba>(source.triangles.size()),
            std::vector<float>(source.edges ? source.triangles.size() : 0)};
  next_ += static_cast<PrimitiveId>(source.triangles.size());
  project(view_projection_, source.positions, grid_.width, grid_.height, mesh.vertices);
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t t = 0; t < source.triangles.size(); ++t) {
    std::array<std::size_t, 3> v{};
    for (std::size_t n = 0; n < 3; ++n) v[n] = static_cast<std::size_t>(source.triangles[t][n]);
    const double light = source.lit ? light_on(Vec3(source.positions[v[0]]), Vec3(source.positions[v[1]]),
                                               Vec3(source.positions[v[2]]), camera)
                                    : 1;
    mesh.shades[t] = scaled(source.face_colours[t], light);
    const ScreenVertex& a = mesh.vertices[v[0]];
    const ScreenVertex& b = mesh.vertices[v[1]];
    const ScreenVertex& c = mesh.vertices[v[2]];
    if (!source.edges || (a.outside | b.outside | c.outside) != 0) continue;
    const double longest = std::max({edge_length(a, b), edge_length(b, c), edge_length(c, a)});
    const double height = longest > 0 ? std::abs(twice_area(a, b, c.x, c.y)) / longest / grid_.per_pixel : 0;
    mesh.edge_shade[t] = static_cast<float>(
        kEdgeDarkening * std::clamp((height - kNoEdgesBelow) / (kFullEdgesAbove - kNoEdgesBelow), 0.0, 1.0));
  }
  meshes_.push_back(std::move(mesh));
}

void PreparedScene::add_section(const SectionPlane& source, const Camera& camera) {
  if (source.rows < 1 || source.columns < 1 || source.colours == nullptr ||
      source.values.size() !=
          static_cast<std::size_t>(source.rows) * static_cast<std::size_t>(source.columns)) {
    throw Error(ErrorCode::kInvalid, fmt::format("a section of {} x {} samples has {} values", source.rows,
                                                 source.columns, source.values.size()));
  }
  Section section{&source, next_++, {}, false, false};
  // (row, column, 1) -> homogeneous sample position: the clip-space images of the plane's axes, then the
  // viewport.
  const Vec4 at = camera.clip_of(source.origin);
  const auto direction = [&](const Vec3& d) {
    const Vec4 far = camera.clip_of(source.origin + d);
    return Vec4{far.x - at.x, far.y - at.y, far.z - at.z, far.w - at.w};
  };
  const Vec4 rows = direction(source.along_rows);
  const Vec4 columns = direction(source.along_columns);
  std::array<double, 9> sample_of{};
  const std::array<const Vec4*, 3> parts{&rows, &columns, &at};
  for (std::size_t n = 0; n < 3; ++n) {
    sample_of[n] = (parts[n]->x + parts[n]->w) * 0.5 * grid_.width;
    sample_of[3 + n] = (parts[n]->w - parts[n]->y) * 0.5 * grid_.height;
    sample_of[6 + n] = parts[n]->w;
  }
  section.texel_of = inverse3(sample_of, section.seen);
  // One way for the whole section: nearer texels are larger, and a change of manner would show as a seam.
  const Vec4 middle = camera.clip_of(source.origin + source.along_rows * ((source.rows - 1) / 2.0) +
                                     source.along_columns * ((source.columns - 1) / 2.0));
  const Texel texel = texel_at(section, (middle.x / middle.w * 0.5 + 0.5) * grid_.width,
                               (0.5 - middle.y / middle.w * 0.5) * grid_.height);
  section.squares = shows_squares(texel.row_step, texel.column_step, grid_.per_pixel);
  sections_.push_back(section);
}

void PreparedScene::add_line(const Polyline& line, const Camera& camera) {
  const PrimitiveId id = next_++;
  line_colours_.push_back(line.colour);
  for (std::size_t n = 1; n < line.points.size(); n += line.pairs ? 2 : 1) {
    add_segment(camera.clip_of(line.points[n - 1]), camera.clip_of(line.points[n]), line, id);
  }
  if (!(line.dots > 0)) return;
  for (const Vec3& point : line.points) add_dot(camera.clip_of(point), line, id);
}

void PreparedScene::add_segment(Vec4 a, Vec4 b, const Polyline& line, PrimitiveId id) {
  if (!cut_to_view(a, b)) return;
  const ScreenVertex from = projected(a, grid_.width, grid_.height);
  const ScreenVertex to = projected(b, grid_.width, grid_.height);
  if ((from.outside | to.outside) != 0) return;
  const double dx = static_cast<double>(to.x) - from.x;
  const double dy = static_cast<double>(to.y) - from.y;
  const double far = std::hypot(dx, dy);
  if (!(far > 0)) return;
  // A little longer than the segment, so that the corners of a polyline close.
  const double half = line.width * grid_.per_pixel * kSubPixels / 2;
  const double along_x = dx / far * half;
  const double along_y = dy / far * half;
  const auto corner = [&](const ScreenVertex& end, double sign_along, double sign_across) {
    ScreenVertex v = end;
    v.x += static_cast<std::int32_t>(std::lround(sign_along * 0.5 * along_x - sign_across * along_y));
    v.y += static_cast<std::int32_t>(std::lround(sign_along * 0.5 * along_y + sign_across * along_x));
    v.depth = std::clamp(v.depth - static_cast<float>(line.lift), 0.0F, 1.0F);
    return v;
  };
  ribbons_.push_back({{corner(from, -1, -1), corner(to, 1, -1), corner(to, 1, 1), corner(from, -1, 1)}, id});
}

void PreparedScene::add_dot(const Vec4& at, const Polyline& line, PrimitiveId id) {
  ScreenVertex middle = projected(at, grid_.width, grid_.height);
  if (middle.outside != 0) return;
  middle.depth = std::clamp(middle.depth - static_cast<float>(line.lift), 0.0F, 1.0F);
  const double radius = line.dots / 2 * grid_.per_pixel * kSubPixels;
  constexpr int kSides = 12;
  const auto rim = [&](int n) {
    const double angle = 2 * std::numbers::pi * n / kSides;
    ScreenVertex v = middle;
    v.x += static_cast<std::int32_t>(std::lround(radius * std::cos(angle)));
    v.y += static_cast<std::int32_t>(std::lround(radius * std::sin(angle)));
    return v;
  };
  // Pairs of slices, as a ribbon is two triangles.
  for (int n = 0; n < kSides; n += 2) ribbons_.push_back({{middle, rim(n), rim(n + 1), rim(n + 2)}, id});
}

void PreparedScene::rasterize_into(VisibilityBuffer& window) const {
  for (const Mesh& mesh : meshes_) {
    rasterize(view_projection_, mesh.source->positions, mesh.vertices, mesh.source->triangles, mesh.first,
              window);
  }
  for (const Section& section : sections_) {
    if (!section.seen) continue;
    const SectionPlane& s = *section.source;
    const auto corner = [&](double row, double column) {
      return transformed(view_projection_, s.origin + s.along_rows * row + s.along_columns * column);
    };
    const Vec4 a = corner(-0.5, -0.5);
    const Vec4 c = corner(s.rows - 0.5, s.columns - 0.5);
    rasterize_clip(a, corner(s.rows - 0.5, -0.5), c, section.first, window);
    rasterize_clip(a, c, corner(-0.5, s.columns - 0.5), section.first, window);
  }
  for (const Ribbon& ribbon : ribbons_) {
    rasterize_screen(ribbon.corners[0], ribbon.corners[1], ribbon.corners[2], ribbon.id, window);
    rasterize_screen(ribbon.corners[0], ribbon.corners[2], ribbon.corners[3], ribbon.id, window);
  }
}

Rgba PreparedScene::colour_at(PrimitiveId id, int x, int y) const {
  if (id >= first_line_) return line_colours_[id - first_line_];
  if (!sections_.empty() && id >= sections_.front().first)
    return section_colour(sections_[id - sections_.front().first], x, y);
  const auto after = std::upper_bound(meshes_.begin(), meshes_.end(), id,
                                      [](PrimitiveId at, const Mesh& m) { return at < m.first; });
  const Mesh& mesh = *(after - 1);
  return mesh_colour(mesh, id - mesh.first, x, y);
}

Rgba PreparedScene::mesh_colour(const Mesh& mesh, std::size_t face, int x, int y) const {
  Rgba colour = mesh.shades[face];
  if (!mesh.source->face_hatched.empty() && mesh.source->face_hatched[face] != 0) {
    // Stripes in the picture's plane, 3 of 8 pixels.
    const int stripe = ((x + y) / grid_.per_pixel) % 8;
    if (stripe < 3) colour = scaled(colour, 0.62);
  }
  if (mesh.edge_shade.empty() || mesh.edge_shade[face] <= 0) return colour;
  const TriangleIndices& t = mesh.source->triangles[face];
  const double px = (x + 0.5) * kSubPixels;
  const double py = (y + 0.5) * kSubPixels;
  double nearest = INFINITY;
  for (std::size_t n = 0; n < 3; ++n) {
    const ScreenVertex& a = mesh.vertices[static_cast<std::size_t>(t[n])];
    const ScreenVertex& b = mesh.vertices[static_cast<std::size_t>(t[(n + 1) % 3])];
    nearest = std::min(nearest, std::abs(twice_area(a, b, px, py)) / std::max(edge_length(a, b), 1e-9));
  }
  return nearest < 0.5 * grid_.per_pixel ? scaled(colour, 1 - static_cast<double>(mesh.edge_shade[face]))
                                         : colour;
}

PreparedScene::Texel PreparedScene::texel_at(const Section& section, double x, double y) {
  const auto at = [&](double sx, double sy) {
    const std::array<double, 9>& m = section.texel_of;
    const double w = m[6] * sx + m[7] * sy + m[8];
    return std::array<double, 2>{(m[0] * sx + m[1] * sy + m[2]) / w, (m[3] * sx + m[4] * sy + m[5]) / w};
  };
  const std::array<double, 2> here = at(x, y);
  const std::array<double, 2> right = at(x + 1, y);
  const std::array<double, 2> below = at(x, y + 1);
  return {here[0], here[1], std::max(std::abs(right[0] - here[0]), std::abs(below[0] - here[0])),
          std::max(std::abs(right[1] - here[1]), std::abs(below[1] - here[1]))};
}

Rgba PreparedScene::section_colour(const Section& section, int x, int y) const {
  const Texel texel = texel_at(section, x + 0.5, y + 0.5);
  const SectionPlane& s = *section.source;
  return s.colours->colour_of(
      section_value(s, texel.row, texel.column, texel.row_step, texel.column_step, section.squares), s.range);
}

}  // namespace footwall::render
