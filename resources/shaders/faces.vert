#version 450 core
// Corners of a fault's faces; heights are multiplied here, so that exaggeration needs no new buffers.
layout(location = 0) in vec3 position;
uniform mat4 view_projection;
uniform float heights;
out vec3 place;

void main() {
  place = vec3(position.xy, position.z * heights);
  gl_Position = view_projection * vec4(place, 1.0);
}
