// Tar archives byte by byte, as no honest program writes them.
#pragma once
#include <array>
#include <cstdio>
#include <cstring>
#include <string>

namespace footwall::formats {

// One entry: its header, and its bytes filled up to whole blocks. type: '0' file, '1' hard link, '2' symbolic
// link, '5' folder, 'S' sparse ... announced: the size in the header, where it is not that of the bytes.
inline std::string tar_entry(const std::string& name, const std::string& bytes, char type = '0',
                             const std::string& link = "", long long announced = -1) {
  std::array<char, 512> head{};
  const auto put = [&](std::size_t at, const std::string& text) {
    std::memcpy(head.data() + at, text.data(), text.size());
  };
  const auto octal = [&](std::size_t at, int digits, long long value) {
    char text[32];
    std::snprintf(text, sizeof text, "%0*llo", digits, value);
    put(at, text);
  };
  put(0, name.substr(0, 100));
  octal(100, 7, 0644);
  octal(108, 7, 0);
  octal(116, 7, 0);
  octal(124, 11, announced >= 0 ? announced : static_cast<long long>(bytes.size()));
  octal(136, 11, 0);
  put(148, "        ");
  head[156] = type;
  put(157, link.substr(0, 100));
  put(257, std::string("ustar\0"
                       "00",
                       8));
  unsigned sum = 0;
  for (const char c : head) sum += static_cast<unsigned char>(c);
  octal(148, 6, sum);
  head[154] = '\0';
  std::string entry(head.data(), head.size());
  entry += bytes;
  entry.resize((entry.size() + 511) / 512 * 512, '\0');
  return entry;
}

inline std::string tar_end() {
  return std::string(1024, '\0');
}

}  // namespace footwall::formats
