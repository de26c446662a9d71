#include "engine/render/overlay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/render/text_fit.h"

namespace footwall::render {
namespace {

constexpr Rgba kPanel = rgb(0x26, 0x2a, 0x31, 236);
constexpr Rgba kLine = hex(0x454c58);
constexpr Rgba kText = hex(0xd6dae0);
constexpr Rgba kDim = hex(0x9aa2ae);
constexpr Rgba kShadow = rgb(16, 18, 22, 200);

constexpr int kTicks = 5;
constexpr std::size_t kMostNoteLines = 3;
constexpr std::size_t kNamesBeforeBars = 5;

std::string superscript(int number) {
  static constexpr const char* kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = number < 0 ? "⁻" : "";
  for (const char digit : fmt::format("{}", std::abs(number))) text += kDigits[digit - '0'];
  return text;
}

void draw_panel(Canvas& canvas, double x0, double y0, double x1, double y1, double scale) {
  const double radius = 7 * scale;
  canvas.fill_rounded(x0, y0, x1, y1, radius, kLine);
  canvas.fill_rounded(x0 + 1, y0 + 1, x1 - 1, y1 - 1, radius - 1, kPanel);
}

struct Writer {
  Canvas& canvas;
  Typeface* typeface;
  double scale;

  void write(double x, double baseline, std::string_view text, double size, Rgba colour,
             bool bold = false) const {
    if (typeface != nullptr) typeface->draw(canvas, x, baseline, text, size * scale, colour, bold);
  }
  // The same, shortened to end before x1.
  void write_until(double x1, double x, double baseline, std::string_view text, double size, Rgba colour,
                   bool bold = false) const {
    if (typeface != nullptr)
      write(x, baseline, fitted(*typeface, text, size * scale, bold, x1 - x), size, colour, bold);
  }
  std::vector<std::string> lines(std::string_view text, double size, double room, std::size_t most) const {
    return typeface != nullptr ? wrapped(*typeface, text, size * scale, room, most)
                               : std::vector<std::string>{};
  }
};

void draw_bar(const Writer& writer, double x0, double y0, double width, double height, const ColourBar& bar,
              const BarTicks& ticks) {
  Canvas& canvas = writer.canvas;
  const double s = writer.scale;
  canvas.fill_rectangle(x0 - 1, y0 - 1, x0 + width + 1, y0 + height + 1, kLine);
  const int rows = std::max(1, static_cast<int>(std::lround(height)));
  for (int row = 0; row < rows; ++row) {
    const double value = 1 - (row + 0.5) / rows;
    canvas.fill_rectangle(x0, y0 + row * height / rows, x0 + width, y0 + (row + 1) * height / rows,
                          bar.colours->colour_of(value, 0, 1));
  }
  for (std::size_t n = 0; n < ticks.texts.size(); ++n) {
    const double y = y0 + height * (1 - static_cast<double>(n) / static_cast<double>(ticks.texts.size() - 1));
    canvas.stroke({x0 + width + 1, y}, {x0 + width + 6 * s, y}, std::max(1.0, s), kDim);
    writer.write(x0 + width + 12 * s, y + 5.5 * s, ticks.texts[n], 15, kText);
  }
}

void draw_swatch(const Writer& writer, double x0, double y0, double width, double height, Rgba colour) {
  writer.canvas.fill_rectangle(x0, y0, x0 + width, y0 + height, colour);
  for (int n = 0; 8 * n < width; ++n) {
    const double at = 8 * n;
    const Point stripe[] = {{x0 + at, y0 + height},
                            {x0 + std::min(at + 3, width), y0 + height},
                            {x0 + std::min(at + 3 + height / 2, width), y0},
                            {x0 + std::min(at + height / 2, width), y0}};
    writer.canvas.fill_polygon(stripe, scaled(colour, 0.62));
  }
}

}  // namespace

BarTicks ticks_of(const Range& range, int count) {
  BarTicks ticks;
  const double largest = std::max(std::abs(range.lo), std::abs(range.hi));
  if (largest > 0 && (largest >= 1e5 || largest < 1e-2)) {
    ticks.exponent = static_cast<int>(3 * std::floor(std::log10(largest) / 3));
  }
  const double unit = std::pow(10, ticks.exponent);
  const double step = (range.hi - range.lo) / (count - 1) / unit;
  const int decimals = step > 0 ? std::clamp(static_cast<int>(1 - std::floor(std::log10(step))), 0, 6) : 0;
  for (int n = 0; n < count; ++n) {
    double value = range.lo / unit + n * step;
    if (std::abs(value) < 1e-9 * std::abs(step)) value = 0;  // no "-0.00"
    std::string text = fmt::format("{:.{}f}", value, decimals);
    if (text.front() == '-') text.replace(0, 1, "−");
    ticks.texts.push_back(std::move(text));
  }
  return ticks;
}

void draw_panels(Canvas& canvas, Typeface* typeface, const Scene& scene) {
  const double s = scene.text_scale;
  const Writer writer{canvas, typeface, s};
  const double margin = 24 * s;
  const double pad = 16 * s;
  const double x1 = canvas.width() - margin;
  const double x0 = x1 - (kPanelWidth - 24) * s;
  double bottom = canvas.height() - margin;
  // Low pictures have low bars, and room for the first faults' names above them.
  const double names = static_cast<double>(std::min(scene.legend.size(), kNamesBeforeBars));
  const double legend = names > 0 ? 2 * pad + (44 + 26 * names) * s : 0;
  const double bars = static_cast<double>(std::max<std::size_t>(1, scene.bars.size()));
  const double bar_height = std::clamp((bottom - margin - legend) / bars - 140 * s, 60 * s, 190 * s);
  for (auto bar = scene.bars.rbegin(); bar != scene.bars.rend(); ++bar) {
    const BarTicks ticks = ticks_of(bar->range, kTicks);
    std::string note = bar->note;
    if (ticks.exponent != 0) {
      note = fmt::format("10{}{}{}", superscript(ticks.exponent), note.empty() ? "" : " ", note);
    }
    const std::vector<std::string> notes = writer.lines(note, 14, x1 - x0 - 2 * pad, kMostNoteLines);
    const double head = (36 + 19 * static_cast<double>(notes.size())) * s;
    const double swatch = bar->has_undefined ? 32 * s : 0;
    const double top = bottom - (head + bar_height + swatch + 2 * pad + 6 * s);
    draw_panel(canvas, x0, top, x1, bottom, s);
    writer.write_until(x1 - pad, x0 + pad, top + pad + 15 * s, bar->title, 17, kText, true);
    for (std::size_t n = 0; n < notes.size(); ++n)
      writer.write(x0 + pad, top + pad + (37 + 19 * static_cast<double>(n)) * s, notes[n], 14, kDim);
    draw_bar(writer, x0 + pad, top + pad + head, 20 * s, bar_height, *bar, ticks);
    if (bar->has_undefined) {
      draw_swatch(writer, x0 + pad, bottom - pad - 14 * s, 20 * s, 14 * s, ColourMap::kUndefined);
      writer.write(x0 + pad + 32 * s, bottom - pad - 1.5 * s, "no value", 15, kText);
    }
    bottom = top - 14 * s;
  }
  if (scene.legend.empty()) return;
  const double row = 26 * s;
  // As many as fit above the bars; the rest is counted.
  const auto room = static_cast<std::size_t>(std::max(0.0, (bottom - margin - 2 * pad - 30 * s) / row));
  const bool all = scene.legend.size() <= room;
  const std::size_t shown = all ? scene.legend.size() : room > 0 ? room - 1 : 0;
  if (shown == 0) return;
  const double top = margin;
  draw_panel(canvas, x0, top, x1, top + 2 * pad + 24 * s + row * static_cast<double>(all ? shown : shown + 1),
             s);
  writer.write(x0 + pad, top + pad + 15 * s, scene.legend_title, 17, kText, true);
  for (std::size_t n = 0; n < shown; ++n) {
    const double y = top + pad + 28 * s + row * static_cast<double>(n);
    canvas.fill_rounded(x0 + pad, y + 5 * s, x0 + pad + 20 * s, y + 19 * s, 3 * s, scene.legend[n].colour);
    writer.write_until(x1 - pad, x0 + pad + 32 * s, y + 17.5 * s, scene.legend[n].name, 15, kText);
  }
  if (!all) {
    writer.write(x0 + pad + 32 * s, top + pad + 45.5 * s + row * static_cast<double>(shown),
                 fmt::format("and {} more", scene.legend.size() - shown), 15, kDim);
  }
}

void draw_title(Canvas& canvas, Typeface& typeface, const Scene& scene) {
  const double s = scene.text_scale;
  const bool panels = !scene.bars.empty() || !scene.legend.empty();
  const double room = canvas.width() - (panels ? 28 + kPanelWidth + 14 : 2 * 28) * s;
  typeface.draw(canvas, 28 * s, 48 * s, fitted(typeface, scene.title, 24 * s, true, room), 24 * s, kText,
                true, kShadow);
  typeface.draw(canvas, 28 * s, (scene.title.empty() ? 46 : 74) * s,
                fitted(typeface, scene.subtitle, 16 * s, false, room), 16 * s, kDim, false, kShadow);
}

void draw_north_arrow(Canvas& canvas, Typeface* typeface, const Scene& scene, const Camera& camera) {
  const double s = scene.text_scale;
  const Point middle{96 * s, canvas.height() - 88 * s};
  const double size = 54 * s;
  // A needle lying on level ground, seen from at least 25 degrees above or below it.
  const double rise = std::copysign(std::max(std::abs(camera.forward.z), 0.42), -camera.forward.z);
  const auto at = [&](double east, double north) {
    const double across = east * camera.right.x + north * camera.right.y;
    const double away = -east * camera.right.y + north * camera.right.x;
    return Point{middle.x + across * size, middle.y - away * rise * size};
  };
  constexpr int kSteps = 48;
  for (int step = 0; step < kSteps; ++step) {
    const auto rim = [&](int n) {
      const double angle = 2 * std::numbers::pi * n / kSteps;
      return at(std::sin(angle), std::cos(angle));
    };
    canvas.stroke(rim(step), rim(step + 1), 1.3 * s, hex(0x5a6270));
  }
  const Point tip = at(0, 0.92);
  const Point notch = at(0, -0.42);
  const Point west[] = {tip, at(-0.40, -0.72), notch};
  const Point east[] = {tip, at(0.40, -0.72), notch};
  canvas.fill_polygon(west, hex(0xe8ebef));
  canvas.fill_polygon(east, hex(0x8d95a1));
  if (typeface == nullptr) return;
  const Point name = at(0, 1.36);
  const double width = typeface->width("N", 18 * s, true);
  typeface->draw(canvas, name.x - width / 2, name.y + 6.5 * s, "N", 18 * s, kText, true, kShadow);
}

void draw_orientation_axes(Canvas& canvas, Typeface* typeface, const Scene& scene, const Camera& camera) {
  const double s = scene.text_scale;
  const Point middle{96 * s, canvas.height() - 92 * s};
  const double size = 62 * s;
  struct Axis {
    Vec3 direction;
    const char* name;
    Rgba colour;
  };
  std::array<Axis, 3> axes{
      {{{1, 0, 0}, "E", hex(0xf07f6f)}, {{0, 1, 0}, "N", hex(0x79d28d)}, {{0, 0, 1}, "Z", hex(0x6fb3f2)}}};
  // Those that point away first.
  std::stable_sort(axes.begin(), axes.end(), [&](const Axis& a, const Axis& b) {
    return dot(a.direction, camera.forward) > dot(b.direction, camera.forward);
  });
  for (const Axis& axis : axes) {
    const double across = dot(axis.direction, camera.right);
    const double upwards = dot(axis.direction, camera.up);
    const auto at = [&](double share) {
      return Point{middle.x + across * size * share, middle.y - upwards * size * share};
    };
    const Point tip = at(1);
    canvas.stroke(middle, tip, 5.5 * s, kShadow);
    canvas.stroke(middle, tip, 3 * s, axis.colour);
    const double seen = std::hypot(across, upwards);
    if (seen > 0.15) {
      const double x = across / seen * s;
      const double y = -upwards / seen * s;
      const Point head[] = {{tip.x + 11 * x, tip.y + 11 * y},
                            {tip.x - 6 * x - 6 * y, tip.y - 6 * y + 6 * x},
                            {tip.x - 6 * x + 6 * y, tip.y - 6 * y - 6 * x}};
      canvas.fill_polygon(head, axis.colour);
    }
    if (typeface == nullptr) continue;
    // Beside the tip, also where the axis points at the eye.
    const double away = seen > 0.15 ? 24 * s / seen : 0;
    const Point name{tip.x + across * away, tip.y - upwards * away};
    const double width = typeface->width(axis.name, 17 * s, true);
    typeface->draw(canvas, name.x - width / 2, name.y + 6 * s, axis.name, 17 * s, kText, true, kShadow);
  }
}

}  // namespace footwall::render
