#include "engine/render/surface_layer.h"

#include <algorithm>
#include <cstring>
#include <fstream>

#include "storage/base/error.h"
#include "storage/base/partial_file.h"

namespace footwall::render {
namespace {

struct Rectangle {
  std::int32_t x0 = 0;
  std::int32_t y0 = 0;
  std::int32_t x1 = 0;
  std::int32_t y1 = 0;
};
struct Run {
  std::int32_t first = 0;
  std::uint32_t count = 0;
};
constexpr std::size_t kColourBytes = sizeof(Rgba);

constexpr std::size_t bytes_of(PixelKind kind) {
  return kind == PixelKind::kVisible ? sizeof(Visible) : sizeof(float);
}

Error broken() {
  return {ErrorCode::kCorrupt, "a part of a picture is not whole"};
}

template <class T>
T take(const std::byte* from) {
  T value;
  std::memcpy(&value, from, sizeof(T));
  return value;
}

template <class T>
std::byte* put(std::byte* to, const T& value) {
  std::memcpy(to, &value, sizeof(T));
  return to + sizeof(T);
}

// What holds all that is seen in the rows [begin, end).
Rectangle bounds_of(const VisibilityBuffer& window, int begin, int end) {
  const int width = window.width();
  Rectangle box{width, end, 0, begin};
  for (int y = begin; y < end; ++y) {
    const std::span<const Visible> row = window.row(y);
    const auto is_seen = [](Visible v) { return v != kBackground; };
    const auto first = std::find_if(row.begin(), row.end(), is_seen);
    if (first == row.end()) continue;
    const auto last = std::find_if(row.rbegin(), row.rend(), is_seen);
    box.x0 = std::min(box.x0, static_cast<std::int32_t>(first - row.begin()));
    box.x1 = std::max(box.x1, static_cast<std::int32_t>(last.base() - row.begin()));
    box.y0 = std::min(box.y0, y);
    box.y1 = y + 1;
  }
  return box.x0 < box.x1 ? box : Rectangle{};
}

// One row as it stands in a part; refuses what reaches beyond the part's end or the rectangle.
struct Row {
  std::span<const std::byte> runs;
  const std::byte* pixels = nullptr;
  const std::byte* colours = nullptr;
  std::size_t end = 0;  // offset of the next row

