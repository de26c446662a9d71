// What a surface is like as read from a file, and how it is cut into pieces that a mesh can hold.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "storage/survey/surface.h"

namespace footwall::mesh {

struct SurfaceFacts {
  std::int64_t vertices = 0;  // as listed, used by a face or not
  std::int64_t faces = 0;
  std::int64_t components = 0;          // of faces that share an edge
  std::int64_t boundary_loops = 0;      // of edges with one face; a loop is walked within its fan at bow-ties
  std::int64_t euler = 0;               // used vertices - edges + faces
  double area = 0;                      // in squared units of the positions, z taken as it is
  std::int64_t nonmanifold_edges = 0;   // with more than two faces
  std::int64_t bow_tie_vertices = 0;    // whose faces form more than one fan
  std::int64_t inconsistent_edges = 0;  // with two faces that run them in the same direction
  std::int64_t degenerate_faces = 0;    // that name a vertex twice
  friend bool operator==(const SurfaceFacts&, const SurfaceFacts&) = default;
};

// Throws Error kFormat if a triangle names a vertex that is not there, or a position it uses is not finite.
SurfaceFacts surface_facts(const survey::Surface& surface);

// Which faces must be turned (two of their vertices swapped) so that neighbours across an edge of two faces
// agree: in every piece of faces joined by such edges the fewer ones; where both are as many, those that
// differ from the piece's first face. A piece that cannot be oriented, as a Moebius strip, stays as it is.
std::vector<bool> faces_to_turn(const survey::Surface& surface);

// The same faces in the same order, over vertices copied so that the result is manifold and consistently
// oriented: cut along edges with more than two faces or with two that disagree, and apart at bow-ties. No
// face is dropped or turned; a degenerate face becomes a piece of its own with three vertices of its own.
struct CutSurface {
  std::vector<std::array<std::int32_t, 3>> faces;
  std::vector<std::int32_t> source_vertex;  // for each vertex, the surface's vertex that it copies
  std::int64_t cut_edges = 0;               // edges of the surface that were cut
  std::int64_t copied_vertices = 0;         // vertices added
  std::int64_t pieces = 0;
};
CutSurface cut_into_manifold(const survey::Surface& surface);

}  // namespace footwall::mesh
