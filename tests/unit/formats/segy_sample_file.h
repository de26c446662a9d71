// Makes small SEG-Y files, good and odd, byte by byte; shares no code with the reader.
#pragma once
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <vector>

namespace footwall::formats::segy {

struct SampleTrace {
  std::int32_t inline_number = 0;
  std::int32_t crossline_number = 0;
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::vector<double> values;
  std::map<int, std::int32_t> words;  // further 4-byte words by byte number
  std::map<int, std::int16_t> halves;
};

struct SampleSegy {
  bool little = false;
  int format = 5;
  int samples = -1;  // in the binary header; -1 = as the first trace has
  int interval_us = 4000;
  std::string text;                   // in ASCII, padded to 3200
  std::vector<std::string> extended;  // blocks of 3200
  std::map<int, std::string> binary;  // raw bytes over the binary header, by byte number
  std::vector<SampleTrace> traces;
  std::string tail;

  static std::string number(std::uint64_t bits, int size, bool little) {
    std::string out;
    for (int n = 0; n < size; ++n)
      out.push_back(static_cast<char>(bits >> (8 * (little ? n : size - 1 - n))));
    return out;
  }
  std::string half(int value) const { return number(static_cast<std::uint64_t>(value), 2, little); }
  std::string word(std::int64_t value) const { return number(static_cast<std::uint64_t>(value), 4, little); }

  // IBM bits by long division: slow, obvious, exact for what has 24 bits.
  static std::uint32_t ibm(double value) {
    if (value == 0) return 0;
    const std::uint32_t sign = value < 0 ? 0x80000000u : 0;
    double size = value < 0 ? -value : value;
    int exponent = 64;
    for (; size >= 1; size /= 16) ++exponent;
    for (; size < 1.0 / 16; size *= 16) --exponent;
    return sign | static_cast<std::uint32_t>(exponent) << 24 | static_cast<std::uint32_t>(size * 16777216);
  }

  std::string sample(double value) const {
    const auto whole = static_cast<std::uint64_t>(static_cast<std::int64_t>(value));
    switch (format) {
      case 1:
        return number(ibm(value), 4, little);
      case 5: {
        const auto narrow = static_cast<float>(value);
        std::uint32_t bits = 0;
        std::memcpy(&bits, &narrow, 4);
        return number(bits, 4, little);
      }
      case 6: {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &value, 8);
        return number(bits, 8, little);
      }
      case 3:
      case 11:
        return number(whole, 2, little);
      case 7:
      case 15:
        return number(whole, 3, little);
      case 8:
      case 16:
        return number(whole, 1, little);
      case 9:
      case 12:
        return number(whole, 8, little);
      default:
        return number(whole, 4, little);
    }
  }

  static void put(std::string& bytes, int byte, const std::string& what) {
    std::copy(what.begin(), what.end(), bytes.begin() + (byte - 1));
  }

  std::string bytes() const {
    std::string head(3200, ' ');
    put(head, 1, text.substr(0, 3200));
    head.append(400, '\0');
    put(head, 3217, half(interval_us));
    put(head, 3221,
        half(samples >= 0 ? samples : static_cast<int>(traces.empty() ? 0 : traces[0].values.size())));
    put(head, 3225, half(format));
    put(head, 3255, half(1));
    for (const auto& [byte, what] : binary) put(head, byte, what);
    for (const std::string& block : extended) head += block + std::string(3200 - block.size(), ' ');
    for (const SampleTrace& trace : traces) {
      std::string header(240, '\0');
      put(header, 181, word(trace.x));
      put(header, 185, word(trace.y));
      put(header, 189, word(trace.inline_number));
      put(header, 193, word(trace.crossline_number));
      for (const auto& [byte, value] : trace.words) put(header, byte, word(value));
      for (const auto& [byte, value] : trace.halves) put(header, byte, half(value));
      head += header;
      for (const double value : trace.values) head += sample(value);
    }
    return head + tail;
  }

  // Inlines and crosslines first, first + step, ...; X = 1000 + 25 a - 10 b, Y = 2000 + 10 a + 20 b at bin
  // (a, b); the value at sample k is 100 a + 10 b + k.
  static SampleSegy grid(int inlines, int crosslines, int samples, int first_inline = 10, int inline_step = 2,
                         int first_crossline = 100, int crossline_step = 3) {
    SampleSegy made;
    for (int a = 0; a < inlines; ++a) {
      for (int b = 0; b < crosslines; ++b) {
        SampleTrace trace{first_inline + a * inline_step,
                          first_crossline + b * crossline_step,
                          1000 + 25 * a - 10 * b,
                          2000 + 10 * a + 20 * b,
                          {},
                          {},
                          {}};
        for (int k = 0; k < samples; ++k) trace.values.push_back(100 * a + 10 * b + k);
        made.traces.push_back(trace);
      }
    }
    return made;
  }
};

}  // namespace footwall::formats::segy
