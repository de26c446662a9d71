// Walks over a mesh's relations. All throw Error kInvalid for an id that is not there.
#pragma once
#include <vector>

#include "engine/mesh/mesh.h"

namespace footwall::mesh {

// The face on the other side of `edge`, kNone on the border.
FaceId across(const Mesh& mesh, FaceId face, EdgeId edge);
// The faces around a vertex, counter-clockwise; for a border vertex from border to border; none for a lone
// one.
std::vector<FaceId> faces_of(const Mesh& mesh, VertexId vertex);
// The same, behind what `fan` holds: no allocation where it has room.
void append_faces_of(const Mesh& mesh, VertexId vertex, std::vector<FaceId>& fan);
// The edges that end in a vertex, in the same order; a border vertex has one more of them than faces.
std::vector<EdgeId> edges_of(const Mesh& mesh, VertexId vertex);
// The edge between two vertices, kNone if there is none.
EdgeId edge_between(const Mesh& mesh, VertexId a, VertexId b);
// The border as closed loops of vertices, each with the faces to its left, starting at its smallest vertex;
// the loops in the order of these.
std::vector<std::vector<VertexId>> boundary_loops(const Mesh& mesh);
// The faces of each connected piece, ascending; the pieces in the order of their smallest face.
std::vector<std::vector<FaceId>> components(const Mesh& mesh);

}  // namespace footwall::mesh
