#include "ui/scene3d/gl.h"

#include <QFile>
#include <algorithm>

#include "storage/base/error.h"

namespace footwall::ui {
namespace {

QByteArray source_of(const QString& name) {
  QFile file(QStringLiteral(":/footwall/shaders/") + name);
  if (!file.open(QIODevice::ReadOnly)) throw Error(ErrorCode::kInternal, "no shader " + name.toStdString());
  return file.readAll();
}

GLuint compiled(Gl& gl, GLenum kind, const QString& name, const QByteArray& header) {
  const QByteArray source = header + source_of(name);
  const char* text = source.constData();
  const GLuint shader = gl.glCreateShader(kind);
  gl.glShaderSource(shader, 1, &text, nullptr);
  gl.glCompileShader(shader);
  GLint good = GL_FALSE;
  gl.glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good == GL_TRUE) return shader;
  std::array<char, 2000> words{};
  gl.glGetShaderInfoLog(shader, static_cast<GLsizei>(words.size()), nullptr, words.data());
  gl.glDeleteShader(shader);
  throw Error(ErrorCode::kInternal, "shader " + name.toStdString() + ": " + words.data(),
              "update the graphics driver, or start with LIBGL_ALWAYS_SOFTWARE=1");
}

}  // namespace

void GlBuffer::set(Gl& gl, std::span<const std::byte> bytes) {
  if (name_ == 0) gl.glCreateBuffers(1, &name_);
  if (bytes.size() > room_ || bytes.size() < room_ / 4) {
    room_ = bytes.size();
    gl.glNamedBufferData(name_, static_cast<GLsizeiptr>(room_), bytes.data(), GL_DYNAMIC_DRAW);
  } else if (!bytes.empty()) {
    gl.glNamedBufferSubData(name_, 0, static_cast<GLsizeiptr>(bytes.size()), bytes.data());
  }
}

void GlBuffer::release(Gl& gl) {
  if (name_ != 0) gl.glDeleteBuffers(1, &name_);
  *this = {};
}

void GlProgram::build(Gl& gl, const QString& vertex, const QString& fragment, const QByteArray& header) {
  const GLuint first = compiled(gl, GL_VERTEX_SHADER, vertex, {});
  const GLuint second = compiled(gl, GL_FRAGMENT_SHADER, fragment, header);
  name_ = gl.glCreateProgram();
  gl.glAttachShader(name_, first);
  gl.glAttachShader(name_, second);
  gl.glLinkProgram(name_);
  gl.glDeleteShader(first);
  gl.glDeleteShader(second);
  GLint good = GL_FALSE;
  gl.glGetProgramiv(name_, GL_LINK_STATUS, &good);
  if (good == GL_TRUE) return;
  std::array<char, 2000> words{};
  gl.glGetProgramInfoLog(name_, static_cast<GLsizei>(words.size()), nullptr, words.data());
  throw Error(ErrorCode::kInternal, "shader " + fragment.toStdString() + ": " + words.data());
}

void GlProgram::release(Gl& gl) {
  if (name_ != 0) gl.glDeleteProgram(name_);
  *this = {};
}

GLint GlProgram::place_for(Gl& gl, const char* uniform, std::span<const std::byte> value) {
  auto found = uniforms_.find(std::string_view(uniform));
  if (found == uniforms_.end()) {
    found = uniforms_.try_emplace(uniform).first;
    found->second.place = gl.glGetUniformLocation(name_, uniform);
  }
  Uniform& known = found->second;
  if (known.size == value.size() && std::ranges::equal(value, std::span(known.value).first(value.size())))
    return -1;
  known.size = value.size();
  std::ranges::copy(value, known.value.begin());
  return known.place;
}

void GlProgram::set(Gl& gl, const char* uniform, int value) {
  const GLint place = place_for(gl, uniform, std::as_bytes(std::span(&value, 1)));
  if (place >= 0) gl.glProgramUniform1i(name_, place, value);
}
void GlProgram::set(Gl& gl, const char* uniform, float value) {
  const GLint place = place_for(gl, uniform, std::as_bytes(std::span(&value, 1)));
  if (place >= 0) gl.glProgramUniform1f(name_, place, value);
}
void GlProgram::set(Gl& gl, const char* uniform, std::array<float, 2> value) {
  const GLint place = place_for(gl, uniform, std::as_bytes(std::span(value)));
  if (place >= 0) gl.glProgramUniform2fv(name_, place, 1, value.data());
}
void GlProgram::set(Gl& gl, const char* uniform, std::array<float, 3> value) {
  const GLint place = place_for(gl, uniform, std::as_bytes(std::span(value)));
  if (place >= 0) gl.glProgramUniform3fv(name_, place, 1, value.data());
}
void GlProgram::set(Gl& gl, const char* uniform, std::array<float, 4> value) {
  const GLint place = place_for(gl, uniform, std::as_bytes(std::span(value)));
  if (place >= 0) gl.glProgramUniform4fv(name_, place, 1, value.data());
}
void GlProgram::set(Gl& gl, const char* uniform, const render::Vec3& value) {
  set(gl, uniform,
      std::array{static_cast<float>(value.x), static_cast<float>(value.y), static_cast<float>(value.z)});
}
void GlProgram::set(Gl& gl, const char* uniform, const render::Matrix4& value) {
  std::array<float, 16> floats{};
  for (std::size_t n = 0; n < 16; ++n) floats[n] = static_cast<float>(value[n]);
  const GLint place = place_for(gl, uniform, std::as_bytes(std::span(floats)));
  if (place >= 0) gl.glProgramUniformMatrix4fv(name_, place, 1, GL_TRUE, floats.data());
}

void GlTarget::resize(Gl& gl, int width, int height, int samples) {
  if (name_ != 0 && width == width_ && height == height_ && samples == samples_) return;
  release(gl);
  width_ = width;
  height_ = height;
  samples_ = samples;
  gl.glCreateFramebuffers(1, &name_);
  gl.glCreateRenderbuffers(1, &colours_);
  gl.glCreateRenderbuffers(1, &depths_);
  const int count = samples > 1 ? samples : 0;
  gl.glNamedRenderbufferStorageMultisample(colours_, count, GL_RGBA8, width, height);
  gl.glNamedRenderbufferStorageMultisample(depths_, count, GL_DEPTH_COMPONENT32F, width, height);
  gl.glNamedFramebufferRenderbuffer(name_, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colours_);
  gl.glNamedFramebufferRenderbuffer(name_, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depths_);
  if (gl.glCheckNamedFramebufferStatus(name_, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw Error(ErrorCode::kMemory, "a picture of this size cannot be drawn into");
  }
}

void GlTarget::release(Gl& gl) {
  if (name_ != 0) gl.glDeleteFramebuffers(1, &name_);
  if (colours_ != 0) gl.glDeleteRenderbuffers(1, &colours_);
  if (depths_ != 0) gl.glDeleteRenderbuffers(1, &depths_);
  *this = {};
}

}  // namespace footwall::ui
