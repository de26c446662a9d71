// The codes of faces' voxels: whatever the bytes, the decoder gives as many values as the face has voxels,
// the same ones twice, or says that they are corrupt. The first byte of an input chooses the face.
#include <cmath>

#include "engine/extract/lapped/face_code.h"
#include "fuzz/target.h"

namespace footwall::fuzz {
namespace {

using namespace extract::lapped;

constexpr int kShapes = 6;

Columns shape(int n) {
  Columns columns;
  const std::int64_t side = 3 + 9 * n;
  for (std::int64_t v = 0; v < side; ++v) {
    for (std::int64_t u = v / 2; u < side - v / 4; ++u)
      columns.add(u, v, static_cast<std::int32_t>((u + v * n) % (n + 1)));
  }
  return columns;
}

std::vector<float> values_of(const Columns& columns) {
  std::vector<float> values;
  for (std::int64_t n = 0; n < columns.voxels; ++n) {
    values.push_back(n % 97 == 5 ? std::numeric_limits<float>::quiet_NaN()
                                 : static_cast<float>((n * 7919) % 101) + static_cast<float>(n % 13));
  }
  return values;
}

bool run(const std::string& bytes) {
  if (bytes.empty()) return true;
  const Columns columns = shape(static_cast<unsigned char>(bytes[0]) % kShapes);
  const auto code = std::as_bytes(std::span(bytes)).subspan(1);
  FaceDecoder decoder;
  std::vector<float> values(static_cast<std::size_t>(columns.voxels));
  std::vector<float> again(values.size());
  decoder.decode(code, columns, values);
  decoder.decode(code, columns, again);
  return std::equal(values.begin(), values.end(), again.begin(),
                    [](float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); });
}

std::string made(int n, const Coding& coding) {
  const Columns columns = shape(n);
  std::vector<std::byte> code;
  FaceEncoder(coding).encode(columns, values_of(columns), code);
  std::string bytes(1, static_cast<char>(n));
  bytes.append(reinterpret_cast<const char*>(code.data()), code.size());
  return bytes;
}

}  // namespace

Target fuzz_target() {
  Target target{{}, {}, run};
  for (int n = 1; n < kShapes; ++n) {
    target.made.push_back(made(n, {20, Order::kRaster}));
    target.made.push_back(made(n, {50, Order::kLine, Angles::kTuned, Angles::kStandard, Ends::kZero}));
  }
  return target;
}

}  // namespace footwall::fuzz
