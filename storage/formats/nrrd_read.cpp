#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "storage/base/byte_rate.h"
#include "storage/base/error.h"
#include "storage/formats/detail/bytes.h"
#include "storage/formats/detail/read_only_file.h"
#include "storage/formats/detail/sample_grid.h"
#include "storage/formats/detail/scratch_file.h"
#include "storage/formats/nrrd.h"

namespace footwall::formats::nrrd {
namespace {

constexpr std::int64_t kBuffer = std::int64_t{1} << 20;
constexpr std::int64_t kMostPacking = 1040;  // deflate makes at most 1032 bytes of one

template <class Number, bool kSwap>
void decode(const std::byte* in, std::int64_t count, float* out, std::int64_t stride) {
  for (std::int64_t n = 0; n < count; ++n) {
    auto value = detail::load<Number, kSwap>(in + n * static_cast<std::int64_t>(sizeof(Number)));
    if constexpr (std::is_same_v<Number, double>) {
      // Finite doubles beyond float32 stay finite; infinities and NaN are nulls as they are.
      constexpr double kLargest = std::numeric_limits<float>::max();
      if (std::isfinite(value)) value = std::clamp(value, -kLargest, kLargest);
    }
    out[n * stride] = static_cast<float>(value);
  }
}

template <class Number>
detail::Element element(bool swap) {
  return {sizeof(Number), swap ? decode<Number, true> : decode<Number, false>};
}

detail::Element element_of(SampleType type, bool swap) {
  switch (type) {
    case SampleType::kInt8:
      return element<std::int8_t>(swap);
    case SampleType::kUint8:
      return element<std::uint8_t>(swap);
    case SampleType::kInt16:
      return element<std::int16_t>(swap);
    case SampleType::kUint16:
      return element<std::uint16_t>(swap);
    case SampleType::kInt32:
      return element<std::int32_t>(swap);
    case SampleType::kUint32:
      return element<std::uint32_t>(swap);
    case SampleType::kInt64:
      return element<std::int64_t>(swap);
    case SampleType::kUint64:
      return element<std::uint64_t>(swap);
    case SampleType::kFloat32:
      return element<float>(swap);
    case SampleType::kFloat64:
      break;
  }
  return element<double>(swap);
}

// The offset after the lines that are to be skipped.
std::int64_t after_lines(const detail::ReadOnlyFile& file, std::int64_t from, std::int64_t lines) {
  if (lines <= 0) return from;
  std::vector<std::byte> buffer(static_cast<std::size_t>(std::min(kBuffer, file.size())));
  while (lines > 0) {
    const std::int64_t size = std::min(kBuffer, file.size() - from);
    if (size <= 0) {
      throw Error(ErrorCode::kCorrupt,
                  fmt::format("{} ends within the lines to be skipped", file.path().string()));
    }
    file.read_at(from, std::span(buffer).first(static_cast<std::size_t>(size)));
    std::int64_t used = 0;
    while (used < size && lines > 0) {
      if (buffer[static_cast<std::size_t>(used++)] == std::byte{'\n'}) --lines;
    }
    from += used;
  }
  return from;
}

[[noreturn]] void too_short(const detail::ReadOnlyFile& file, std::int64_t missing) {
  throw Error(
      ErrorCode::kCorrupt,
      fmt::format("{} has {} bytes of samples less than its header says", file.path().string(), missing),
      "the file was cut short, or is still being copied");
}

// One gzip (or zlib) stream after another, as far as the bytes that are wanted go.
class Unpacker {
 public:
  Unpacker(const detail::ReadOnlyFile& file, std::int64_t from) : file_(file), at_(from), in_(kBuffer) {
    // 32: zlib finds out whether it is gzip or zlib.
    if (inflateInit2(&stream_, 15 + 32) != Z_OK) throw Error(ErrorCode::kMemory, "zlib cannot be started");
  }
  ~Unpacker() { inflateEnd(&stream_); }
  Unpacker(const Unpacker&) = delete;
  Unpacker& operator=(const Unpacker&) = delete;

  // Fills `out` as far as there is something; returns how much.
  std::size_t next(std::span<std::byte> out) {
    stream_.next_out = reinterpret_cast<Bytef*>(out.data());
    stream_.avail_out = static_cast<uInt>(out.size());
    while (stream_.avail_out > 0) {
      if (stream_.avail_in == 0 && !refill()) break;
      if (between_ && !restart()) break;
      const int status = inflate(&stream_, Z_NO_FLUSH);
      if (status == Z_STREAM_END) {
        between_ = true;
      } else if (status != Z_OK && status != Z_BUF_ERROR) {
        throw Error(ErrorCode::kCorrupt,
                    fmt::format("{}: the packed samples are damaged: {}", file_.path().string(),
                                stream_.msg != nullptr ? stream_.msg : "zlib error"));
      }
    }
    return out.size() - stream_.avail_out;
  }

 private:
  bool refill() {
    const std::int64_t size = std::min(kBuffer, file_.size() - at_);
    if (size <= 0) return false;
    file_.read_at(at_, std::span(in_).first(static_cast<std::size_t>(size)));
    at_ += size;
    stream_.next_in = reinterpret_cast<Bytef*>(in_.data());
    stream_.avail_in = static_cast<uInt>(size);
    return true;
  }
  // Behind a stream: another one, or padding, which ends it.
  bool restart() {
    if (*stream_.next_in != 0x1F && *stream_.next_in != 0x78) return false;
    between_ = false;
    return inflateReset(&stream_) == Z_OK;
  }

