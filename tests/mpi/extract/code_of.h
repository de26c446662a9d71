// The kind of error that a call ends with.
#pragma once
#include <optional>

#include "storage/base/error.h"

namespace footwall {

// None where it ends without.
template <typename Call>
std::optional<ErrorCode> code_of(Call&& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.code();
  }
  return std::nullopt;
}

}  // namespace footwall
