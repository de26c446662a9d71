// Messages for the person at the terminal; all of them go to stderr, so that stdout stays the result.
#pragma once
#include <string_view>

namespace footwall::log {

void info(std::string_view message);
void warn(std::string_view message);
void error(std::string_view message);
// Messages below warning are dropped (--quiet).
void set_quiet(bool quiet);

}  // namespace footwall::log
