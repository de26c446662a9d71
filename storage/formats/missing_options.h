// Options without which a volume's samples have no place or meaning, where the file cannot tell by itself.
#pragma once
#include <string_view>
#include <vector>

namespace footwall::formats {

struct MissingOption {
  std::string_view name;     // on the command line
  std::string_view meaning;  // "the file cannot tell ..."
  std::string_view values;
};

inline constexpr MissingOption kMissingDims{"--dims", "its size",
                                            "inlines x crosslines x samples, e.g. 256x256x128"};
inline constexpr MissingOption kMissingDomain{"--domain", "whether z is time or depth", "time or depth"};
inline constexpr MissingOption kMissingUnit{"--vertical-unit", "the unit of z", "ms, m or ft"};
inline constexpr MissingOption kMissingInterval{"--interval", "the sample interval",
                                                "a number in the vertical unit, e.g. 4"};

// Throws Error kUsage that names all of them at once; returns where there are none.
void refuse_missing(const std::vector<MissingOption>& missing);

}  // namespace footwall::formats
