#include "bench/ingest/segyio_reader.h"

#include <segyio/segy.h>

#include <bit>
#include <cerrno>
#include <memory>

#include "storage/base/error.h"

namespace footwall::bench {
namespace {

void check(int result, std::string_view what) {
  if (result != SEGY_OK) {
    throw Error(ErrorCode::kFormat, fmt::format("segyio cannot {} (its error {})", what, result));
  }
}

}  // namespace

SegyioResult read_with_segyio(const std::filesystem::path& path, bool mapped) {
  const std::unique_ptr<segy_file, int (*)(segy_file*)> file(segy_open(path.c_str(), "rb"), segy_close);
  if (!file) throw io_error("read", path, errno);
  std::vector<char> binary(static_cast<std::size_t>(segy_binheader_size()));
  check(segy_binheader(file.get(), binary.data()), "read the binary header");
  const int format = segy_format(binary.data());
  const int samples = segy_samples(binary.data());
  const long first = segy_trace0(binary.data());
  const int bytes = segy_trsize(format, samples);
  check(segy_set_format(file.get(), format), "take the format");
  int traces = 0;
  check(segy_traces(file.get(), &traces, first, bytes), "count the traces");
  if (mapped) check(segy_mmap(file.get()), "map the file");
  char header[SEGY_TRACE_HEADER_SIZE];
  std::vector<float> values(static_cast<std::size_t>(samples));
  SegyioResult result;
  for (int trace = 0; trace < traces; ++trace) {
    check(segy_traceheader(file.get(), trace, header, first, bytes), "read a trace header");
    check(segy_readtrace(file.get(), trace, values.data(), first, bytes), "read a trace");
    check(segy_to_native(format, samples, values.data()), "convert a trace");
    for (const float value : values) result.bit_sum += std::bit_cast<std::uint32_t>(value);
    ++result.traces;
  }
  return result;
}

}  // namespace footwall::bench
