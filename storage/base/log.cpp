#include "storage/base/log.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <memory>

namespace footwall::log {
namespace {

spdlog::logger& logger() {
  static const std::shared_ptr<spdlog::logger> instance = [] {
    auto made = spdlog::stderr_logger_mt("footwall");
    made->set_pattern("%v");
    return made;
  }();
  return *instance;
}

}  // namespace

void info(std::string_view message) {
  logger().info(message);
}
void warn(std::string_view message) {
  logger().warn("warning: {}", message);
}
void error(std::string_view message) {
  logger().error("error: {}", message);
}
void set_quiet(bool quiet) {
  logger().set_level(quiet ? spdlog::level::warn : spdlog::level::info);
}

}  // namespace footwall::log
