// What units of length and time are in each other.
#pragma once

namespace footwall::survey {

inline constexpr double kMetresPerFoot = 0.3048;  // the international foot, by definition

}  // namespace footwall::survey
