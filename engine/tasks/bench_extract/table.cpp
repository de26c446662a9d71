#include "engine/tasks/bench_extract/table.h"

#include <fmt/format.h>

#include <algorithm>

#include "storage/base/error.h"

namespace footwall::tasks {
namespace {

std::vector<std::size_t> widths(const Table& table) {
  std::vector<std::size_t> widths;
  for (const std::string& word : table.header) widths.push_back(word.size());
  for (const std::vector<std::string>& row : table.rows) {
    require(row.size() == widths.size(), "a word for every column");
    for (std::size_t n = 0; n < row.size(); ++n) widths[n] = std::max(widths[n], row[n].size());
  }
  return widths;
}

}  // namespace

std::string to_text(const Table& table) {
  const std::vector<std::size_t> wide = widths(table);
  std::string text = table.title + "\n";
  const auto line = [&](const std::vector<std::string>& words) {
    for (std::size_t n = 0; n < words.size(); ++n)
      text += n == 0 ? fmt::format("{:<{}}", words[n], wide[n]) : fmt::format("  {:>{}}", words[n], wide[n]);
    text += "\n";
  };
  line(table.header);
  for (const std::vector<std::string>& row : table.rows) line(row);
  return text + "\n";
}

std::string to_markdown(const Table& table) {
  widths(table);  // checks
  std::string text = "**" + table.title + "**\n\n";
  const auto line = [&](const std::vector<std::string>& words) {
    text += fmt::format("| {} |\n", fmt::join(words, " | "));
  };
  line(table.header);
  text += "|---";
  for (std::size_t n = 1; n < table.header.size(); ++n) text += "|--:";
  text += "|\n";
  for (const std::vector<std::string>& row : table.rows) line(row);
  return text + "\n";
}

}  // namespace footwall::tasks
