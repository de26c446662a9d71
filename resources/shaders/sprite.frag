#version 450 core
in vec2 texel;
uniform sampler2D atlas;  // premultiplied
out vec4 colour;

void main() {
  colour = texelFetch(atlas, ivec2(texel), 0);
  if (colour.a == 0.0) discard;
}
