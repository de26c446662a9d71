#include "engine/render/typeface.h"

#include <fontconfig/fontconfig.h>
#include <ft2build.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include "storage/base/log.h"

namespace footwall::render {
namespace {

// The file that fontconfig offers for DejaVu Sans; "" if it has none.
std::string font_file(bool bold) {
  FcConfig* config = FcInitLoadConfigAndFonts();
  if (config == nullptr) return {};
  FcPattern* wanted = FcPatternCreate();
  FcPatternAddString(wanted, FC_FAMILY, reinterpret_cast<const FcChar8*>("DejaVu Sans"));
  FcPatternAddInteger(wanted, FC_WEIGHT, bold ? FC_WEIGHT_BOLD : FC_WEIGHT_NORMAL);
  FcPatternAddBool(wanted, FC_SCALABLE, FcTrue);
  FcConfigSubstitute(config, wanted, FcMatchPattern);
  FcDefaultSubstitute(wanted);
  FcResult result = FcResultNoMatch;
  FcPattern* found = FcFontMatch(config, wanted, &result);
  std::string file;
  FcChar8* name = nullptr;
  if (found != nullptr && FcPatternGetString(found, FC_FILE, 0, &name) == FcResultMatch) {
    file = reinterpret_cast<const char*>(name);
  }
  if (found != nullptr) FcPatternDestroy(found);
  FcPatternDestroy(wanted);
  FcConfigDestroy(config);
  return file;
}

constexpr char32_t kReplacement = 0xfffd;

// The next character of UTF-8 text, which is taken off its front.
char32_t next_character(std::string_view& text) {
  const auto byte = [&](std::size_t n) { return static_cast<unsigned char>(text[n]); };
  const unsigned first = byte(0);
  const std::size_t size = first < 0x80          ? 1
                           : (first >> 5U) == 6  ? 2
                           : (first >> 4U) == 14 ? 3
                           : (first >> 3U) == 30 ? 4
                                                 : 0;
  if (size == 0 || size > text.size()) {
    text.remove_prefix(1);
    return kReplacement;
  }
  char32_t c = size == 1 ? first : first & (0x7fU >> size);
  for (std::size_t n = 1; n < size; ++n) {
    if ((byte(n) & 0xc0U) != 0x80) {
      text.remove_prefix(n);
      return kReplacement;
    }
    c = c << 6U | (byte(n) & 0x3fU);
  }
  text.remove_prefix(size);
  return c;
}

// How much of each pixel a line of text covers, 0..1.
struct Mask {
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;
  std::vector<float> coverage;

  Mask(int left_, int top_, int width_, int height_)
      : left(left_),
        top(top_),
        width(width_),
        height(height_),
        coverage(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)) {}
  float at(int x, int y) const {
    if (x < 0 || y < 0 || x >= width || y >= height) return 0;
    return coverage[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                    static_cast<std::size_t>(x)];
  }
  void add(int x, int y, float more) {
    if (x < 0 || y < 0 || x >= width || y >= height) return;
    float& here =
        coverage[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    here = std::min(1.0F, here + more);
  }
};

void paint(Canvas& canvas, const Mask& mask, Rgba colour) {
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) {
      if (mask.at(x, y) > 0) canvas.blend(mask.left + x, mask.top + y, colour, mask.at(x, y));
    }
  }
}

void paint_halo(Canvas& canvas, const Mask& mask, Rgba colour, double radius) {
  const int reach = static_cast<int>(std::ceil(radius));
  for (int y = -reach; y < mask.height + reach; ++y) {
    for (int x = -reach; x < mask.width + reach; ++x) {
      double most = 0;
      for (int dy = -reach; dy <= reach; ++dy) {
        for (int dx = -reach; dx <= reach; ++dx) {
          const double falloff = std::clamp(radius + 1 - std::hypot(dx, dy), 0.0, 1.0);
          most = std::max(most, falloff * static_cast<double>(mask.at(x + dx, y + dy)));
        }
      }
      if (most > 0) canvas.blend(mask.left + x, mask.top + y, colour, most);
    }
  }
}

}  // namespace

