#include "engine/extract/lapped/columns.h"

namespace footwall::extract::lapped {

void Columns::clear() {
  rows.clear();
  lengths.clear();
  voxels = 0;
}

void Columns::add(std::int64_t u, std::int64_t v, std::int32_t length) {
  if (rows.empty() || rows.back().v != v ||
      rows.back().u + static_cast<std::int64_t>(rows.back().count) != u) {
    rows.push_back({v, u, lengths.size(), 0});
  }
  ++rows.back().count;
  lengths.push_back(length);
  voxels += length;
}

}  // namespace footwall::extract::lapped
