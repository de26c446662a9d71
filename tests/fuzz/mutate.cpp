#include "fuzz/mutate.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <vector>

#include "storage/base/splitmix64.h"

namespace footwall::fuzz {
namespace {

class Random : public SplitMix64 {
 public:
  using SplitMix64::SplitMix64;
  // 0 <= result < end; 0 for an empty range.
  std::size_t below(std::size_t end) { return end == 0 ? 0 : static_cast<std::size_t>(next() % end); }
};

constexpr std::array<std::uint32_t, 12> kEdges{0,      1,      2,      0x7f,       0x80,       0xff,
                                               0x7fff, 0x8000, 0xffff, 0x7fffffff, 0x80000000, 0xffffffff};
constexpr std::array<std::string_view, 24> kWords{"0",
                                                  "-1",
                                                  "nan",
                                                  "inf",
                                                  "1e308",
                                                  "-1e-320",
                                                  "999999999999999999999",
                                                  "2147483648",
                                                  "4294967296",
                                                  "1e9",
                                                  "0x10",
                                                  "\"",
                                                  "{",
                                                  "}",
                                                  "\r\n",
                                                  "\t",
                                                  "\n\n",
                                                  "END",
                                                  "999.0",
                                                  "1E+30",
                                                  "-99999",
                                                  "\xef\xbb\xbf",
                                                  "\xff\xfe",
                                                  "%s%n"};

void set_word(std::string& bytes, Random& random) {
  const std::size_t size = std::size_t{1} << random.below(3);  // 1, 2 or 4 bytes
  if (bytes.size() < size) return;
  const std::size_t at = random.below(bytes.size() - size + 1);
  const std::uint32_t value = kEdges[random.below(kEdges.size())];
  const bool big = random.below(2) == 0;
  for (std::size_t n = 0; n < size; ++n) {
    bytes[at + n] = static_cast<char>(value >> (8 * (big ? size - 1 - n : n)));
  }
}

void exchange_word(std::string& bytes, Random& random) {
  if (bytes.empty()) return;
  std::size_t begin = random.below(bytes.size());
  const auto inside = [&](std::size_t at) {
    return std::isspace(static_cast<unsigned char>(bytes[at])) == 0;
  };
  while (begin > 0 && inside(begin - 1)) --begin;
  std::size_t end = begin;
  while (end < bytes.size() && inside(end)) ++end;
  bytes.replace(begin, end - begin, kWords[random.below(kWords.size())]);
}

// A part of `from`, at most 4 KiB.
std::string_view part_of(std::string_view from, Random& random) {
  const std::size_t at = random.below(from.size());
  return from.substr(at, 1 + random.below(std::min<std::size_t>(4096, from.size() - at)));
}

void change(std::string& bytes, std::span<const std::string> originals, Random& random) {
  switch (random.below(8)) {
    case 0:
      if (!bytes.empty()) bytes[random.below(bytes.size())] ^= static_cast<char>(1 << random.below(8));
      break;
    case 1:
      set_word(bytes, random);
      break;
    case 2:
      exchange_word(bytes, random);
      break;
    case 3: {
      const std::string_view part = part_of(bytes, random);
      if (!part.empty()) bytes.erase(static_cast<std::size_t>(part.data() - bytes.data()), part.size());
      break;
    }
    case 4:
      bytes.insert(random.below(bytes.size() + 1), std::string(part_of(bytes, random)));
      break;
    case 5: {
      const std::string& other = originals[random.below(originals.size())];
      bytes.insert(random.below(bytes.size() + 1), std::string(part_of(other, random)));
      break;
    }
    case 6:
      if (random.below(4) == 0) bytes.resize(random.below(bytes.size() + 1));
      break;
    default:
      if (!bytes.empty()) bytes[random.below(bytes.size())] = static_cast<char>(random.below(256));
      break;
  }
}

}  // namespace

std::string mutated(std::span<const std::string> originals, std::uint64_t seed, std::uint64_t round,
                    std::size_t max_size) {
  Random random(seed ^ (round * 0xd1342543de82ef95U));
  std::string bytes = originals[random.below(originals.size())];
  const std::size_t changes = 1 + random.below(8);
  for (std::size_t n = 0; n < changes; ++n) change(bytes, originals, random);
  if (bytes.size() > max_size) bytes.resize(max_size);
  return bytes;
}

}  // namespace footwall::fuzz
