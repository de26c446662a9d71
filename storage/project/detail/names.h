// What may stand in the project as a name or a note.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace footwall::project::detail {

// Throws kInvalid for an empty name, one over 200 bytes, control characters, bytes that are not UTF-8, or
// blanks at an end. what: "fault", "volume" ...
void check_name(std::string_view what, const std::string& name);
// The same for free text: UTF-8, at most 100,000 bytes, line breaks and tabs allowed.
void check_text(std::string_view what, const std::string& text);
// "'a', 'b'" for messages, cut after ten.
std::string listed(const std::vector<std::string>& names);

}  // namespace footwall::project::detail
