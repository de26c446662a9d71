// A picture and its mask under low-pass filters by FFT: FFTW behind one small class.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace footwall::extract {

// One per thread; plans and memory are kept for sizes met before.
class Spectrum {
 public:
  Spectrum();
  ~Spectrum();
  Spectrum(const Spectrum&) = delete;
  Spectrum& operator=(const Spectrum&) = delete;

  // Transforms value and mask, [height][width] each, with at least `reach` zeros behind each row and column,
  // so that one end does not leak into the other. Throws std::bad_alloc.
  void take(std::span<const double> value, std::span<const double> mask, std::int64_t width,
            std::int64_t height, std::int64_t reach);
  // What take() got, multiplied by gain(f^2) at every frequency f (cycles per cell, both axes together).
  void low_pass(const std::function<double(double)>& gain, std::vector<double>& value,
                std::vector<double>& mask);

 private:
  struct Plan;
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace footwall::extract
