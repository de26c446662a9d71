// Errors and texts on their way to a client.
#pragma once
#include <string>
#include <string_view>

#include "engine/service/engine.pb.h"
#include "storage/base/error.h"

namespace footwall::service {

// At most 1 KiB a text, since it travels in a header.
v1::Failure failure_of(const Error& error);
// Bytes that are not UTF-8 replaced by "?": messages hold nothing else, file names may. Cut before `most`.
std::string utf8_of(std::string_view text, std::size_t most = std::string::npos);

}  // namespace footwall::service
