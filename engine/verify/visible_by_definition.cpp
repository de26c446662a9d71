#include "engine/verify/visible_by_definition.h"

#include <fmt/format.h>

#include <bit>

#include "engine/isosurface/extract.h"
#include "engine/render/surface_frame.h"

namespace footwall::verify {

SurfacePicture whole_surface_picture(const isosurface::Field& volume, float isovalue,
                                     const render::Camera& camera, const render::Placement& placement,
                                     render::Rgba colour, int width, int height) {
  isosurface::Surface surface;
  isosurface::extract(volume, isovalue, {}, surface);
  std::vector<render::Vec3f> positions;
  std::vector<render::Vec3f> normals;
  std::vector<render::TriangleIndices> triangles;
  for (const isosurface::Point& p : surface.positions.all()) positions.emplace_back(p.i, p.j, p.k);
  for (const isosurface::Point& n : surface.normals.all()) normals.emplace_back(n.i, n.j, n.k);
  for (const isosurface::Triangle& t : surface.triangles.all()) {
    triangles.push_back(
        {static_cast<std::int32_t>(t[0]), static_cast<std::int32_t>(t[1]), static_cast<std::int32_t>(t[2])});
  }
  const render::IdRun run{0, 0};
  const render::LitSurface lit{colour, placement, positions, normals, triangles, std::span(&run, 1)};

  render::VisibilityBuffer window(width, height);
  const render::Matrix4 to_clip = placement.then(camera.view_projection);
  const auto clip = [&](std::int32_t v) {
    return render::transformed(to_clip, render::Vec3(positions[static_cast<std::size_t>(v)]));
  };
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    render::rasterize_clip(clip(triangles[t][0]), clip(triangles[t][1]), clip(triangles[t][2]),
                           static_cast<render::PrimitiveId>(t), window);
  }
  SurfacePicture picture{width, height, {}, std::vector<render::Rgba>(window.pixels().size()), 0, 0, 0};
  render::SurfaceFrame frame;
  frame.project(std::span(&lit, 1), camera, width, height, 1);
  frame.shade(window, picture.colours, 1);
  std::vector<bool> owns(triangles.size(), false);
  for (const render::Visible pixel : window.pixels()) {
    picture.depths.push_back(render::depth_of(pixel));
    if (pixel == render::kBackground) continue;
    ++picture.pixels;
    if (!owns[render::primitive_of(pixel)]) ++picture.owning_triangles;
    owns[render::primitive_of(pixel)] = true;
  }
  picture.triangles = static_cast<std::int64_t>(triangles.size());
  return picture;
}

std::string difference(const SurfacePicture& whole, const render::VisibilityBuffer& window,
                       std::span<const render::Rgba> colours) {
  if (window.width() != whole.width || window.height() != whole.height || window.rows() != whole.height ||
      colours.size() != whole.colours.size())
    return "the pictures have other sizes";
  for (std::size_t n = 0; n < colours.size(); ++n) {
    const float depth = render::depth_of(window.pixels()[n]);
    if (std::bit_cast<std::uint32_t>(depth) == std::bit_cast<std::uint32_t>(whole.depths[n]) &&
        colours[n] == whole.colours[n])
      continue;
    return fmt::format(
        "pixel {}, {}: depth {} and colour {:08x}, in the whole surface's picture {} and {:08x}",
        n % static_cast<std::size_t>(whole.width), n / static_cast<std::size_t>(whole.width), depth,
        colours[n], whole.depths[n], whole.colours[n]);
  }
  return "";
}

std::int64_t final_pixels(const SurfacePicture& whole, const render::VisibilityBuffer& window) {
  std::int64_t count = 0;
  for (std::size_t n = 0; n < whole.depths.size(); ++n) {
    const render::Visible pixel = window.pixels()[n];
    if (pixel != render::kBackground && render::depth_of(pixel) == whole.depths[n]) ++count;
  }
  return count;
}

}  // namespace footwall::verify
