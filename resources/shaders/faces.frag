// Each face flat in its colour, under a headlight with soft ambient; back faces a shade darker. With VOXELS the
// samples that the face cuts, in the colours that they have in sections, without light.
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

vec3 colour_of(float value) {
  float share = range.y > range.x ? clamp((value - range.x) / (range.y - range.x), 0.0, 1.0) : 0.5;
  return texture(colours, vec2((share * 255.0 + 0.5) / 256.0, 0.5)).rgb;
}

#ifdef VOXELS
// Bricks of 8 x 8 x 8 cells around the surface (ui/model/voxel_bricks.h).
layout(std430, binding = 4) readonly buffer Table { uvec2 table[]; };
layout(std430, binding = 5) readonly buffer Samples { float samples[]; };
uniform int table_bits;  // 2^ as many slots
uniform int longest;  // slots to look at for a key
uniform mat4 to_samples;
uniform vec3 size;  // samples along each axis
uniform vec3 lowest, highest;  // of the volume's voxels, in samples
uniform vec3 bricks;  // along each axis
uniform int smoothed;  // 1 yes, 0 no, -1 where a sample covers at most 6 pixels
uniform bool quick;

// Of the brick; negative: none was read here.
int first_sample(uvec3 brick) {
  uint key = (brick.x * uint(bricks.y) + brick.y) * uint(bricks.z) + brick.z;
  uint last = (1u << table_bits) - 1u;
  uint slot = (key * 2654435769u) >> (32 - table_bits);
  int first = -1;
  for (int tries = 0; tries < longest && first < 0; ++tries) {
    uvec2 entry = table[slot];
    if (entry.x == key) first = int(entry.y) * 729;
    slot = (slot + 1u) & last;
  }
  return first;
}

float sample_at(int first, ivec3 at) {
  return samples[first + (at.x * 9 + at.y) * 9 + at.z];
}

vec3 voxel_colour() {
  vec3 at = (to_samples * vec4(place, 1.0)).xyz;
  vec3 step = fwidth(at);
  float widest = max(max(step.x, step.y), step.z) * pixel;
  bool nearest = quick || smoothed == 0 || (smoothed < 0 && widest < 1.0 / 6.0);
  if (any(lessThan(at, lowest)) || any(greaterThan(at, highest))) return undefined_colour;
  at = clamp(at, vec3(0.0), size - 1.0);
  vec3 brick = min(floor(floor(at) / 8.0), bricks - 1.0);
  int first = first_sample(uvec3(brick));
  if (first < 0) return plain_colour;
  vec3 within = at - 8.0 * brick;
  if (nearest) {
    float value = sample_at(first, ivec3(floor(within + 0.5)));
    return isnan(value) ? undefined_colour : colour_of(value);
  }
  // Of the eight samples around, those that are not null.
  vec3 low = min(floor(within), vec3(7.0));
  vec3 part = within - low;
  float sum = 0.0, weights = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    vec3 off = vec3(corner & 1, (corner >> 1) & 1, corner >> 2);
    vec3 near = mix(1.0 - part, part, off);
    float weight = near.x * near.y * near.z;
    float value = sample_at(first, ivec3(low + off));
    if (weight > 0.0 && !isnan(value)) {
      sum += weight * value;
      weights += weight;
    }
  }
  return weights < 0.5 ? undefined_colour : colour_of(sum / weights);
}
#endif

void main() {
  bool hatched = false;
  float light = 1.0;
#ifdef VOXELS
  vec3 base = voxel_colour();
#else
  int face = first_face + gl_PrimitiveID;
  if (coarse) face = int(chosen[face]);
  vec3 base = plain_colour;
  if (!plain) {
    float value = faces[face].x;
    int state = int(faces[face].y);
    hatched = all_hatched || (state & 2) != 0;
    base = isnan(value) ? undefined_colour : colour_of(value);
    if ((state & 1) != 0) base = mix(base, vec3(dot(base, vec3(0.3, 0.59, 0.11))), 0.45);
  }
  vec3 across = cross(dFdx(place), dFdy(place));
  float size = length(across);
  light = 0.68;
  if (size > 0.0) {
    vec3 normal = across / size;
    vec3 to_eye = perspective ? normalize(eye - place) : -forward;
    float facing = dot(normal, to_eye);
    if (facing < 0.0) normal = -normal;
    light += 0.28 * abs(facing) + 0.20 * max(0.0, dot(normal, lamp));
    if (!gl_FrontFacing) light *= 0.90;
  }
  if (hatched && mod(gl_FragCoord.x + gl_FragCoord.y, 8.0 * pixel) < 3.0 * pixel) light *= 0.62;
#endif
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
