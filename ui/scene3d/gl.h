// OpenGL objects that go with their owner. All need the context current, when made, used and released.
#pragma once
#include <QOpenGLFunctions_4_5_Core>
#include <QString>
#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <string>

#include "engine/render/vector.h"

namespace footwall::ui {

using Gl = QOpenGLFunctions_4_5_Core;

// A buffer that grows when it must and is written in place else.
class GlBuffer {
 public:
  // Takes the bytes; the former content is gone.
  void set(Gl& gl, std::span<const std::byte> bytes);
  template <class T>
  void set(Gl& gl, const std::vector<T>& values) {
    set(gl, std::as_bytes(std::span(values)));
  }
  void release(Gl& gl);
  GLuint name() const { return name_; }

 private:
  GLuint name_ = 0;
  std::size_t room_ = 0;
};

class GlProgram {
 public:
  // Sources from the resources' folder shaders; header is put before the fragment shader. Throws Error
  // kInternal with the compiler's words.
  void build(Gl& gl, const QString& vertex, const QString& fragment, const QByteArray& header = {});
  void release(Gl& gl);
  void use(Gl& gl) const { gl.glUseProgram(name_); }
  void set(Gl& gl, const char* uniform, int value);
  void set(Gl& gl, const char* uniform, float value);
  void set(Gl& gl, const char* uniform, std::array<float, 2> value);
  void set(Gl& gl, const char* uniform, std::array<float, 3> value);
  void set(Gl& gl, const char* uniform, std::array<float, 4> value);
  void set(Gl& gl, const char* uniform, const render::Matrix4& value);
  void set(Gl& gl, const char* uniform, const render::Vec3& value);

 private:
  struct Uniform {
    GLint place = -1;
    std::size_t size = 0;  // of the value last set, in bytes
    std::array<std::byte, sizeof(float) * 16> value{};
  };
  // Where the value goes; negative where it is there already, or the program has no such uniform. Setting one
  // anew makes the driver prepare its constants again, and most are the same from draw to draw.
  GLint place_for(Gl& gl, const char* uniform, std::span<const std::byte> value);
  GLuint name_ = 0;
  std::map<std::string, Uniform, std::less<>> uniforms_;
};

// RGBA8 and 32-bit depth of the same size, with one or several samples per pixel.
class GlTarget {
 public:
  void resize(Gl& gl, int width, int height, int samples);
  void release(Gl& gl);
  GLuint name() const { return name_; }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  GLuint name_ = 0;
  GLuint colours_ = 0;
  GLuint depths_ = 0;
  int width_ = 0, height_ = 0, samples_ = 0;
};

}  // namespace footwall::ui
