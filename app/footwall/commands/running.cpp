#include "app/footwall/commands/running.h"

#include "storage/base/error.h"

namespace footwall::commands {
namespace {

// "a.footwall, b.footwall"; empty where nothing is served.
std::string served_by_this_user() {
  std::string names;
  std::error_code ignored;
  const std::filesystem::path folder = service::default_connection_file({}).parent_path();
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    if (entry.path().extension() != ".json") continue;
    try {
      const service::Connection connection = service::read_connection(entry.path());
      const std::string name = connection.project.empty() ? "one without a project" : connection.project;
      names += (names.empty() ? "" : ", ") + name;
    } catch (const Error&) {
      // It went away, or is none.
    }
  }
  return names;
}

}  // namespace

service::Connection running_engine(const std::string& words) {
  if (words.starts_with("@") || words.starts_with("unix:") || words.starts_with("tcp:"))
    return service::connection_from(words);
  try {
    return service::read_connection(service::default_connection_file(words));
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kNotFound) throw;
    const std::string served = served_by_this_user();
    throw Error(ErrorCode::kNotFound,
                words.empty() ? "no engine runs here without a project" : "no engine serves " + words,
                (served.empty() ? "footwall serve starts one" : "these run: " + served) +
                    "; one that was started with --connection FILE is found as @FILE");
  }
}

}  // namespace footwall::commands
