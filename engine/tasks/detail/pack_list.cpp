#include "engine/tasks/detail/pack_list.h"

#include <nlohmann/json.hpp>

#include "storage/base/error.h"
#include "storage/base/hash.h"

namespace footwall::tasks::detail {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormatName = "footwall pack";
constexpr int kVersion = 1;

}  // namespace

std::string volumes_folder_of(const std::string& project) {
  return project + ".volumes";
}
std::string list_name_of(const std::string& project) {
  return project + ".pack.json";
}

std::string to_json(const PackList& list) {
  Json files = Json::array();
  for (const PackList::File& file : list.files)
    files.push_back({{"name", file.name}, {"bytes", file.bytes}, {"xxh3", to_hex(file.hash)}});
  return Json{{"format", kFormatName},     {"version", kVersion},     {"project", list.project},
              {"files", std::move(files)}, {"volumes", list.volumes}, {"missing", list.missing}}
             .dump(1) +
         "\n";
}

PackList pack_list_from(const std::string& text) {
  const Error foreign(ErrorCode::kFormat, "the archive's list of files cannot be read",
                      "it was not made by footwall pack");
  try {
    const Json json = Json::parse(text);
    if (json.at("format") != kFormatName) throw foreign;
    if (json.at("version").get<int>() > kVersion) {
      throw Error(ErrorCode::kUnsupported, "the archive was made by a newer Footwall", "update this one");
    }
    PackList list;
    list.project = json.at("project").get<std::string>();
    for (const Json& file : json.at("files")) {
      list.files.push_back({file.at("name").get<std::string>(), file.at("bytes").get<std::int64_t>(),
                            hash_from_hex(file.at("xxh3").get<std::string>())});
    }
    list.volumes = json.at("volumes").get<std::vector<std::string>>();
    list.missing = json.at("missing").get<std::vector<std::string>>();
    return list;
  } catch (const Json::exception&) {
    throw foreign;
  }
}

}  // namespace footwall::tasks::detail
