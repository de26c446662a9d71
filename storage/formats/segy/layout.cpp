#include "storage/formats/segy/layout.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>

#include "storage/base/error.h"
#include "storage/formats/detail/bytes.h"
#include "storage/formats/segy/text_header.h"

namespace footwall::formats::segy {
namespace {

using detail::load;

constexpr std::int64_t kBinaryHeaderSize = 400;
constexpr std::int64_t kTraceHeaderSize = 240;
constexpr std::int64_t kHeadSize = static_cast<std::int64_t>(kTextHeaderSize) + kBinaryHeaderSize;
constexpr std::int64_t kMostTextBlocks = 1000;  // more extended headers than any real file has

// The first 3600 bytes and the first trace header, read by the standard's byte numbers.
class Head {
 public:
  explicit Head(const detail::ReadOnlyFile& file) {
    const auto whole = static_cast<std::int64_t>(bytes_.size());
    file.read_at(0, std::span(bytes_).first(static_cast<std::size_t>(std::min(whole, file.size()))));
  }
  template <class Number>
  Number at(int byte, bool swap) const {
    return load<Number>(bytes_.data() + byte - 1, swap);
  }
  std::span<const std::byte> text() const { return std::span(bytes_).first(kTextHeaderSize); }

 private:
  std::array<std::byte, kHeadSize + kTraceHeaderSize> bytes_{};
};

[[noreturn]] void refuse(const detail::ReadOnlyFile& file, const std::string& what,
                         const std::string& hint = {}) {
  throw Error(ErrorCode::kFormat, fmt::format("{}: {}", file.path().string(), what), hint);
}

// Revision 2 states the byte order; older files are big-endian by the standard and little-endian in the wild.
bool needs_swap(const Head& head, const Options& options, const detail::ReadOnlyFile& file) {
  if (options.endian) return *options.endian == Endian::kBig;
  switch (head.at<std::uint32_t>(3297, true)) {
    case 0x01020304u:
      return true;
    case 0x04030201u:
      return false;
    case 0x02010403u:
      refuse(file, "its byte order is 'pairwise swapped', which is not read", "rewrite it as big-endian");
    default:
      break;  // older files have anything here
  }
  const auto plausible = [&](bool swap) {
    const int code = head.at<std::int16_t>(3225, swap);
    return (is_defined_format(code) ? 2 : 0) + (head.at<std::uint16_t>(3221, swap) != 0 ? 1 : 0);
  };
  const bool known = is_defined_format(head.at<std::int16_t>(3225, true)) ||
                     is_defined_format(head.at<std::int16_t>(3225, false));
  if (known) return plausible(true) >= plausible(false);
  // The format code is no help: the sample interval and count of a swapped file are mostly absurd.
  const auto sensible = [&](bool swap) {
    const int interval = head.at<std::int16_t>(3217, swap);
    return interval > 0 && interval <= 20000 && head.at<std::uint16_t>(3221, swap) <= 20000;
  };
  return sensible(true) || !sensible(false);
}

constexpr int kGainFormat = 4;  // 32 bit fixed point with gain: defined, not read

[[noreturn]] void refuse_format(const detail::ReadOnlyFile& file, int code) {
  throw Error(
      ErrorCode::kUnsupported,
      fmt::format("{}: sample format {}", file.path().string(),
                  code == kGainFormat ? "4 (32 bit fixed point with gain) is obsolete and not read"
                                      : fmt::format("{} is not one of SEG-Y's", code)),
      "if the header is wrong, give the right code with --format: 1 IBM float, 2 int32, 3 int16, 5 IEEE "
      "float, 8 int8");
}

std::int64_t remainder(const detail::ReadOnlyFile& file, std::int64_t first, std::int64_t trace_size) {
  return first + trace_size > file.size() ? -1 : (file.size() - first) % trace_size;
}

// Samples a trace from the binary header, revision 2's long field, or the first trace's header.
std::int64_t sample_count(const Head& head, bool swap, bool revision2, const detail::ReadOnlyFile& file) {
  const std::int64_t extended = head.at<std::int32_t>(3269, swap);
  if (revision2 && extended > 0) return extended;
  const std::int64_t binary = head.at<std::uint16_t>(3221, swap);
  if (binary > 0) return binary;
  const std::int64_t trace = head.at<std::uint16_t>(static_cast<int>(kHeadSize) + 115, swap);
  if (trace > 0) return trace;
  if (extended > 0) return extended;
  refuse(file, "neither the binary nor the first trace header says how many samples a trace has");
}

// Bytes of extended text headers after the binary header.
std::int64_t extended_blocks(const Head& head, bool swap, std::int64_t trace_size,
                             const detail::ReadOnlyFile& file, Report& report) {
  const std::int64_t count = head.at<std::int16_t>(3505, swap);
  constexpr std::int64_t kBlock = static_cast<std::int64_t>(kTextHeaderSize);
  if (count == 0) return 0;
  if (count > 0) {
    const std::int64_t with = remainder(file, kHeadSize + count * kBlock, trace_size);
    const std::int64_t without = remainder(file, kHeadSize, trace_size);
    if (with >= 0 && (report.revision_major > 0 || with == 0 || without != 0)) return count;
    report.warnings.push_back(fmt::format(
        "the binary header's {} extended text headers do not fit the file's size: none are read", count));
    return 0;
  }
  if (count < -1) {
    report.warnings.push_back(fmt::format("{} extended text headers: none are read", count));
    return 0;
  }
  std::array<std::byte, kTextHeaderSize> block{};
  for (std::int64_t n = 0; n < kMostTextBlocks && kHeadSize + (n + 1) * kBlock <= file.size(); ++n) {
    file.read_at(kHeadSize + n * kBlock, block);
    if (is_end_stanza(block)) return n + 1;
  }
  file.read_at(kHeadSize,
               std::span(block).first(static_cast<std::size_t>(std::min(kBlock, file.size() - kHeadSize))));
  const bool stanza = decoded(block[0], is_ebcdic(block)) == '(';
  if (!stanza && remainder(file, kHeadSize, trace_size) == 0) {
    report.warnings.emplace_back(
        "the binary header announces extended text headers, but there is no stanza ((SEG: EndText)): none "
        "are read");
    return 0;
  }
  refuse(
      file, "its extended text headers have no end: no stanza ((SEG: EndText)) was found",
      "the file is cut short, or bytes 3505-3506 of the binary header are wrong: put the number of extended "
      "headers there");
}

void read_texts(const Head& head, std::int64_t blocks, const detail::ReadOnlyFile& file, Layout& layout,
                Report& report) {
  report.text_is_ebcdic = is_ebcdic(head.text());
  report.text_header = text_lines(head.text(), report.text_is_ebcdic);
  std::string whole;  // words may go on from one line, or block, to the next
  std::array<std::byte, kTextHeaderSize> block;
  for (std::int64_t n = 0; n < std::min(blocks, kMostTextBlocks); ++n) {
    file.read_at(kHeadSize + n * static_cast<std::int64_t>(kTextHeaderSize), block);
    const bool ebcdic = is_ebcdic(block);
    for (std::string& line : text_lines(block, ebcdic))
      report.extended_text_header.push_back(std::move(line));
    for (const std::byte character : block) whole.push_back(decoded(character, ebcdic));
  }
  layout.stanza = find_layout_stanza(whole);
}

// Revision 2.1 has 16 bits for their number where 2.0 had 32.
std::int64_t additional_headers(const Head& head, bool swap, Report& report) {
  const std::int64_t narrow = head.at<std::int16_t>(3507, swap);
  const std::int64_t wide = head.at<std::int32_t>(3507, swap);
  const bool is_wide =
      report.revision_minor == 0 && wide > 0 && wide <= std::numeric_limits<std::int16_t>::max();
  const std::int64_t extra = is_wide ? wide : narrow;
  if (extra < 0) report.warnings.push_back(fmt::format("{} additional trace headers: none are read", extra));
  return std::max<std::int64_t>(extra, 0);
}

// The first additional trace header has its name in its last 8 bytes, in either code page.
bool names_extension(const detail::ReadOnlyFile& file, const Layout& layout) {
  constexpr std::string_view kName = "SEG00001";
  if (layout.header_bytes() < static_cast<std::int64_t>(kMostHeaderBytes)) return false;
  std::array<std::byte, kName.size()> name;
  file.read_at(layout.offset_of(0) + static_cast<std::int64_t>(kMostHeaderBytes - kName.size()), name);
  for (const bool ebcdic : {true, false}) {
    std::string text;
    for (const std::byte character : name) text.push_back(decoded(character, ebcdic));
    if (text == kName) return true;
  }
  return false;
}

// Bytes of stanzas after the last trace, where revision 2 says that there are some.
std::int64_t trailer_bytes(const Head& head, const detail::ReadOnlyFile& file, const Layout& layout) {
  constexpr std::int64_t kBlock = static_cast<std::int64_t>(kTextHeaderSize);
  const std::int64_t stated = head.at<std::int32_t>(3529, layout.swap);
  if (stated > 0) return stated * kBlock;
  if (stated != -1) return 0;
  // Their number is not said: a stanza starts with "((" where a trace would start.
  std::int64_t found = 0;
  for (std::int64_t n = 1; n <= kMostTextBlocks; ++n) {
    const std::int64_t at = file.size() - n * kBlock;
    if (at < layout.first_trace + layout.trace_size) break;
    if ((at - layout.first_trace) % layout.trace_size != 0) continue;
    std::array<std::byte, 2> start;
    file.read_at(at, start);
    for (const bool ebcdic : {true, false}) {
      if (decoded(start[0], ebcdic) == '(' && decoded(start[1], ebcdic) == '(') found = n * kBlock;
    }
  }
  return found;
}

double stated_interval(const Head& head, bool swap, bool revision2, Report& report) {
  if (revision2) {
    const auto precise = head.at<double>(3273, swap);
    if (std::isfinite(precise) && precise > 0) return precise;
  }
  const int interval = head.at<std::int16_t>(3217, swap);
  if (interval < 0) {
    report.warnings.push_back(
        fmt::format("the binary header's sample interval is {}, or {} as a word without sign", interval,
                    interval + 65536));
  }
  return std::max(interval, 0);
}

void count_traces(const Head& head, bool revision2, const detail::ReadOnlyFile& file, Layout& layout,
                  Report& report) {
  std::int64_t body = file.size() - layout.first_trace;
  if (revision2) {
    const std::int64_t trailer = trailer_bytes(head, file, layout);
    if (trailer <= body) body -= trailer;
  }
  layout.traces = body > 0 ? body / layout.trace_size : 0;
  if (layout.traces == 0) {
    refuse(file, fmt::format("no trace of {} samples fits into its {} bytes", layout.samples, file.size()),
           "it is cut short, or the headers are read in the wrong byte order or format");
  }
  std::int64_t rest = body % layout.trace_size;
  const auto stated = revision2 ? head.at<std::uint64_t>(3513, layout.swap) : 0;
  if (stated > 0 && stated <= static_cast<std::uint64_t>(layout.traces)) {
    layout.traces = static_cast<std::int64_t>(stated);  // what follows are trailer stanzas
    rest = 0;
  } else if (stated > 0) {
    report.warnings.push_back(
        fmt::format("cut short: the header says {} traces, {} are there", stated, layout.traces));
  }
  if (rest > 0) {
    report.warnings.push_back(fmt::format("{} bytes after the last whole trace are left out (a trace has {})",
                                          rest, layout.trace_size));
  }
}

}  // namespace

Layout read_layout(const detail::ReadOnlyFile& file, const Options& options, Report& report) {
  if (file.size() < kHeadSize) {
    refuse(file, fmt::format("{} bytes are too few for SEG-Y's headers", file.size()),
           "it is no SEG-Y, or its transfer broke off: copy it again");
  }
  const Head head(file);
  Layout layout;
  layout.swap = needs_swap(head, options, file);
  layout.endian = layout.swap ? Endian::kBig : Endian::kLittle;
  report.endian = layout.endian;
  report.revision_major = head.at<std::uint8_t>(3501, layout.swap);
  report.revision_minor = head.at<std::uint8_t>(3502, layout.swap);
  if (report.revision_major > 2) {
    report.warnings.push_back(fmt::format("revision {}.{} is not known: read as revision 1",
                                          report.revision_major, report.revision_minor));
  }
  const bool revision2 = report.revision_major == 2;  // else the words that came with it hold anything
  report.format = options.format ? *options.format : head.at<std::int16_t>(3225, layout.swap);
  layout.format = sample_format(report.format);
  report.format_name = layout.format != nullptr       ? layout.format->name
                       : report.format == kGainFormat ? "32 bit fixed point with gain"
                                                      : "";
  layout.interval_us = stated_interval(head, layout.swap, revision2, report);
  report.interval_us = layout.interval_us;
  layout.measurement = head.at<std::int16_t>(3255, layout.swap);
  read_texts(head, 0, file, layout, report);

  report.samples = head.at<std::uint16_t>(3221, layout.swap);
  if (layout.format == nullptr && report.format != kGainFormat) refuse_format(file, report.format);
  layout.samples = sample_count(head, layout.swap, revision2, file);
  report.samples = layout.samples;
  layout.trace_header_size = kTraceHeaderSize;
  if (revision2) layout.trace_header_size *= 1 + additional_headers(head, layout.swap, report);
  constexpr int kGainSize = 4;
  layout.trace_size = layout.trace_header_size +
                      layout.samples * (layout.format != nullptr ? layout.format->size : kGainSize);

  const std::int64_t blocks = extended_blocks(head, layout.swap, layout.trace_size, file, report);
  read_texts(head, blocks, file, layout, report);
  layout.first_trace = kHeadSize + blocks * static_cast<std::int64_t>(kTextHeaderSize);
  if (revision2) {
    const auto stated = head.at<std::uint64_t>(3521, layout.swap);
    if (stated >= static_cast<std::uint64_t>(kHeadSize) && stated < static_cast<std::uint64_t>(file.size())) {
      layout.first_trace = static_cast<std::int64_t>(stated);
    } else if (stated != 0) {
      report.warnings.push_back(fmt::format("the first trace cannot start at byte {}: ignored", stated));
    }
  }
  count_traces(head, revision2, file, layout, report);
  report.traces = layout.traces;
  if (layout.format == nullptr) refuse_format(file, report.format);
  layout.has_extension = names_extension(file, layout);
  return layout;
}

bool looks_like_segy(const std::filesystem::path& path) {
  Report report;
  bool fits = false;  // traces fill the file to its last byte
  bool ordered = false;
  try {
    const detail::ReadOnlyFile file(path);
    if (file.size() < kHeadSize) return false;
    const auto order = Head(file).at<std::uint32_t>(3297, true);
    ordered = order == 0x01020304u || order == 0x04030201u;
    const Layout layout = read_layout(file, {}, report);
    fits = (file.size() - layout.first_trace) % layout.trace_size == 0;
  } catch (const Error& error) {
    // The question was only whether it looks like one: what was found up to here tells.
    if (error.code() == ErrorCode::kNotFound || error.code() == ErrorCode::kIo) return false;
  }
  if (fits) return true;
  // One that was cut, or cannot be imported, still has its text, mostly printable, or states its byte order.
  std::size_t letters = 0;
  for (const std::string& line : report.text_header) letters += line.size();
  return is_defined_format(report.format) && (ordered || (letters >= 160 && report.revision_major <= 2));
}

std::string_view name_of(Endian endian) {
  return endian == Endian::kBig ? "big" : "little";
}

}  // namespace footwall::formats::segy
