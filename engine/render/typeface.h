// Text in pictures: DejaVu Sans, found through fontconfig and drawn by FreeType.
#pragma once
#include <memory>
#include <string_view>

#include "engine/render/canvas.h"

namespace footwall::render {

// Not to be shared between threads.
class Typeface {
 public:
  // Null if the machine has no scalable font that can stand in for DejaVu Sans; says so in one warning per
  // call.
  static std::unique_ptr<Typeface> find();
  ~Typeface();
  Typeface(const Typeface&) = delete;
  Typeface& operator=(const Typeface&) = delete;

  // size: the em in pixels. text: UTF-8; bytes that are not become U+FFFD.
  double width(std::string_view text, double size, bool bold = false);
  // x: the left end; baseline: the line that letters stand on. halo: alpha 0 = none, else a soft rim behind
  // the letters.
  void draw(Canvas& canvas, double x, double baseline, std::string_view text, double size, Rgba colour,
            bool bold = false, Rgba halo = 0);

 private:
  struct Faces;
  explicit Typeface(std::unique_ptr<Faces> faces);
  std::unique_ptr<Faces> faces_;
};

}  // namespace footwall::render
