#include "engine/extract/cost/rates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "storage/base/error.h"

namespace footwall::extract {
namespace {

using Json = nlohmann::json;

struct Entry {
  const char* name;
  double MachineRates::*value;
  bool of_links;  // 0 where there is one rank
};
constexpr std::array kEntries{Entry{"alpha", &MachineRates::alpha, true},
                              Entry{"overhead", &MachineRates::overhead, true},
                              Entry{"byte", &MachineRates::byte, true},
                              Entry{"voxelize", &MachineRates::voxelize, false},
                              Entry{"gather", &MachineRates::gather, false},
                              Entry{"fold", &MachineRates::fold, false},
                              Entry{"fold_discontinuity", &MachineRates::fold_discontinuity, false},
                              Entry{"pack", &MachineRates::pack, false},
                              Entry{"face", &MachineRates::face, false},
                              Entry{"finish", &MachineRates::finish, false},
                              Entry{"balance", &MachineRates::balance, false}};

double checked(double value, bool may_be_zero, const std::string& name) {
  // An hour for a voxel or a message is damage, too.
  constexpr double kMost = 3600;
  if (std::isfinite(value) && value < kMost && (value > 0 || (may_be_zero && value == 0))) return value;
  throw Error(ErrorCode::kFormat, "the rate " + name + " is no number of seconds");
}

}  // namespace

double MachineRates::whole_face_voxel(const std::string& name) const {
  const auto found = std::find_if(whole_face.begin(), whole_face.end(),
                                  [&](const WholeFace& each) { return each.name == name; });
  return found == whole_face.end() ? gather : found->voxel;
}

std::string to_text(const MachineRates& rates) {
  Json json{{"ranks", rates.ranks}, {"cores", rates.cores}};
  for (const Entry& entry : kEntries) json["seconds"][entry.name] = rates.*entry.value;
  json["whole_face"] = Json::object();
  for (const MachineRates::WholeFace& each : rates.whole_face) json["whole_face"][each.name] = each.voxel;
  return json.dump();
}

MachineRates rates_from(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    MachineRates rates;
    json.at("ranks").get_to(rates.ranks);
    json.at("cores").get_to(rates.cores);
    if (rates.ranks < 1 || rates.cores < 1) throw Error(ErrorCode::kFormat, "rates of no ranks or no cores");
    for (const Entry& entry : kEntries) {
      rates.*entry.value = checked(json.at("seconds").at(entry.name).get<double>(),
                                   entry.of_links && rates.ranks == 1, entry.name);
    }
    for (const auto& [name, voxel] : json.at("whole_face").items())
      rates.whole_face.push_back({name, checked(voxel.get<double>(), false, name)});
    return rates;
  } catch (const Json::exception&) {
    throw Error(ErrorCode::kFormat, "the rates of a machine cannot be read");
  }
}

}  // namespace footwall::extract
