#version 450 core
in vec2 uv;
uniform vec3 top;
uniform vec3 bottom;
uniform vec2 part;  // of the whole picture's height: the target's lower end and its extent
out vec4 colour;

void main() {
  colour = vec4(mix(bottom, top, part.x + uv.y * part.y), 1.0);
}
