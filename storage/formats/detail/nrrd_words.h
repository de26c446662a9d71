// The values of NRRD's fields: vectors in brackets and words in quotes.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace footwall::formats::nrrd {

// "(1,2,3)"; nothing for anything else, also for "none". Numbers may be nan and inf.
std::optional<std::vector<double>> vector_from(std::string_view word);
// Words between blanks; vectors may have blanks inside their brackets.
std::vector<std::string_view> vector_words(std::string_view value);
// Words between blanks or inside quotes, as valid UTF-8.
std::vector<std::string> quoted_words(std::string_view value);

}  // namespace footwall::formats::nrrd
