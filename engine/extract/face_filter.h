// `filter`: the voxel values of a face, band-passed or sharpened as a picture in the face's own raster.
//
// The raster has a cell for each column of the face (voxelize/rows.h: columns stand on the two axes that the
// face leans least to); its value is the mean of the column's values that are not null. All filters are made
// of low-pass filters L_w with half amplitude at a wavelength of w voxels:
//
//   H(f) = (1 + (2^(1/4) - 1) f^2 w^2)^-4      f in cycles per voxel, whatever the direction
//
//   band=SHORT,LONG          L_SHORT - L_LONG of the raster, for each voxel of the column; SHORT = 0 keeps
//   all
//                            that is short
//   sharpen=AMOUNT,LENGTH    value + AMOUNT x (raster - L_LENGTH of the raster)
//
// Masked places (cells outside the triangle or the survey, and columns of nulls) take no part: each L is
// divided by the same L of the mask (normalized convolution), so that a constant stays constant up to the
// face's edge. H's kernel is positive, so that this never divides by little. A null voxel stays null.
//
// The result is the raw float32 values in canonical order (face_rows.h), NaN = null; nothing for a face
// without voxels. The transforms are FFTW's, in double; what they round depends on the processor, by some
// 1e-16 of the face's largest value, so results are rounded to 2^-22 of the power of two above that: they are
// the same on all ranks of one kind of processor, and between kinds but for about one value in 10^9.
#pragma once
#include <memory>

#include "engine/extract/whole_face.h"

namespace footwall::extract {

// Throws kUsage for an Options::filter that is none of the above: SHORT 0 or 2..4096, LONG above SHORT and
// 2..4096, AMOUNT 0..100, LENGTH 2..4096.
std::unique_ptr<WholeFace> make_face_filter(const Options& options);

}  // namespace footwall::extract
