// The whole-face computations `lot` and `voxels`: a face's voxel values as few bytes, or as they are.
#pragma once
#include <memory>
#include <string_view>

#include "engine/extract/lapped/columns.h"
#include "engine/extract/lapped/face_code.h"
#include "engine/extract/whole_face.h"

namespace footwall::extract {

// Options::lot_order as the coder wants it: "2d" (the face's picture; a face that is too narrow for it is a
// line) or "1d" (the line of seed 004, section 5.2.1), with parameters: "zero" (1d: a block of zeros at
// either end in the place of the mirror image), "tuned" (the angles for band-limited traces, along the sample
// axis; 1d: along the line). Throws kUsage.
struct LotCoding {
  lapped::Coding coding;
  bool tuned = false;
};
LotCoding lot_coding(const Options& options);

// Whether the results of a computation are the values of a face's voxels, in some form (computations.h).
bool holds_voxels(std::string_view computation);

// The values behind a face's bytes, in the canonical order of `rows`, as the voxelizer of the run gives them;
// NaN for nulls. Used for face after face. Throws kCorrupt; kUnsupported for another computation.
class VoxelReader {
 public:
  explicit VoxelReader(std::string_view computation);
  void read(std::span<const std::byte> bytes, const FaceRows& rows, std::vector<float>& values);

 private:
  bool coded_;
  lapped::FaceDecoder decoder_;
  lapped::Columns columns_;
};

// The shape of a face for the coder. Rows that do not stand in one lattice by ascending v and u, as a
// voxelizer may give them, become one long column, which is coded as a line.
void columns_of(const FaceRows& rows, lapped::Columns& columns);

// options.snr > 0: the bytes of lapped/face_code.h. 0: the transform alone, as seed 004 computed it, with the
// energy of the coefficients held against that of the values (kInternal where they differ); no bytes.
std::unique_ptr<WholeFace> make_lot(const Options& options);
// The values as float32, little-endian, in canonical order; every null as the same NaN.
std::unique_ptr<WholeFace> make_voxels(const Options& options);

}  // namespace footwall::extract
