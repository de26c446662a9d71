#include "engine/extract/registry.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "engine/extract/balance/balance.h"
#include "engine/extract/computations.h"
#include "engine/extract/exchange/exchange.h"
#include "engine/voxelize/registry.h"
#include "storage/base/error.h"

namespace footwall::extract {
namespace {

template <class Strategy>
std::vector<Row> rows_of(std::span<const Strategy> strategies) {
  std::vector<Row> rows;
  for (const Strategy& strategy : strategies) {
    rows.push_back({strategy.name, strategy.run != nullptr, strategy.help});
  }
  return rows;
}

}  // namespace

std::span<const Row> exchange_rows() {
  static const std::vector<Row> rows = rows_of(exchange_strategies());
  return rows;
}
std::span<const Row> balance_rows() {
  static const std::vector<Row> rows = rows_of(balance_strategies());
  return rows;
}
std::span<const Row> voxelizer_rows() {
  static const std::vector<Row> rows = [] {
    std::vector<Row> known;
    for (const voxelize::Method& method : voxelize::methods()) {
      known.push_back({method.name, method.make != nullptr, method.help});
    }
    return known;
  }();
  return rows;
}
std::span<const Row> statistic_rows() {
  static const std::vector<Row> rows = [] {
    std::vector<Row> known;
    for (const Computation& each : computations()) known.push_back({each.name, each.built, each.help});
    return known;
  }();
  return rows;
}

const Row& find_row(std::span<const Row> rows, std::string_view family, std::string_view text) {
  const std::size_t equals = text.find('=');
  const std::string_view name = text.substr(0, equals);
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return r.name == name; });
  std::string built;
  for (const Row& each : rows) {
    if (each.built) built += (built.empty() ? "" : ", ") + std::string(each.name);
  }
  if (row == rows.end()) {
    throw Error(ErrorCode::kUsage, "there is no " + std::string(family) + " '" + std::string(text) + "'",
                "choose one of: " + built);
  }
  if (!row->built) {
    throw Error(ErrorCode::kUsage, std::string(family) + " '" + std::string(name) + "' is not built yet",
                "choose one of: " + built);
  }
  return *row;
}

}  // namespace footwall::extract
