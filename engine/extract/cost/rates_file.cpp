#include "engine/extract/cost/rates_file.h"

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <span>
#include <system_error>

#include "storage/base/error.h"
#include "storage/base/hash.h"
#include "storage/base/partial_file.h"

namespace footwall::extract {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

// Counts up where the meaning of a rate, or how it is measured, changes.
constexpr int kVersion = 3;
constexpr std::size_t kLargest = 1 << 16;

Json json_of(const RatesKey& key) {
  return {{"host", key.host},
          {"mpi", key.mpi},
          {"computations", key.computations},
          {"ranks", key.ranks},
          {"cores", key.cores}};
}

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string() : std::string(value);
}

}  // namespace

fs::path rates_folder() {
  // As the XDG base directory specification has it: what is not absolute is ignored.
  const fs::path cache = environment("XDG_CACHE_HOME");
  if (cache.is_absolute()) return cache / "footwall";
  const fs::path home = environment("HOME");
  return home.is_absolute() ? home / ".cache" / "footwall" : fs::path();
}

fs::path rates_path(const fs::path& folder, const RatesKey& key) {
  const std::string name = json_of(key).dump(-1, ' ', false, Json::error_handler_t::replace);
  return folder / ("rates-" + to_hex(hash64(std::as_bytes(std::span(name)))) + ".json");
}

std::optional<MachineRates> read_rates(const fs::path& folder, const RatesKey& key) {
  if (folder.empty()) return std::nullopt;
  try {
    const Json json = Json::parse(read_whole_file(rates_path(folder, key), kLargest));
    if (json.at("footwall_rates") != kVersion || json.at("of") != json_of(key)) return std::nullopt;
    const std::string text = json.at("rates").get<std::string>();
    if (json.at("hash") != to_hex(hash64(std::as_bytes(std::span(text))))) return std::nullopt;
    return rates_from(text);
  } catch (const Json::exception&) {
    return std::nullopt;
  } catch (const Error&) {  // not there, not readable, damaged: all of them mean "measure again"
    return std::nullopt;
  }
}

bool write_rates(const fs::path& folder, const RatesKey& key, const MachineRates& rates) {
  if (folder.empty()) return false;
  try {
    std::error_code failure;
    const bool made = fs::create_directories(folder, failure);
    if (failure) return false;
    if (made) fs::permissions(folder, fs::perms::owner_all, failure);
    const std::string text = to_text(rates);
    const Json json{{"footwall_rates", kVersion},
                    {"of", json_of(key)},
                    {"rates", text},
                    {"hash", to_hex(hash64(std::as_bytes(std::span(text))))}};
    const fs::path path = rates_path(folder, key);
    write_whole_file(path, json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
    fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write, failure);
    return true;
  } catch (const Error&) {  // a full or read-only home: measured again next time
    return false;
  }
}

}  // namespace footwall::extract
