// The time as the project writes it.
#pragma once
#include <string>

namespace footwall::project::detail {

// Now, UTC, e.g. "2024-05-31T12:00:00Z".
std::string now_text();

}  // namespace footwall::project::detail
