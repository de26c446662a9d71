// About how many triangles a wave will keep of a brick, before any are made: what work is shared by.
//
// Three things decide it. How many are made is known from the samples' signs: eight for nine edges that the
// surface cuts. How many of them meet a pixel's centre depends on how wide and how high they come out in the
// picture: next to an outline the surface is seen edge on, and where that runs along rows or columns of
// pixels, most fall between two centres. How many lie before what earlier waves drew is asked where the
// surface cuts the edges, since most of a part's box is empty.
#pragma once
#include <array>
#include <optional>

#include "engine/isosurface/extract.h"
#include "engine/isosurface/visible/detail/met_triangles.h"
#include "engine/isosurface/visible/passes.h"

namespace footwall::isosurface::detail {

class ExpectedTriangles {
 public:
  // earlier: there are waves before; their depths have to stay.
  ExpectedTriangles(const VisibleRequest& request, const EarlierWaves& earlier);

  // What a triangle counts.
  static constexpr std::int64_t kTriangle = 16;
  // Of the chosen parts, which have cells. brick: its place among the bricks of the volume; the field holds
  // the samples of its cells.
  std::int64_t of(const Field& field, const survey::Index& brick, BrickParts chosen) const;

 private:
  // Pixels along rows and along columns, and window depth, all times the last.
  using OnScreen = std::array<float, 4>;
  // Pixels along rows, and along columns, for a cell along each axis.
  using Slopes = std::array<std::array<float, 3>, 2>;
  // Of the surface in one part.
  struct Part;

  // None where the eye is.
  std::optional<Slopes> slopes_at(const OnScreen& point) const;
  static float share_met(const Part& part, const Slopes& slopes);
  // around: of the depths' levels, one whose blocks are about half as large as a cell.
  int points_seen(const Part& part, const OnScreen& corner, std::size_t around) const;
  int times_seen(const OnScreen& point, std::size_t around) const;
  OnScreen moved(const OnScreen& from, float i, float j, float k) const;

  float isovalue_;
  EarlierWaves earlier_;
  std::array<OnScreen, 3> steps_{};  // by one cell along each axis
  std::array<double, 4> first_{};    // sample of the volume
};

}  // namespace footwall::isosurface::detail
