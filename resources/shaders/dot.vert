#version 450 core
// A round node of constant size in the picture.
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 fill;
layout(location = 2) in vec4 rim;
layout(location = 3) in float diameter;  // pixels
uniform mat4 view_projection;
uniform float heights;
uniform vec2 size;
uniform float pixel;
uniform float lift;
out vec4 fill_shade;
out vec4 rim_shade;
out vec2 off;
flat out float radius;

void main() {
  vec4 p = view_projection * vec4(position.xy, position.z * heights, 1.0);
  radius = 0.5 * diameter * pixel;
  fill_shade = fill;
  rim_shade = rim;
  off = (vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0) * (radius + 1.0);
  if (p.z + p.w <= 0.0) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  p.z -= lift * (p.w - p.z);
  p.xy += off / size * 2.0 * p.w;
  gl_Position = p;
}
