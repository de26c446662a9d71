#include "storage/formats/missing_options.h"

#include <fmt/format.h>

#include <string>

#include "storage/base/error.h"

namespace footwall::formats {

void refuse_missing(const std::vector<MissingOption>& missing) {
  if (missing.empty()) return;
  std::string names, meanings, values;
  for (const MissingOption& option : missing) {
    const bool is_first = names.empty();
    const bool is_last = &option == &missing.back();
    names += fmt::format("{}{}", is_first ? "" : is_last ? " and " : ", ", option.name);
    meanings += fmt::format("{}{}", is_first ? "" : is_last ? " or " : ", ", option.meaning);
    values += fmt::format("{}{} ({})", is_first ? "" : ", ", option.name, option.values);
  }
  throw Error(ErrorCode::kUsage,
              fmt::format("{} {} missing: the file cannot tell {}", names, missing.size() == 1 ? "is" : "are",
                          meanings),
              fmt::format("add {}", values));
}

}  // namespace footwall::formats
