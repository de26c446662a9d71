#include "storage/formats/segy/header_word.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "storage/base/error.h"
#include "storage/base/text.h"
#include "storage/formats/detail/bytes.h"
#include "storage/formats/segy/samples.h"

namespace footwall::formats::segy {
namespace {

constexpr std::array<std::pair<std::string_view, WordType>, 5> kTypeNames{{
    {"int32", WordType::kInt32},
    {"int16", WordType::kInt16},
    {"ieee", WordType::kIeee},
    {"ibm", WordType::kIbm},
    {"float64", WordType::kFloat64},
}};

}  // namespace

int size_of(WordType type) {
  switch (type) {
    case WordType::kInt32:
    case WordType::kIeee:
    case WordType::kIbm:
      return 4;
    case WordType::kInt16:
      return 2;
    case WordType::kFloat64:
      return 8;
    case WordType::kNone:
    case WordType::kOrder:
      break;
  }
  return 0;
}

bool is_scaled(WordType type) {
  return type == WordType::kInt32 || type == WordType::kInt16;
}

HeaderWord header_word_from(std::string_view text, std::string_view option) {
  if (text == "none") return kNoWord;
  if (text == "order") return kOrderWord;
  const std::size_t colon = text.find(':');
  const auto byte = text::integer(text.substr(0, colon));
  if (byte && *byte >= 1 && *byte <= 480) {
    if (colon == std::string_view::npos) return {static_cast<int>(*byte)};
    for (const auto& [name, type] : kTypeNames) {
      if (text.substr(colon + 1) == name) return {static_cast<int>(*byte), type};
    }
  }
  throw Error(ErrorCode::kUsage, fmt::format("{} '{}' is no place in a trace header", option, text),
              "give a byte number from 1 to 240, with :int16, :ieee, :ibm or :float64 where it is no int32, "
              "e.g. 189 or 81:ieee; or none; or order");
}

std::string text_of(const HeaderWord& word) {
  if (word.type == WordType::kNone) return "none";
  if (word.type == WordType::kOrder) return "order";
  if (word.type == WordType::kInt32) return std::to_string(word.byte);
  for (const auto& [name, type] : kTypeNames) {
    if (type == word.type) return fmt::format("{}:{}", word.byte, name);
  }
  return {};
}

double value_of(const HeaderWord& word, std::span<const std::byte> header, bool swap, std::int64_t trace) {
  const std::byte* at = header.data() + (word.byte - 1);
  switch (word.type) {
    case WordType::kInt32:
      return detail::load<std::int32_t>(at, swap);
    case WordType::kInt16:
      return detail::load<std::int16_t>(at, swap);
    case WordType::kIeee:
      return detail::load<float>(at, swap);
    case WordType::kIbm:
      return ibm_to_float(detail::load<std::uint32_t>(at, swap));
    case WordType::kFloat64:
      return detail::load<double>(at, swap);
    case WordType::kOrder:
      return static_cast<double>(trace + 1);
    case WordType::kNone:
      break;
  }
  return 0;
}

}  // namespace footwall::formats::segy
