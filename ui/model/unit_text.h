// Units as people write them.
#pragma once
#include <QString>
#include <string>

namespace footwall::ui {

// Of a statistic's unit_rule: "amplitude^2" -> "amplitude²", "1" -> "".
QString unit_text(const std::string& unit_rule);

}  // namespace footwall::ui
