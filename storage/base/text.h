// Words and numbers of text files, read and printed without locale.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace footwall::text {

std::string_view trimmed(std::string_view line);
// Fields between runs of blanks and tabs.
std::vector<std::string_view> words(std::string_view line);
// Fields between single separators, trimmed.
std::vector<std::string_view> split(std::string_view line, char separator);
// The whole word must be the number; nothing otherwise. Accepts a leading '+'; never locale dependent.
std::optional<double> number(std::string_view word);
std::optional<std::int64_t> integer(std::string_view word);
// The shortest decimal text that reads back as the same double; "" for NaN (the CSV rule), "inf"/"-inf".
std::string shortest(double value);

}  // namespace footwall::text
