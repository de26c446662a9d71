#version 450 core
// Corners of an isosurface; heights are multiplied here, so that exaggeration needs no new buffers.
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 flat_normal;
uniform mat4 view_projection;
uniform float heights;
out vec3 place;
out vec3 normal;

void main() {
  place = vec3(position.xy, position.z * heights);
  normal = vec3(flat_normal.xy, flat_normal.z / heights);
  gl_Position = view_projection * vec4(place, 1.0);
}
