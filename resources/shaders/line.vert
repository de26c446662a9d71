#version 450 core
// A segment as a ribbon of constant width in the picture, lifted a little towards the eye.
layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in vec4 tint;
layout(location = 3) in float width;  // pixels
uniform mat4 view_projection;
uniform float heights;
uniform vec2 size;  // device pixels
uniform float pixel;
uniform float lift;
out vec4 shade;
out float off;   // device pixels from the middle
flat out float half_width;

vec4 clip_of(vec3 p) { return view_projection * vec4(p.xy, p.z * heights, 1.0); }

void main() {
  vec4 a = clip_of(from);
  vec4 b = clip_of(to);
  shade = tint;
  half_width = 0.5 * width * pixel;
  float near_a = a.z + a.w;
  float near_b = b.z + b.w;
  if (near_a <= 0.0 && near_b <= 0.0) {
    off = 0.0;
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  if (near_a < 0.0) a = mix(a, b, near_a / (near_a - near_b) * 1.0001);
  if (near_b < 0.0) b = mix(b, a, near_b / (near_b - near_a) * 1.0001);
  vec2 pa = a.xy / a.w * 0.5 * size;
  vec2 pb = b.xy / b.w * 0.5 * size;
  vec2 along = pb - pa;
  float far = length(along);
  along = far > 1e-6 ? along / far : vec2(1.0, 0.0);
  float reach = half_width + 0.75;
  float side = (gl_VertexID & 1) == 0 ? -1.0 : 1.0;
  bool end = gl_VertexID > 1;
  off = side * reach;
  vec4 p = end ? b : a;
  vec2 shift = vec2(-along.y, along.x) * off + along * (end ? 0.5 : -0.5) * half_width;
  p.z -= lift * (p.w - p.z);
  p.xy += shift / size * 2.0 * p.w;
  gl_Position = p;
}
