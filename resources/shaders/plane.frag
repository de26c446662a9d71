#version 450 core
// Samples through a colour map; what is null or outside of the volume is left out.
in vec2 uv;
uniform sampler2D samples;  // value where there is one, 1 where there is one
uniform sampler2D colours;
uniform vec2 range;
uniform bool quick;   // the nearest sample, whatever its size
uniform int smoothed;  // 1 yes, 0 no, -1 where a sample covers at most 6 pixels
uniform float pixel;
out vec4 colour;

void main() {
  vec2 size = vec2(textureSize(samples, 0));
  vec2 at = uv * size;
  vec2 step = fwidth(at) * pixel;  // samples that one pixel passes over
  bool nearest = quick || smoothed == 0 || (smoothed < 0 && max(step.x, step.y) < 1.0 / 6.0);
  if (!quick && max(step.x, step.y) > 1.0) nearest = false;
  vec2 sampled = nearest ? texelFetch(samples, clamp(ivec2(at), ivec2(0), ivec2(size) - 1), 0).rg
                         : texture(samples, uv).rg;
  if (sampled.g < 0.5) discard;
  float value = sampled.r / sampled.g;
  float share = range.y > range.x ? clamp((value - range.x) / (range.y - range.x), 0.0, 1.0) : 0.5;
  colour = vec4(texture(colours, vec2((share * 255.0 + 0.5) / 256.0, 0.5)).rgb, 1.0);
}
