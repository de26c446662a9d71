// The tables under undo as text, every column of every row exactly: what two states of an interpretation are
// compared by.
#pragma once
#include <sqlite3.h>

#include <filesystem>
#include <memory>
#include <string>

#include "storage/base/error.h"

namespace footwall::ui {

// Of the project at this path, which may be open here. Throws Error where the file cannot be read.
inline std::string interpretation_text(const std::filesystem::path& path) {
  sqlite3* opened = nullptr;
  const int rc = sqlite3_open_v2(path.c_str(), &opened, SQLITE_OPEN_READONLY, nullptr);
  const std::unique_ptr<sqlite3, decltype(&sqlite3_close)> database(opened, &sqlite3_close);
  const auto run = [&](const std::string& sql) {
    std::string text;
    const auto add = [](void* to, int count, char** values, char**) {
      for (int c = 0; c < count; ++c) *static_cast<std::string*>(to) += values[c];
      *static_cast<std::string*>(to) += "\n";
      return 0;
    };
    if (rc != SQLITE_OK || sqlite3_exec(opened, sql.c_str(), add, &text, nullptr) != SQLITE_OK) {
      throw Error(ErrorCode::kIo, std::string("cannot read the interpretation: ") + sqlite3_errmsg(opened));
    }
    return text;
  };
  std::string all;
  for (const std::string table : {"fault", "pillar", "pillar_node", "surface"}) {
    std::string columns = run(
        "SELECT group_concat('quote(' || name || ')', '||''|''||') FROM pragma_table_info('" + table + "')");
    columns.pop_back();
    all += table + "\n" + run("SELECT " + columns + " FROM " + table + " ORDER BY id");
  }
  return all;
}

}  // namespace footwall::ui
