// SEG-Y: the header pass with several options, then every sample.
#include "fuzz/memory_file.h"
#include "fuzz/target.h"
#include "storage/base/error.h"
#include "storage/formats/segy/segy_file.h"

namespace footwall::fuzz {
namespace {

// Gaps may make a survey much larger than its file; then its corners stand for it.
constexpr std::int64_t kMostSamples = 1 << 14;

bool reads_alike(const formats::segy::SegyFile& file) {
  survey::Box box = file.geometry().box();
  if (box.count() > kMostSamples || box.count() < 0) {
    for (int axis = 0; axis < 3; ++axis) box.hi[axis] = std::min<std::int64_t>(box.hi[axis], 8);
  }
  const auto traces = static_cast<std::size_t>(box.size(0) * box.size(1));
  std::vector<float> values(static_cast<std::size_t>(box.count()), 1.0F);
  std::vector<std::uint8_t> live(traces, 7);
  file.read_block(box, values, live);
  const auto samples = static_cast<std::size_t>(box.size(2));
  for (std::size_t trace = 0; trace < traces; ++trace) {
    if (live[trace] > 1) return false;
    // A trace that is not there has no samples.
    for (std::size_t k = 0; k < samples; ++k) {
      if (live[trace] == 0 && !std::isnan(values[trace * samples + k])) return false;
    }
  }
  return true;
}

bool run(const std::string& bytes) {
  const MemoryFile file(bytes);
  formats::segy::looks_like_segy(file.path());
  formats::segy::Options given;
  given.format = 1 + static_cast<int>(bytes.size() % 16);
  given.endian = bytes.size() % 2 == 0 ? formats::segy::Endian::kBig : formats::segy::Endian::kLittle;
  given.interval = 4;
  for (const formats::segy::Options& options : {formats::segy::Options{}, given}) {
    try {
      const auto segy = formats::segy::SegyFile::scan(file.path(), options);
      segy.geometry().validate();
      if (!reads_alike(segy)) return false;
    } catch (const Error& error) {
      if (error.code() == ErrorCode::kInternal) throw;
    }
  }
  return true;
}

// Two inlines of two traces of four IBM zeros: headers of zeros but for what makes it a survey.
std::string small_file() {
  std::string bytes(3600 + 4 * (240 + 16), '\0');
  const auto put = [&](std::size_t at, int size, int value) {
    for (int n = size - 1; n >= 0; --n, value >>= 8)
      bytes[at + static_cast<std::size_t>(n)] = static_cast<char>(value);
  };
  std::fill_n(bytes.begin(), 3200, '\x40');
  put(3216, 2, 4000);
  put(3220, 2, 4);
  put(3224, 2, 1);
  for (std::size_t n = 0; n < 4; ++n) {
    const std::size_t at = 3600 + n * 256;
    put(at + 28, 2, 1);
    put(at + 114, 2, 4);
    put(at + 180, 4, static_cast<int>(100 * (n / 2)));
    put(at + 184, 4, static_cast<int>(100 * (n % 2)));
    put(at + 188, 4, static_cast<int>(1 + n / 2));
    put(at + 192, 4, static_cast<int>(1 + n % 2));
  }
  return bytes;
}

}  // namespace

Target fuzz_target() {
  return {{"equinor+segyio/test-data/*.sgy", "equinor+seismic-zfp/test_data/*.sgy",
           "equinor+seismic-zfp/test_data/padding/*.sgy",
           "obspy+obspy/obspy/io/segy/tests/data/*.sgy_first_trace"},
          {small_file()},
          run};
}

}  // namespace footwall::fuzz
