#version 450 core
// A small image that stands at a place in space, or at a place in the picture.
layout(location = 0) in vec3 anchor;  // scene; or pixels from the picture's upper left corner
layout(location = 1) in vec4 box;     // pixels from the anchor: left, top, width, height
layout(location = 2) in vec4 part;    // of the atlas, in texels: left, top, width, height
layout(location = 3) in float flat_on_picture;
uniform mat4 view_projection;
uniform vec2 size;    // of the target, device pixels
uniform vec2 corner;  // device pixels of the whole picture that lie left of and above the target
uniform float pixel;
uniform float lift;
out vec2 texel;

void main() {
  vec2 at = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  texel = part.xy + at * part.zw;
  vec2 off = (box.xy + at * box.zw) * pixel;
  if (flat_on_picture > 0.5) {
    vec2 p = floor(anchor.xy * pixel + off + 0.5) - corner;
    gl_Position = vec4(p.x / size.x * 2.0 - 1.0, 1.0 - p.y / size.y * 2.0, -1.0, 1.0);
    return;
  }
  vec4 p = view_projection * vec4(anchor, 1.0);
  if (p.z + p.w <= 0.0) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  vec2 middle = floor((p.xy / p.w * 0.5 + 0.5) * size + 0.5) + floor(vec2(off.x, -off.y) + 0.5);
  p.z -= lift * (p.w - p.z);
  gl_Position = vec4((middle / size * 2.0 - 1.0) * p.w, p.z, p.w);
}
