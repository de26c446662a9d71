#include "bench/ingest/made_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <numeric>
#include <random>

#include "storage/base/error.h"

namespace footwall::bench {
namespace {

constexpr std::size_t kFileHeader = 3600;
constexpr std::size_t kTraceHeader = 240;
constexpr std::size_t kBufferBytes = std::size_t{4} << 20;

// Big-endian words at byte numbers of the standard, from 1.
template <class Number>
void put(std::byte* header, int byte, Number value) {
  auto bits = static_cast<std::make_unsigned_t<Number>>(value);
  for (int n = static_cast<int>(sizeof bits) - 1; n >= 0; --n) {
    header[byte - 1 + n] = static_cast<std::byte>(bits & 0xFFU);
    bits = static_cast<decltype(bits)>(bits >> 4 >> 4);
  }
}

// eighths / 8 as IBM: sign, exponent of 16 (excess 64), 24 bits of fraction; |eighths| < 2^20, so no bit is
// lost.
std::uint32_t ibm_of(std::int32_t eighths) {
  if (eighths == 0) return 0;
  const std::uint32_t sign = eighths < 0 ? 0x80000000U : 0U;
  auto fraction = static_cast<std::uint32_t>(eighths < 0 ? -eighths : eighths);  // value = fraction / 2^3
  std::uint32_t exponent = 64 + 6;  // fraction / 2^24 * 16^6 = fraction
  fraction <<= 1;                   // and 2^3 is no power of 16: one bit up, one digit down
  exponent -= 1;
  while (fraction < 0x100000U) {
    fraction <<= 4;
    exponent -= 1;
  }
  return sign | exponent << 24 | fraction;
}

std::int32_t eighths_at(std::int64_t i, std::int64_t j, std::int64_t k) {
  std::uint64_t x = (static_cast<std::uint64_t>(i) << 40) ^ (static_cast<std::uint64_t>(j) << 20) ^
                    static_cast<std::uint64_t>(k);
  x = (x ^ (x >> 29)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 32)) * 0x94d049bb133111ebULL;
  x ^= x >> 31;
  // Four uniform numbers of 14 bits: their sum has a standard deviation of 9459.
  const auto part = [x](int n) { return static_cast<std::int32_t>((x >> (16 * n)) & 0x3FFFU); };
  return part(0) + part(1) + part(2) + part(3) - 4 * 0x1FFF;
}

class Output {
 public:
  explicit Output(const std::filesystem::path& path)
      : path_(path), descriptor_(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644)) {
    if (descriptor_ < 0) throw io_error("write", path_, errno);
    buffer_.reserve(kBufferBytes + (std::size_t{1} << 20));
  }
  ~Output() { ::close(descriptor_); }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  // Room for this many zero bytes at the end.
  std::byte* append(std::size_t bytes) {
    if (buffer_.size() > kBufferBytes) write_out();
    buffer_.resize(buffer_.size() + bytes);
    return buffer_.data() + buffer_.size() - bytes;
  }
  void finish() {
    write_out();
    if (::fsync(descriptor_) != 0) throw io_error("write", path_, errno);
  }

 private:
  void write_out() {
    for (std::size_t done = 0; done < buffer_.size();) {
      const ssize_t put = ::write(descriptor_, buffer_.data() + done, buffer_.size() - done);
      if (put < 0) throw io_error("write", path_, errno);
      done += static_cast<std::size_t>(put);
    }
    buffer_.clear();
  }

  std::filesystem::path path_;
  int descriptor_;
  std::vector<std::byte> buffer_;
};

std::vector<std::int64_t> traces_in(TraceOrder order, const survey::Index& dims) {
  std::vector<std::int64_t> traces(static_cast<std::size_t>(dims[0] * dims[1]));
  std::iota(traces.begin(), traces.end(), std::int64_t{0});
  if (order == TraceOrder::kCrossline) {
    for (std::size_t n = 0; n < traces.size(); ++n) {
      const auto at = static_cast<std::int64_t>(n);
      traces[n] = at % dims[0] * dims[1] + at / dims[0];
    }
  } else if (order == TraceOrder::kShuffled) {
    std::mt19937_64 random(7);
    std::shuffle(traces.begin(), traces.end(), random);
  }
  return traces;
}

}  // namespace

TraceOrder trace_order_from(std::string_view name) {
  if (name == "inline") return TraceOrder::kInline;
  if (name == "crossline") return TraceOrder::kCrossline;
  if (name == "shuffled") return TraceOrder::kShuffled;
  throw Error(ErrorCode::kUsage, fmt::format("'{}' is no trace order", name),
              "inline, crossline or shuffled");
}

float made_sample(std::int64_t i, std::int64_t j, std::int64_t k) {
  return static_cast<float>(eighths_at(i, j, k)) / 8.0F;
}

void make_segy(const std::filesystem::path& path, const survey::Index& dims, TraceOrder order) {
  if (dims[0] < 1 || dims[1] < 1 || dims[2] < 1 || dims[2] > 32767) {
    throw Error(ErrorCode::kUsage, "a made file has 1 to 32767 samples a trace, and at least one trace");
  }
  Output out(path);
  std::byte* file = out.append(kFileHeader);
  std::fill_n(file, 3200, std::byte{0x40});  // blanks in EBCDIC
  put<std::int16_t>(file, 3217, 4000);
  put(file, 3221, static_cast<std::int16_t>(dims[2]));
  put<std::int16_t>(file, 3225, 1);
  put<std::int16_t>(file, 3255, 1);
  put<std::int16_t>(file, 3501, 0x0100);
  put<std::int16_t>(file, 3503, 1);
  for (const std::int64_t trace : traces_in(order, dims)) {
    const std::int64_t i = trace / dims[1];
    const std::int64_t j = trace % dims[1];
    std::byte* header = out.append(kTraceHeader + static_cast<std::size_t>(dims[2]) * 4);
    put<std::int16_t>(header, 29, 1);
    put<std::int16_t>(header, 71, -10);
    put<std::int16_t>(header, 89, 1);
    put(header, 115, static_cast<std::int16_t>(dims[2]));
    put<std::int16_t>(header, 117, 4000);
    put(header, 181, static_cast<std::int32_t>(5000000 + 125 * j));
    put(header, 185, static_cast<std::int32_t>(60000000 + 250 * i));
    put(header, 189, static_cast<std::int32_t>(i + 1));
    put(header, 193, static_cast<std::int32_t>(j + 1));
    std::byte* sample = header + kTraceHeader;
    for (std::int64_t k = 0; k < dims[2]; ++k, sample += 4) put(sample, 1, ibm_of(eighths_at(i, j, k)));
  }
  out.finish();
}

}  // namespace footwall::bench
