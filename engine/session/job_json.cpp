#include "engine/session/job_json.h"

#include <nlohmann/json.hpp>

#include "storage/base/error.h"
#include "storage/base/partial_file.h"

namespace footwall::session {
namespace {

constexpr std::size_t kJobLimit = std::size_t{1} << 20;

}  // namespace

void write_job_json(const nlohmann::json& json, const std::filesystem::path& path, const std::string& paths,
                    const std::string& hint) {
  std::string text;
  try {
    text = json.dump(1) + "\n";
  } catch (const nlohmann::json::exception&) {
    throw Error(ErrorCode::kUnsupported, "the engine cannot be told " + paths, hint);
  }
  write_whole_file(path, text);
}

nlohmann::json read_job_json(const std::filesystem::path& path) {
  return nlohmann::json::parse(read_whole_file(path, kJobLimit), nullptr, false);
}

}  // namespace footwall::session
