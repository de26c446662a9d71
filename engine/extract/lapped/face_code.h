// The values of a face's voxels as few bytes: lapped transform, quantization to a wanted signal-to-noise
// ratio, entropy coding; and the inverse. The bytes depend on the values and the shape alone: the same for
// every rank count, thread count and instruction set. docs/lapped-transform.md describes them.
#pragma once
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "engine/extract/lapped/columns.h"
#include "engine/extract/lapped/transform.h"

namespace footwall::extract::lapped {

enum class Order : std::uint8_t {
  kLine = 1,   // the values as one line, in the voxelizer's order (seed 004, section 5.2.1)
  kRaster = 2  // the columns of the face as a picture
};

// What stands before the first and behind the last block of a line.
enum class Ends : std::uint8_t {
  kMirrored = 0,
  kZero = 1  // costs one more block
};

inline constexpr double kLeastSnr = 1;
inline constexpr double kMostSnr = 100;

struct Coding {
  double snr_db = 30;  // 10 log10 of (variance of the values / mean square of their errors), per face
  Order order = Order::kRaster;
  Angles across = Angles::kStandard;  // kLine: the angles; kRaster: along u
  Angles down = Angles::kStandard;    // kRaster: along v
  Ends ends = Ends::kMirrored;        // of kLine
  friend bool operator==(const Coding&, const Coding&) = default;
};

// Throws Error kUsage for a ratio outside kLeastSnr..kMostSnr.
void validate(const Coding& coding);

// One per thread, used for face after face: its buffers are kept.
class FaceEncoder {
 public:
  explicit FaceEncoder(const Coding& coding);
  ~FaceEncoder();
  FaceEncoder(const FaceEncoder&) = delete;
  FaceEncoder& operator=(const FaceEncoder&) = delete;

  // Appends the code of a face to out. values stand in the order of the columns' voxels; NaN and infinite
  // ones are nulls: their places are kept, and they come back as NaN. A face without voxels has no bytes. A
  // face that one line or picture would not make smaller is stored as it is (then it comes back exactly).
  void encode(const Columns& columns, std::span<const float> values, std::vector<std::byte>& out);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

class FaceDecoder {
 public:
  FaceDecoder();
  ~FaceDecoder();
  FaceDecoder(const FaceDecoder&) = delete;
  FaceDecoder& operator=(const FaceDecoder&) = delete;

  // The values behind a code made for the same columns; values has one element per voxel. Bytes may come
  // from anywhere: throws Error kCorrupt where they are not a code of so many voxels; memory and time are
  // bounded by the number of voxels, whatever the bytes.
  void decode(std::span<const std::byte> code, const Columns& columns, std::span<float> values);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace footwall::extract::lapped
