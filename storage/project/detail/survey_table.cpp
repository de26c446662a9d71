#include "storage/project/detail/survey_table.h"

#include <nlohmann/json.hpp>

#include "storage/base/error.h"

namespace footwall::project::detail {
namespace {

survey::LineAxis axis(const Query& row, int column) {
  return {static_cast<std::int32_t>(row.integer(column)), static_cast<std::int32_t>(row.integer(column + 1)),
          row.integer(column + 2)};
}

}  // namespace

std::optional<survey::Geometry> SurveyTable::read() const {
  Query row(database_,
            "SELECT inline_first, inline_step, inline_count, crossline_first, crossline_step, "
            "crossline_count, samples,"
            " z0, sample_interval, domain, vertical_unit, origin_x, origin_y, per_inline_x, per_inline_y,"
            " per_crossline_x, per_crossline_y, crs, horizontal_unit, assumed FROM survey");
  if (!row.next()) return std::nullopt;
  try {
    survey::Geometry g;
    g.inlines = axis(row, 0);
    g.crosslines = axis(row, 3);
    g.samples = row.integer(6);
    g.z0 = row.real(7);
    g.interval = row.real(8);
    g.domain = survey::domain_from(row.text(9));
    g.vertical_unit = survey::vertical_unit_from(row.text(10));
    g.map = {row.real(11), row.real(12), row.real(13), row.real(14), row.real(15), row.real(16)};
    g.crs = row.text(17);
    g.horizontal_unit = row.text(18);
    g.assumed = nlohmann::json::parse(row.text(19)).get<std::vector<std::string>>();
    g.validate();
    return g;
  } catch (const nlohmann::json::exception&) {
    throw Error(ErrorCode::kCorrupt, "the project's list of assumptions about the survey cannot be read");
  } catch (const Error& error) {
    throw Error(ErrorCode::kCorrupt, "the project's survey cannot be used: " + error.message());
  }
}

std::string SurveyTable::provenance() const {
  Query row(database_, "SELECT provenance FROM survey");
  return row.next() ? row.text(0) : "{}";
}

void SurveyTable::write(const survey::Geometry& g, const std::string& provenance) {
  Query(database_,
        "INSERT OR REPLACE INTO survey(id, inline_first, inline_step, inline_count, crossline_first, "
        "crossline_step,"
        " crossline_count, samples, z0, sample_interval, domain, vertical_unit, origin_x, origin_y, "
        "per_inline_x,"
        " per_inline_y, per_crossline_x, per_crossline_y, crs, horizontal_unit, assumed, provenance)"
        " VALUES(1, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
        g.inlines.first, g.inlines.step, g.inlines.count, g.crosslines.first, g.crosslines.step,
        g.crosslines.count, g.samples, g.z0, g.interval, std::string(name_of(g.domain)),
        std::string(name_of(g.vertical_unit)), g.map.origin_x, g.map.origin_y, g.map.per_inline_x,
        g.map.per_inline_y, g.map.per_crossline_x, g.map.per_crossline_y, g.crs, g.horizontal_unit,
        nlohmann::json(g.assumed).dump(), provenance)
      .run();
}

std::optional<std::string> SurveyTable::setting(const std::string& name) const {
  Query row(database_, "SELECT value FROM setting WHERE name = ?", name);
  return row.next() ? std::optional(row.text(0)) : std::nullopt;
}

void SurveyTable::set_setting(const std::string& name, const std::string& value) {
  Query(database_, "INSERT OR REPLACE INTO setting(name, value) VALUES(?, ?)", name, value).run();
}

}  // namespace footwall::project::detail
