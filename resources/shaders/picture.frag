#version 450 core
// A finished picture with its depths, into the scene's depths.
in vec2 uv;
uniform sampler2D colours;
uniform sampler2D depths;
uniform vec4 part;  // of the picture, from its lower left corner: x, y, width, height
out vec4 colour;

void main() {
  vec2 at = part.xy + uv * part.zw;
  at.y = 1.0 - at.y;  // row 0 is on top
  float depth = texture(depths, at).r;
  if (depth >= 1.0) discard;
  gl_FragDepth = depth;
  colour = vec4(texture(colours, at).rgb, 1.0);
}
