// The job files of the engine's commands: one JSON object of at most 1 MiB.
#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace footwall::session {

// Whole or not at all. `paths`: those in it, in words, for the Error kUnsupported that is thrown where one is
// not UTF-8: "the path /a/b: it is not UTF-8". Throws kIo.
void write_job_json(const nlohmann::json& json, const std::filesystem::path& path, const std::string& paths,
                    const std::string& hint = "rename it");
// What is no JSON comes as a discarded value, whose at() throws. Throws kNotFound, kIo.
nlohmann::json read_job_json(const std::filesystem::path& path);

}  // namespace footwall::session
