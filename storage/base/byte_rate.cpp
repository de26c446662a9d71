#include "storage/base/byte_rate.h"

#include <fmt/format.h>

namespace footwall {
namespace {

constexpr std::chrono::seconds kWindow{2};
constexpr std::chrono::milliseconds kShortest{50};  // a rate over less says nothing

}  // namespace

std::string ByteRate::text(std::int64_t done, Clock::time_point now) {
  const auto rate = [&](std::int64_t bytes, Clock::time_point since) {
    return static_cast<double>(bytes) * 1e-6 / std::chrono::duration<double>(now - since).count();
  };
  if (now - marked_at_ >= kWindow) {
    window_rate_ = rate(done - marked_, marked_at_);
    marked_ = done;
    marked_at_ = now;
  }
  std::string text = fmt::format("{:.0f} of {:.0f} MB", static_cast<double>(done) * 1e-6,
                                 static_cast<double>(total_) * 1e-6);
  if (done == 0 || now - start_ < kShortest) return text;
  const bool of_all = !window_rate_ || done >= total_;
  return text + fmt::format("  {:.0f} MB/s", of_all ? rate(done, start_) : *window_rate_);
}

}  // namespace footwall
