// Each face flat in its colour, under a headlight with soft ambient; back faces a shade darker.
in vec3 place;
#ifdef EDGES
in vec3 from_edges;
#endif
layout(std430, binding = 0) readonly buffer Faces { vec2 faces[]; };  // value, 1 stale + 2 hatched
layout(std430, binding = 3) readonly buffer Chosen { uint chosen[]; };
uniform int first_face;
uniform bool coarse;  // the face's number is chosen[]
uniform bool plain;   // no values
uniform bool all_hatched;
uniform vec3 plain_colour;
uniform vec3 undefined_colour;
uniform vec2 range;
uniform sampler2D colours;
uniform vec3 eye;
uniform vec3 forward;
uniform vec3 lamp;
uniform bool perspective;
uniform float pixel;  // device pixels of one pixel
out vec4 colour;

void main() {
  int face = first_face + gl_PrimitiveID;
  if (coarse) face = int(chosen[face]);
  vec3 base = plain_colour;
  bool hatched = false;
  if (!plain) {
    float value = faces[face].x;
    int state = int(faces[face].y);
    hatched = all_hatched || (state & 2) != 0;
    if (isnan(value)) {
      base = undefined_colour;
    } else {
      float share = range.y > range.x ? clamp((value - range.x) / (range.y - range.x), 0.0, 1.0) : 0.5;
      base = texture(colours, vec2((share * 255.0 + 0.5) / 256.0, 0.5)).rgb;
    }
    if ((state & 1) != 0) base = mix(base, vec3(dot(base, vec3(0.3, 0.59, 0.11))), 0.45);
  }
  vec3 across = cross(dFdx(place), dFdy(place));
  float size = length(across);
  float light = 0.68;
  if (size > 0.0) {
    vec3 normal = across / size;
    vec3 to_eye = perspective ? normalize(eye - place) : -forward;
    float facing = dot(normal, to_eye);
    if (facing < 0.0) normal = -normal;
    light += 0.28 * abs(facing) + 0.20 * max(0.0, dot(normal, lamp));
    if (!gl_FrontFacing) light *= 0.90;
  }
  if (hatched && mod(gl_FragCoord.x + gl_FragCoord.y, 8.0 * pixel) < 3.0 * pixel) light *= 0.62;
#ifdef EDGES
  vec3 width = fwidth(from_edges);
  vec3 steps = from_edges / max(width, vec3(1e-6));  // device pixels from each edge
  float nearest = min(min(steps.x, steps.y), steps.z);
  float height = 1.0 / max(max(width.x, width.y), max(width.z, 1e-6));  // of the triangle
  light *= 1.0 - 0.45 * (1.0 - smoothstep(0.5 * pixel, 1.2 * pixel, nearest)) *
                     smoothstep(4.0 * pixel, 10.0 * pixel, height);
#endif
  colour = vec4(min(base * light, vec3(1.0)), 1.0);
}
