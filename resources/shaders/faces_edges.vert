#version 450 core
// As faces.vert, each corner by itself: a fragment then knows how far it is from the face's edges.
layout(std430, binding = 1) readonly buffer Positions { float positions[]; };
layout(std430, binding = 2) readonly buffer Corners { uint corners[]; };
uniform mat4 view_projection;
uniform float heights;
out vec3 place;
out vec3 from_edges;

void main() {
  uint v = 3u * corners[gl_VertexID];
  place = vec3(positions[v], positions[v + 1u], positions[v + 2u] * heights);
  int corner = gl_VertexID % 3;
  from_edges = vec3(corner == 0, corner == 1, corner == 2);
  gl_Position = view_projection * vec4(place, 1.0);
}