struct Typeface::Faces {
  FT_Library library = nullptr;
  FT_Face regular = nullptr;
  FT_Face bold = nullptr;

  ~Faces() {
    if (regular != nullptr) FT_Done_Face(regular);
    if (bold != nullptr) FT_Done_Face(bold);
    if (library != nullptr) FT_Done_FreeType(library);
  }
  FT_Face sized(double size, bool want_bold) {
    FT_Face face = want_bold && bold != nullptr ? bold : regular;
    const double pixels = std::clamp(size, 1.0, 500.0);
    FT_Set_Char_Size(face, 0, static_cast<FT_F26Dot6>(std::lround(pixels * 64)), 72, 72);
    return face;
  }
};

std::unique_ptr<Typeface> Typeface::find() {
  auto faces = std::make_unique<Faces>();
  if (FT_Init_FreeType(&faces->library) == 0) {
    const std::string regular = font_file(false);
    if (!regular.empty() && FT_New_Face(faces->library, regular.c_str(), 0, &faces->regular) == 0) {
      const std::string bold = font_file(true);
      if (bold.empty() || FT_New_Face(faces->library, bold.c_str(), 0, &faces->bold) != 0)
        faces->bold = nullptr;
      return std::unique_ptr<Typeface>(new Typeface(std::move(faces)));
    }
  }
  log::warn("no font was found, so the picture has no text; install the package fonts-dejavu-core");
  return nullptr;
}

Typeface::Typeface(std::unique_ptr<Faces> faces) : faces_(std::move(faces)) {}
Typeface::~Typeface() = default;

double Typeface::width(std::string_view text, double size, bool bold) {
  FT_Face face = faces_->sized(size, bold);
  double pen = 0;
  while (!text.empty()) {
    if (FT_Load_Char(face, next_character(text), FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP) != 0) continue;
    pen += static_cast<double>(face->glyph->linearHoriAdvance) / 65536;
  }
  return pen;
}

void Typeface::draw(Canvas& canvas, double x, double baseline, std::string_view text, double size,
                    Rgba colour, bool bold, Rgba halo) {
  const double wide = width(text, size, bold);
  FT_Face face = faces_->sized(size, bold);
  const int rim = 4;
  const int left = static_cast<int>(std::floor(x)) - rim;
  const int top = static_cast<int>(std::floor(baseline - 1.2 * size)) - rim;
  const int base = static_cast<int>(std::lround(baseline));
  Mask mask(left, top, static_cast<int>(std::ceil(wide)) + 2 * rim + 2,
            static_cast<int>(std::ceil(1.7 * size)) + 2 * rim);
  double pen = x;
  while (!text.empty()) {
    if (FT_Load_Char(face, next_character(text), FT_LOAD_NO_BITMAP | FT_LOAD_TARGET_LIGHT) != 0) continue;
    const double advance = static_cast<double>(face->glyph->linearHoriAdvance) / 65536;
    const double whole = std::floor(pen);
    FT_Outline_Translate(&face->glyph->outline, std::lround((pen - whole) * 64), 0);
    if (FT_Render_Glyph(face->glyph, FT_RENDER_MODE_NORMAL) == 0) {
      const FT_Bitmap& bitmap = face->glyph->bitmap;
      for (unsigned row = 0; row < bitmap.rows; ++row) {
        for (unsigned column = 0; column < bitmap.width; ++column) {
          const unsigned char covered = bitmap.buffer[static_cast<std::ptrdiff_t>(row) * bitmap.pitch +
                                                      static_cast<std::ptrdiff_t>(column)];
          mask.add(static_cast<int>(whole) + face->glyph->bitmap_left + static_cast<int>(column) - left,
                   base - face->glyph->bitmap_top + static_cast<int>(row) - top,
                   static_cast<float>(covered) / 255);
        }
      }
    }
    pen += advance;
  }
  if (alpha(halo) != 0) paint_halo(canvas, mask, halo, std::max(1.0, size / 9));
  paint(canvas, mask, colour);
}

}  // namespace footwall::render
