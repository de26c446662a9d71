// The survey (one row) and the project's small settings.
#pragma once
#include <optional>
#include <string>

#include "storage/project/detail/database.h"
#include "storage/survey/geometry.h"

namespace footwall::project::detail {

class SurveyTable {
 public:
  explicit SurveyTable(Database& database) : database_(database) {}
  // Throws kCorrupt for a stored survey that cannot be one.
  std::optional<survey::Geometry> read() const;
  std::string provenance() const;
  void write(const survey::Geometry& geometry, const std::string& provenance);
  std::optional<std::string> setting(const std::string& name) const;
  void set_setting(const std::string& name, const std::string& value);

 private:
  Database& database_;
};

}  // namespace footwall::project::detail