  Row(std::span<const std::byte> part, std::size_t offset, const Rectangle& box, PixelKind kind) {
    if (part.size() < offset + sizeof(std::uint32_t)) throw broken();
    const std::size_t count = take<std::uint32_t>(part.data() + offset);
    offset += sizeof(std::uint32_t);
    if (count > (part.size() - offset) / sizeof(Run)) throw broken();
    runs = part.subspan(offset, count * sizeof(Run));
    offset += runs.size();
    std::size_t seen = 0;
    std::int64_t after = box.x0;
    for (std::size_t n = 0; n < count; ++n) {
      const Run run = at(n);
      if (run.first < after || std::int64_t{run.first} + run.count > box.x1) throw broken();
      after = std::int64_t{run.first} + run.count;
      seen += run.count;
    }
    if (seen * (bytes_of(kind) + kColourBytes) > part.size() - offset) throw broken();
    pixels = part.data() + offset;
    colours = pixels + seen * bytes_of(kind);
    end = offset + seen * (bytes_of(kind) + kColourBytes);
  }
  std::size_t size() const { return runs.size() / sizeof(Run); }
  Run at(std::size_t n) const { return take<Run>(runs.data() + n * sizeof(Run)); }
};

Rectangle rectangle_of(std::span<const std::byte> part, int width, int first_row, int end_row) {
  if (part.size() < sizeof(Rectangle)) throw broken();
  const auto box = take<Rectangle>(part.data());
  const bool is_empty = box.x0 == 0 && box.y0 == 0 && box.x1 == 0 && box.y1 == 0;
  const bool is_inside = box.x0 >= 0 && box.x0 < box.x1 && box.x1 <= width && box.y0 >= first_row &&
                         box.y0 < box.y1 && box.y1 <= end_row;
  if (!is_empty && !is_inside) throw broken();
  return box;
}

constexpr std::uint32_t kMagic = 0x314c5746;  // "FWL1"

}  // namespace

std::size_t encode_pixels(const VisibilityBuffer& window, std::span<const Rgba> colours, int begin, int end,
                          PixelKind kind, std::vector<std::byte>& to) {
  const Rectangle box = bounds_of(window, begin, end);
  const auto width = static_cast<std::size_t>(box.x1 - box.x0);
  // The most that one row may take.
  const std::size_t room =
      sizeof(std::uint32_t) + (width / 2 + 1) * sizeof(Run) + width * (bytes_of(kind) + kColourBytes);
  std::size_t used = to.size();
  to.resize(used + sizeof(Rectangle));
  put(to.data() + used, box);
  used += sizeof(Rectangle);
  std::vector<Run> runs;
  std::size_t all = 0;
  for (int y = box.y0; y < box.y1; ++y) {
    if (to.size() < used + room) to.resize(std::max(used + room, used + used / 2));
    const std::span<const Visible> row = window.row(y);
    runs.clear();
    std::size_t seen = 0;
    for (std::int32_t x = box.x0; x < box.x1;) {
      while (x < box.x1 && row[static_cast<std::size_t>(x)] == kBackground) ++x;
      const std::int32_t first = x;
      while (x < box.x1 && row[static_cast<std::size_t>(x)] != kBackground) ++x;
      if (x == first) break;
      runs.push_back({first, static_cast<std::uint32_t>(x - first)});
      seen += static_cast<std::size_t>(x - first);
    }
    std::byte* at = put(to.data() + used, static_cast<std::uint32_t>(runs.size()));
    for (const Run& run : runs) at = put(at, run);
    for (const Run& run : runs) {
      const std::span<const Visible> pixels = row.subspan(static_cast<std::size_t>(run.first), run.count);
      if (kind == PixelKind::kVisible) {
        std::memcpy(at, pixels.data(), pixels.size_bytes());
        at += pixels.size_bytes();
      } else {
        for (const Visible pixel : pixels) at = put(at, depth_of(pixel));
      }
    }
    const std::size_t row_start =
        static_cast<std::size_t>(y - window.first_row()) * static_cast<std::size_t>(window.width());
    for (const Run& run : runs) {
      const std::span<const Rgba> shown =
          colours.subspan(row_start + static_cast<std::size_t>(run.first), run.count);
      std::memcpy(at, shown.data(), shown.size_bytes());
      at += shown.size_bytes();
    }
    used = static_cast<std::size_t>(at - to.data());
    all += seen;
  }
  to.resize(used);
  return all;
}

void merge_pixels(std::span<const std::byte> part, VisibilityBuffer& window, std::span<Rgba> colours) {
  const Rectangle box =
      rectangle_of(part, window.width(), window.first_row(), window.first_row() + window.rows());
  std::size_t offset = sizeof(Rectangle);
  for (int y = box.y0; y < box.y1; ++y) {
    const Row row(part, offset, box, PixelKind::kVisible);
    offset = row.end;
    const std::span<Visible> mine = window.row(y);
    const std::span<Rgba> shown = colours.subspan(
        static_cast<std::size_t>(y - window.first_row()) * static_cast<std::size_t>(window.width()),
        mine.size());
    const std::byte* pixels = row.pixels;
    const std::byte* tints = row.colours;
    for (std::size_t n = 0; n < row.size(); ++n) {
      const Run run = row.at(n);
      for (std::size_t k = 0; k < run.count; ++k) {
        const std::size_t x = static_cast<std::size_t>(run.first) + k;
        const auto other = take<Visible>(pixels + k * sizeof(Visible));
        const bool is_nearer = other < mine[x];
        shown[x] = is_nearer ? take<Rgba>(tints + k * kColourBytes) : shown[x];
        mine[x] = is_nearer ? other : mine[x];
      }
      pixels += run.count * sizeof(Visible);
      tints += run.count * kColourBytes;
    }
  }
  if (offset != part.size()) throw broken();
}

SurfaceLayer::SurfaceLayer(int width, int height)
    : width_(width), height_(height), rows_(static_cast<std::size_t>(height)) {}

void SurfaceLayer::add(std::vector<std::byte> part) {
  const Rectangle box = rectangle_of(part, width_, 0, height_);
  std::size_t offset = sizeof(Rectangle);
  for (int y = box.y0; y < box.y1; ++y) {
    Place& place = rows_[static_cast<std::size_t>(y)];
    if (place.part >= 0) throw broken();
    place = {static_cast<std::int32_t>(parts_.size()), offset};
    offset = Row(part, offset, box, PixelKind::kDepth).end;
  }
  if (offset != part.size()) throw broken();
  if (box.y0 < box.y1) parts_.push_back(std::move(part));
}

void SurfaceLayer::row(int y, std::span<float> depths, std::span<Rgba> colours) const {
  std::fill(depths.begin(), depths.end(), 1.0F);
  std::fill(colours.begin(), colours.end(), Rgba{0});
  const Place& place = rows_[static_cast<std::size_t>(y)];
  if (place.part < 0) return;
  const std::vector<std::byte>& part = parts_[static_cast<std::size_t>(place.part)];
  const Row row(part, place.offset, take<Rectangle>(part.data()), PixelKind::kDepth);
  const std::byte* pixels = row.pixels;
  const std::byte* tints = row.colours;
  for (std::size_t n = 0; n < row.size(); ++n) {
    const Run run = row.at(n);
    const auto first = static_cast<std::size_t>(run.first);
    std::memcpy(&depths[first], pixels, run.count * sizeof(float));
    std::memcpy(&colours[first], tints, run.count * kColourBytes);
    pixels += run.count * sizeof(float);
    tints += run.count * kColourBytes;
  }
}

std::size_t SurfaceLayer::bytes() const {
  std::size_t all = 0;
  for (const std::vector<std::byte>& part : parts_) all += part.size();
  return all;
}

void SurfaceLayer::write(const std::filesystem::path& path) const {
  PartialFile file(path);
  {
    std::ofstream out(file.path(), std::ios::binary);
    const auto write = [&](const void* data, std::size_t size) {
      out.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
    };
    const std::uint32_t head[] = {kMagic, static_cast<std::uint32_t>(width_),
                                  static_cast<std::uint32_t>(height_),
                                  static_cast<std::uint32_t>(parts_.size())};
    write(head, sizeof head);
    for (const std::vector<std::byte>& part : parts_) {
      const std::uint64_t size = part.size();
      write(&size, sizeof size);
      write(part.data(), part.size());
    }
    out.flush();
    if (!out) throw io_error("write", path.string(), errno);
  }
  file.commit();
}

SurfaceLayer SurfaceLayer::read(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error(ErrorCode::kNotFound, "there is no picture layer " + path.string());
  const Error odd(ErrorCode::kCorrupt, path.string() + " is not a whole picture layer");
  const std::uintmax_t size = std::filesystem::file_size(path);
  const auto read = [&](void* data, std::size_t bytes) {
    in.read(static_cast<char*>(data), static_cast<std::streamsize>(bytes));
    if (!in) throw odd;
  };
  std::uint32_t head[4] = {};
  read(head, sizeof head);
  if (head[0] != kMagic || head[1] > VisibilityBuffer::kLargest || head[2] > VisibilityBuffer::kLargest)
    throw odd;
  SurfaceLayer layer(static_cast<int>(head[1]), static_cast<int>(head[2]));
  for (std::uint32_t n = 0; n < head[3]; ++n) {
    std::uint64_t bytes = 0;
    read(&bytes, sizeof bytes);
    if (bytes > size) throw odd;
    std::vector<std::byte> part(bytes);
    read(part.data(), part.size());
    layer.add(std::move(part));
  }
  return layer;
}

}  // namespace footwall::render
