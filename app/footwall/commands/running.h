// Which running engine a command is about.
#pragma once
#include <string>

#include "engine/service/client/connection_file.h"

namespace footwall::commands {

// words: "@FILE"; an address ("unix:PATH", "tcp:HOST:PORT", the token in the environment); a project that is
// served; empty: the engine that is served without a project. Throws Error kNotFound, naming what is served
// by this user, and as service::connection_from().
service::Connection running_engine(const std::string& words);

}  // namespace footwall::commands
