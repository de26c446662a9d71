// How samples become colours, the same in a section as on the scene's planes.
#pragma once
#include <qrgb.h>
#include <array>
#include <utility>

#include "ui/model/display.h"
#include "ui/model/section_reader.h"

namespace footwall::ui {

class SampleColours {
 public:
  // Of a look whose colour map nobody knows: grey. No facts: a range from -1 to 1.
  SampleColours(const SampleLook& look, const SectionReader::VolumeFacts* facts);

  double low() const { return low_; }
  double high() const { return high_; }
  // Whether values lie on both sides of zero: then they have a polarity.
  bool is_signed() const { return signed_; }
  const std::array<QRgb, 256>& table() const { return table_; }
  // The place in the table; values beyond the range take the ends. value: not NaN.
  int place_of(float value) const {
    const float place = (value - static_cast<float>(low_)) * per_value_;
    return place <= 0 ? 0 : place >= 255 ? 255 : static_cast<int>(place);
  }
  QRgb colour_of(float value) const { return table_[static_cast<std::size_t>(place_of(value))]; }

 private:
  double low_ = -1;
  double high_ = 1;
  bool signed_ = false;
  float per_value_ = 128;
  std::array<QRgb, 256> table_{};
};

}  // namespace footwall::ui