  const detail::ReadOnlyFile& file_;
  std::int64_t at_;
  std::vector<std::byte> in_;
  z_stream stream_{};
  bool between_ = false;
};

}  // namespace

struct NrrdFile::State {
  Header header;
  std::int64_t total = 0;  // bytes of all samples
  std::int64_t part = 0;   // of one data file's
  std::vector<std::filesystem::path> files;
  std::vector<std::int64_t> starts;  // where each file's samples begin
  std::optional<detail::ScratchFile> unpacked;
  // The file that was read last: neighbouring blocks lie mostly in one.
  mutable std::size_t open_number = 0;
  mutable std::optional<detail::ReadOnlyFile> open_file;

  void find_samples();
  void unpack(const std::filesystem::path& scratch, const JobContext& job);
  void read_at(std::int64_t offset, std::span<std::byte> bytes) const;
};

void NrrdFile::State::find_samples() {
  for (const std::filesystem::path& path : files) {
    const detail::ReadOnlyFile file(path);
    std::int64_t start = header.byte_skip == -1
                             ? file.size() - part
                             : after_lines(file, header.files.empty() ? header.data_at : 0, header.line_skip);
    if (header.encoding == Encoding::kRaw) {
      if (header.byte_skip > file.size()) too_short(file, part);
      if (header.byte_skip > 0) start += header.byte_skip;
      const std::int64_t left = file.size() - start;
      const std::int64_t header_end = header.files.empty() ? header.data_at : 0;
      if (start < header_end) too_short(file, header_end - start);
      if (left < part) too_short(file, part - left);
    }
    starts.push_back(start);
  }
}

void NrrdFile::State::unpack(const std::filesystem::path& scratch, const JobContext& job) {
  // Before any room is taken: a header may announce what no file of this size can hold.
  for (const std::filesystem::path& path : files) {
    const detail::ReadOnlyFile file(path);
    const std::int64_t most = (file.size() + 1) * kMostPacking;
    if (part > most) too_short(file, part - most);
  }
  detail::ScratchFile out(scratch, total);
  std::vector<std::byte> buffer(
      static_cast<std::size_t>(std::min(kBuffer, std::max<std::int64_t>(total, header.byte_skip))));
  ByteRate rate(total);
  std::int64_t done = 0;
  for (std::size_t n = 0; n < files.size(); ++n) {
    const detail::ReadOnlyFile file(files[n]);
    file.expect_sequential();
    Unpacker unpacker(file, starts[n]);
    std::int64_t skip = std::max<std::int64_t>(0, header.byte_skip);
    for (std::int64_t left = part; left > 0;) {
      job.report(static_cast<double>(done) / static_cast<double>(total), "unpack",
                 rate.text(done, ByteRate::Clock::now()));
      const std::int64_t wanted = std::min(kBuffer, skip > 0 ? skip : left);
      const auto got =
          static_cast<std::int64_t>(unpacker.next(std::span(buffer).first(static_cast<std::size_t>(wanted))));
      if (got == 0) too_short(file, left);
      if (skip > 0) {
        skip -= got;
        continue;
      }
      out.write_at(done, std::span<const std::byte>(buffer).first(static_cast<std::size_t>(got)));
      done += got;
      left -= got;
    }
  }
  unpacked.emplace(std::move(out));
}

void NrrdFile::State::read_at(std::int64_t offset, std::span<std::byte> bytes) const {
  if (unpacked) return unpacked->read_at(offset, bytes);
  while (!bytes.empty()) {
    const auto number = static_cast<std::size_t>(offset / part);
    const std::int64_t inside = offset % part;
    const auto here =
        static_cast<std::size_t>(std::min(part - inside, static_cast<std::int64_t>(bytes.size())));
    if (!open_file || open_number != number) {
      open_file.reset();
      open_file.emplace(files[number]);
      open_number = number;
    }
    open_file->read_at(starts[number] + inside, bytes.first(here));
    bytes = bytes.subspan(here);
    offset += static_cast<std::int64_t>(here);
  }
}

NrrdFile::NrrdFile(const std::filesystem::path& path, const std::filesystem::path& scratch,
                   const JobContext& job)
    : state_(std::make_unique<State>()) {
  State& state = *state_;
  state.header = read_header(path);
  state.total = size_of(state.header.type);
  for (const Axis& axis : state.header.axes) state.total *= axis.size;
  state.files = state.header.files;
  if (state.files.empty()) state.files.push_back(path);
  state.part = state.total / static_cast<std::int64_t>(state.files.size());
  state.find_samples();
  if (state.header.encoding == Encoding::kGzip) state.unpack(scratch, job);
}
NrrdFile::NrrdFile(NrrdFile&&) noexcept = default;
NrrdFile& NrrdFile::operator=(NrrdFile&&) noexcept = default;
NrrdFile::~NrrdFile() = default;

const Header& NrrdFile::header() const {
  return state_->header;
}

void NrrdFile::read_block(const raw::AxisOrder& order, const survey::Box& box,
                          std::span<float> values) const {
  const State& state = *state_;
  survey::Index dims{};
  for (std::size_t n = 0; n < 3; ++n)
    dims[static_cast<std::size_t>(order[2 - n])] = state.header.axes[n].size;
  require(!box.empty() && survey::intersection(box, {{0, 0, 0}, dims}) == box,
          "the box lies inside the volume");
  require(values.size() == static_cast<std::size_t>(box.count()), "values hold one float a voxel of the box");
  const detail::Element element = element_of(state.header.type, state.header.big_endian);
  detail::read_block([&](std::int64_t offset, std::span<std::byte> bytes) { state.read_at(offset, bytes); },
                     dims, order, element, box, values);
}

}  // namespace footwall::formats::nrrd
