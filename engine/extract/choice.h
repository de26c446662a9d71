// An algorithm by name with its parameters, as options write it: "manhattan=5,2", "local=0,cache", "push".
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace footwall::extract {

struct Choice {
  std::string name;
  std::vector<std::string> parameters;  // what stands behind '=', split at commas; empty without '='

  // The parameter at `place` as a number of [least, most]; `otherwise` where there are fewer. Throws kUsage
  // naming the choice and the parameter for anything else.
  double number(std::size_t place, std::string_view what, double otherwise, double least, double most) const;
  std::int64_t whole(std::size_t place, std::string_view what, std::int64_t otherwise, std::int64_t least,
                     std::int64_t most) const;
  // Throws kUsage where there are more than `most` parameters.
  void takes_at_most(std::size_t most) const;
  // As it was written.
  std::string text() const;
  friend bool operator==(const Choice&, const Choice&) = default;
};

// Never throws: names and parameters are checked by the row that is named (registry.h).
Choice parse_choice(std::string_view text);

}  // namespace footwall::extract
