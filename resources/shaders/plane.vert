#version 450 core
// A section plane: four corners.
uniform mat4 view_projection;
uniform vec3 origin;
uniform vec3 across;  // the whole width
uniform vec3 down;
out vec2 uv;

void main() {
  uv = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = view_projection * vec4(origin + across * uv.x + down * uv.y, 1.0);
}
