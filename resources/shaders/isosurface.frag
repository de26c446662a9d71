#version 450 core
// An isosurface in its own colour, under the light that faults have; from inside a shade darker.
in vec3 place;
in vec3 normal;
uniform vec3 own;
uniform vec3 eye;
uniform vec3 forward;
uniform vec3 lamp;
uniform bool perspective;
out vec4 colour;

void main() {
  float size = length(normal);
  float light = 0.68;
  if (size > 0.0) {
    vec3 across = normal / size;
    vec3 to_eye = perspective ? normalize(eye - place) : -forward;
    float facing = dot(across, to_eye);
    if (facing < 0.0) across = -across;
    light = 0.52 + 0.40 * abs(facing) + 0.22 * max(0.0, dot(across, lamp));
    if (facing < 0.0) light *= 0.90;
  }
  colour = vec4(min(own * light, vec3(1.0)), 1.0);
}
