#include <nlohmann/json.hpp>

#include "engine/session/picture_costs.h"

namespace footwall::session {

nlohmann::json picture_costs(const comm::Communicator& world, double read_seconds, double extract_seconds,
                             const render::ComposeReport& report) {
  return {{"ranks", world.size()},
          {"bytes_sent", world.sum(report.bytes)},
          {"messages", world.sum(report.messages)},
          {"merged_bytes", world.sum(report.merged_bytes)},
          {"merged_pixels", world.sum(report.merged_pixels)},
          {"seconds",
           {{"read", world.maximum(read_seconds)},
            {"extract", world.maximum(extract_seconds)},
            {"group", world.maximum(report.seconds.group)},
            {"project", world.maximum(report.seconds.project)},
            {"rasterize", world.maximum(report.seconds.rasterize)},
            {"shade", world.maximum(report.seconds.shade)},
            {"merge", world.maximum(report.seconds.merge)},
            {"gather", world.maximum(report.seconds.gather)}}}};
}

}  // namespace footwall::session
