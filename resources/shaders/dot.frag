#version 450 core
in vec4 fill_shade;
in vec4 rim_shade;
in vec2 off;
flat in float radius;
uniform float pixel;
out vec4 colour;

void main() {
  float away = length(off);
  float cover = clamp(radius + 0.5 - away, 0.0, 1.0);
  if (cover <= 0.0) discard;
  float inside = clamp(radius - 1.2 * pixel + 0.5 - away, 0.0, 1.0);
  vec4 shade = mix(rim_shade, fill_shade, inside);
  colour = vec4(shade.rgb, shade.a * cover);
}
