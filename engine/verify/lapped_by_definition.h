// The lapped orthogonal transform as the plain matrix product that it is, in long double.
#pragma once
#include <array>
#include <span>
#include <vector>

namespace footwall::verify {

// 16 values by 8 bands, in order of frequency.
using LappedMatrix = std::array<std::array<long double, 8>, 16>;

// From cosines and rotations; the angles in units of pi.
LappedMatrix lapped_matrix(const std::array<long double, 3>& angles);

// The largest difference of the products of columns from those of an orthonormal lapped basis.
long double distance_from_orthonormal(const LappedMatrix& matrix);

// How much less the geometric mean of the bands' variances is than the signal's, in dB, for a stationary
// signal with this autocorrelation at lags 0..15.
long double coding_gain_db(const LappedMatrix& matrix, std::span<const long double> autocorrelation);

// The coefficients of values continued by 4 mirrored ones at either end, and back; size() is a multiple of 8.
std::vector<long double> lapped_forward(std::span<const long double> values, const LappedMatrix& matrix);
std::vector<long double> lapped_inverse(std::span<const long double> coefficients,
                                        const LappedMatrix& matrix);

}  // namespace footwall::verify
