#version 450 core
// A picture seen from where the camera has gone meanwhile: each of its pixels as a point.
uniform sampler2D colours;
uniform sampler2D depths;
uniform mat4 from_picture;  // its clip space -> this camera's
uniform int step;           // pixels between points, each way
uniform float point;        // device pixels
out vec3 shade;

void main() {
  ivec2 size = textureSize(depths, 0);
  int columns = size.x / step;
  ivec2 at = min(ivec2(gl_VertexID % columns, gl_VertexID / columns) * step + step / 2, size - 1);
  float depth = texelFetch(depths, at, 0).r;
  gl_PointSize = point;
  if (depth >= 1.0) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  shade = texelFetch(colours, at, 0).rgb;
  vec2 middle = (vec2(at) + 0.5) / vec2(size);
  gl_Position = from_picture * vec4(middle.x * 2.0 - 1.0, 1.0 - middle.y * 2.0, depth * 2.0 - 1.0, 1.0);
}
