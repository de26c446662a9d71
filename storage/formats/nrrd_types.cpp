#include <algorithm>
#include <iterator>

#include "storage/formats/detail/letters.h"
#include "storage/formats/nrrd.h"

namespace footwall::formats::nrrd {
namespace {

struct TypeName {
  std::string_view name;
  SampleType type;
};
// All the spellings that the definition lists.
constexpr TypeName kTypes[] = {{"signed char", SampleType::kInt8},
                               {"int8", SampleType::kInt8},
                               {"int8_t", SampleType::kInt8},
                               {"uchar", SampleType::kUint8},
                               {"unsigned char", SampleType::kUint8},
                               {"uint8", SampleType::kUint8},
                               {"uint8_t", SampleType::kUint8},
                               {"short", SampleType::kInt16},
                               {"short int", SampleType::kInt16},
                               {"signed short", SampleType::kInt16},
                               {"signed short int", SampleType::kInt16},
                               {"int16", SampleType::kInt16},
                               {"int16_t", SampleType::kInt16},
                               {"ushort", SampleType::kUint16},
                               {"unsigned short", SampleType::kUint16},
                               {"unsigned short int", SampleType::kUint16},
                               {"uint16", SampleType::kUint16},
                               {"uint16_t", SampleType::kUint16},
                               {"int", SampleType::kInt32},
                               {"signed int", SampleType::kInt32},
                               {"int32", SampleType::kInt32},
                               {"int32_t", SampleType::kInt32},
                               {"uint", SampleType::kUint32},
                               {"unsigned int", SampleType::kUint32},
                               {"uint32", SampleType::kUint32},
                               {"uint32_t", SampleType::kUint32},
                               {"longlong", SampleType::kInt64},
                               {"long long", SampleType::kInt64},
                               {"long long int", SampleType::kInt64},
                               {"signed long long", SampleType::kInt64},
                               {"signed long long int", SampleType::kInt64},
                               {"int64", SampleType::kInt64},
                               {"int64_t", SampleType::kInt64},
                               {"ulonglong", SampleType::kUint64},
                               {"unsigned long long", SampleType::kUint64},
                               {"unsigned long long int", SampleType::kUint64},
                               {"uint64", SampleType::kUint64},
                               {"uint64_t", SampleType::kUint64},
                               {"float", SampleType::kFloat32},
                               {"double", SampleType::kFloat64}};

}  // namespace

std::optional<SampleType> type_named(std::string_view word) {
  const std::string wanted = detail::lower(word);
  const auto* found = std::find_if(std::begin(kTypes), std::end(kTypes),
                                   [&](const TypeName& row) { return row.name == wanted; });
  if (found == std::end(kTypes)) return std::nullopt;
  return found->type;
}

std::string_view name_of(SampleType type) {
  constexpr std::string_view kNames[] = {"int8",   "uint8", "int16",  "uint16", "int32",
                                         "uint32", "int64", "uint64", "float",  "double"};
  return kNames[static_cast<std::size_t>(type)];
}

std::int64_t size_of(SampleType type) {
  constexpr std::int64_t kSizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

}  // namespace footwall::formats::nrrd
