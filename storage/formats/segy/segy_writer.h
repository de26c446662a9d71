// SEG-Y out: big-endian, revision 1 with every trace header word that other programs look for; revision 2.0
// where revision 1 cannot say it (more than 65,535 samples, a sample interval that is no whole number of
// thousandths up to 32,767).
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "storage/base/job_context.h"
#include "storage/survey/geometry.h"

namespace footwall::formats::segy {

enum class Holes : std::uint8_t {
  kSkip,  // bins without a trace are left out
  kDead   // written as traces of zeros, trace identification code 2
};

struct WriteOptions {
  int format = 5;  // 5 IEEE float32, 1 IBM float32
  Holes holes = Holes::kSkip;
  std::optional<float> null_value;  // stands for nulls in live traces; left out: NaN in IEEE, 0 in IBM
  std::string title;                // project and volume, in words, for the textual header
  std::string source;               // where the volume came from
};

struct Written {
  std::int64_t traces = 0;
  std::int64_t dead = 0;     // of these, written for holes
  std::int64_t skipped = 0;  // holes left out
  std::int64_t nulls = 0;    // null samples inside live traces
  int revision = 1;
  int coordinate_scalar = 1;       // as at byte 71
  std::vector<std::string> notes;  // what the format could not hold, in words
};

// Fills values, [inline][crossline][sample], of the box; NaN is null.
using BlockReader = std::function<void(const survey::Box&, std::span<float>)>;

// Traces in the order of inlines, then crosslines. live: [inline][crossline], 1 where there is a trace. read
// is asked for slabs of whole inlines, chunk_lines at a time where these take at most 128 MiB, fewer
// otherwise. z0 goes to the delay (109 with the scalar at 215), in depth as well; a depth interval is written
// in thousandths of its unit, as is the custom. Throws kUsage for another format, kInvalid where there is no
// live trace, kIo (a full disk leaves no file), what read throws, kCancelled.
Written write(const std::filesystem::path& path, const survey::Geometry& geometry,
              std::span<const std::uint8_t> live, const BlockReader& read, std::int64_t chunk_lines,
              const WriteOptions& options, const JobContext& job = {});

// The IBM System/360 number nearest to a finite float, ties to the even fraction; every float is in range.
std::uint32_t ibm_from_float(float value);

}  // namespace footwall::formats::segy
