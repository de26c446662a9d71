// A table of words, for a terminal or as Markdown.
#pragma once
#include <string>
#include <vector>

namespace footwall::tasks {

struct Table {
  std::string title;
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;  // each as long as the header
};

// The first column is left-aligned, the others right-aligned.
std::string to_text(const Table& table);
std::string to_markdown(const Table& table);

}  // namespace footwall::tasks
