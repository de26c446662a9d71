#include "storage/formats/detail/point_table.h"

#include <algorithm>
#include <string>
#include <vector>

#include "storage/base/text.h"
#include "storage/formats/detail/stick_collector.h"

namespace footwall::formats::detail {
namespace {

constexpr std::size_t kRowsLookedAt = 5000;

// Whether the column after z counts nodes: it rises by one from row to row and starts again within a fault.
// Stick numbers would come back after other sticks, which no program writes.
bool counts_nodes(std::string_view text, const PointTable& table) {
  std::vector<Field> fields;
  const std::size_t column = table.has_name ? 4 : 3;
  std::string_view name;
  double first = 0, last = 0;
  bool started = false, rose = false, again = false;
  for (const std::string_view row : first_rows(text, kRowsLookedAt)) {
    split_fields(row, table.delimiter, fields);
    const auto value = fields.size() > column ? text::number(fields[column].text) : std::nullopt;
    if (!value) continue;
    const bool same_fault = !table.has_name || name == fields[0].text;
    if (!started) {
      first = *value;
    } else if (*value == first) {
      if (*value == last) return false;
      again |= same_fault;
    } else if (!same_fault || *value != last + 1) {
      return false;
    } else {
      rose = true;
    }
    name = fields[0].text;
    last = *value;
    started = true;
  }
  return rose && again;
}

}  // namespace

char delimiter_of(std::span<const std::string_view> rows) {
  for (const char delimiter : {'\t', ';', ','}) {
    if (mostly(rows, [&](std::string_view row) { return row.find(delimiter) != std::string_view::npos; })) {
      return delimiter;
    }
  }
  return 0;
}

std::size_t leading_numbers(std::string_view row, char delimiter, std::size_t skipped) {
  std::vector<Field> fields;
  split_fields(row, delimiter, fields);
  std::size_t count = 0;
  while (skipped + count < fields.size() && text::number(fields[skipped + count].text)) ++count;
  return count;
}

SticksImport parse_point_table(std::string_view text, const PointTable& table, const SticksOptions& options,
                               std::string_view what, std::string_view hint) {
  StickCollector sticks(options);
  const std::size_t x = table.has_name ? 1 : 0;
  const bool nodes_counted = counts_nodes(text, table);
  if (nodes_counted) {
    sticks.assume("the column after z counts nodes, as it starts again: a stick ends where it does");
  }
  if (table.parted_by_blank_lines) sticks.parted_by_blank_lines();
  bool numbered = false;
  std::optional<std::int64_t> last_node;
  std::vector<Field> fields;
  for (Rows rows(text); rows.next();) {
    const std::string_view row = rows.row();
    if (text::trimmed(row).empty()) {
      sticks.end_stick();
      continue;
    }
    split_fields(row, table.delimiter, fields);
    const bool is_heading =
        sticks.read() == 0 && std::none_of(fields.begin(), fields.end(), [](const Field& field) {
          return text::number(field.text).has_value();
        });
    if (is_comment(row) || is_heading) {
      sticks.skip();
      continue;
    }
    try {
      Knot knot;
      knot.xy = {{number_of(field_at(fields, x, row, "X coordinate"), "X coordinate"),
                  number_of(field_at(fields, x + 1, row, "Y coordinate"), "Y coordinate")}};
      knot.z = number_of(field_at(fields, x + 2, row, "z"), "z");
      if (table.has_name) knot.name = fields[0].text;
      if (sticks.read() == 0) numbered = fields.size() > x + 3 && text::number(fields[x + 3].text);
      if (nodes_counted) {
        const std::int64_t node = integer_of(field_at(fields, x + 3, row, "node number"), "node number");
        if (last_node && node <= *last_node) sticks.end_stick();
        last_node = node;
      } else if (numbered) {
        knot.stick = integer_of(field_at(fields, x + 3, row, "stick number"), "stick number");
      }
      sticks.add(knot);
    } catch (const RowError& why) {
      sticks.reject(rows.number(), why);
    }
  }
  return sticks.finish(what, hint);
}

}  // namespace footwall::formats::detail
