// The picture of a whole isosurface, made without looking for what can be seen: what pictures of only the
// visible part have to equal, and how little they could have extracted.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/isosurface/field.h"
#include "engine/render/camera.h"
#include "engine/render/colour.h"
#include "engine/render/lit_surface.h"
#include "engine/render/visibility.h"

namespace footwall::verify {

struct SurfacePicture {
  int width = 0;
  int height = 0;
  std::vector<float> depths;  // 1 where nothing is seen
  std::vector<render::Rgba> colours;
  std::int64_t triangles = 0;         // of the whole isosurface
  std::int64_t owning_triangles = 0;  // those that own a pixel
  std::int64_t pixels = 0;            // that show something
};

// Every triangle is drawn, one after the other; numbers are those of the whole surface.
SurfacePicture whole_surface_picture(const isosurface::Field& volume, float isovalue,
                                     const render::Camera& camera, const render::Placement& placement,
                                     render::Rgba colour, int width, int height);

// The first pixel that differs, in words; "" where depths and colours agree bit for bit. `window` is a whole
// picture.
std::string difference(const SurfacePicture& whole, const render::VisibilityBuffer& window,
                       std::span<const render::Rgba> colours);
// How many pixels of the finished picture show what they show in the end.
std::int64_t final_pixels(const SurfacePicture& whole, const render::VisibilityBuffer& window);

}  // namespace footwall::verify
