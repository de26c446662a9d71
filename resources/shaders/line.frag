#version 450 core
in vec4 shade;
in float off;
flat in float half_width;
out vec4 colour;

void main() {
  float cover = clamp(half_width + 0.5 - abs(off), 0.0, 1.0) * min(1.0, 2.0 * half_width + 0.2);
  if (cover <= 0.0) discard;
  colour = vec4(shade.rgb, shade.a * cover);
}
