#include "engine/extract/spectrum.h"

#include <fftw3.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <new>

#include "storage/base/error.h"

namespace footwall::extract {
namespace {

// FFTW's planner is one for the whole process.
std::mutex& planner() {
  static std::mutex mutex;
  return mutex;
}

// The least length of 2^a 3^b 5^c that is not smaller.
std::int64_t good_length(std::int64_t least) {
  for (std::int64_t length = least;; ++length) {
    std::int64_t rest = length;
    for (const std::int64_t prime : {2, 3, 5}) {
      while (rest % prime == 0) rest /= prime;
    }
    if (rest == 1) return length;
  }
}

template <typename T>
struct Release {
  void operator()(T* memory) const { fftw_free(memory); }
};
template <typename T>
using Memory = std::unique_ptr<T[], Release<T>>;

template <typename T>
Memory<T> memory(std::size_t count) {
  auto* raw = static_cast<T*>(fftw_malloc(count * sizeof(T)));
  if (raw == nullptr) throw std::bad_alloc();
  return Memory<T>(raw);
}

}  // namespace

// Of one size. Plans are estimated, not measured: the same ones in every run.
struct Spectrum::Plan {
  Plan(std::int64_t padded_width, std::int64_t padded_height)
      : width(padded_width),
        height(padded_height),
        half(padded_width / 2 + 1),
        cells(memory<double>(static_cast<std::size_t>(width * height))),
        waves(memory<fftw_complex>(static_cast<std::size_t>(half * height))),
        of_value(memory<fftw_complex>(static_cast<std::size_t>(half * height))),
        of_mask(memory<fftw_complex>(static_cast<std::size_t>(half * height))) {
    const std::lock_guard lock(planner());
    const auto h = static_cast<int>(height);
    const auto w = static_cast<int>(width);
    forward = fftw_plan_dft_r2c_2d(h, w, cells.get(), waves.get(), FFTW_ESTIMATE);
    backward = fftw_plan_dft_c2r_2d(h, w, waves.get(), cells.get(), FFTW_ESTIMATE);
    if (forward == nullptr || backward == nullptr) throw std::bad_alloc();
  }
  ~Plan() {
    const std::lock_guard lock(planner());
    if (forward != nullptr) fftw_destroy_plan(forward);
    if (backward != nullptr) fftw_destroy_plan(backward);
  }
  Plan(const Plan&) = delete;
  Plan& operator=(const Plan&) = delete;

  std::size_t count() const { return static_cast<std::size_t>(half * height); }

  std::int64_t width, height, half;
  Memory<double> cells;                           // [height][width]
  Memory<fftw_complex> waves, of_value, of_mask;  // [height][half]
  fftw_plan forward = nullptr;
  fftw_plan backward = nullptr;
};

struct Spectrum::State {
  std::map<std::pair<std::int64_t, std::int64_t>, Plan> plans;
  Plan* plan = nullptr;  // of the picture at hand
  std::int64_t width = 0;
  std::int64_t height = 0;
};

Spectrum::Spectrum() : state_(std::make_unique<State>()) {}
Spectrum::~Spectrum() = default;

void Spectrum::take(std::span<const double> value, std::span<const double> mask, std::int64_t width,
                    std::int64_t height, std::int64_t reach) {
  require(static_cast<std::int64_t>(value.size()) == width * height && mask.size() == value.size(),
          "a picture and its mask");
  // Some sizes more than needed, so that faces share plans.
  constexpr std::int64_t kStep = 16;
  const auto padded = [&](std::int64_t length) {
    return good_length((length + reach + kStep - 1) / kStep * kStep);
  };
  const auto size = std::pair(padded(width), padded(height));
  constexpr std::size_t kMostPlans = 64;
  if (state_->plans.size() >= kMostPlans && !state_->plans.contains(size)) state_->plans.clear();
  Plan& plan = state_->plans.try_emplace(size, size.first, size.second).first->second;
  state_->plan = &plan;
  state_->width = width;
  state_->height = height;
  for (const auto& [from, to] : {std::pair{value, &plan.of_value}, {mask, &plan.of_mask}}) {
    std::fill_n(plan.cells.get(), plan.width * plan.height, 0.0);
    for (std::int64_t row = 0; row < height; ++row)
      std::copy_n(from.data() + row * width, width, plan.cells.get() + row * plan.width);
    fftw_execute_dft_r2c(plan.forward, plan.cells.get(), to->get());
  }
}

void Spectrum::low_pass(const std::function<double(double)>& gain, std::vector<double>& value,
                        std::vector<double>& mask) {
  require(state_->plan != nullptr, "a picture");
  Plan& plan = *state_->plan;
  const double scale = 1 / (static_cast<double>(plan.width) * static_cast<double>(plan.height));
  for (const auto& [from, to] : {std::pair{&plan.of_value, &value}, {&plan.of_mask, &mask}}) {
    for (std::int64_t row = 0; row < plan.height; ++row) {
      const double v =
          static_cast<double>(std::min(row, plan.height - row)) / static_cast<double>(plan.height);
      for (std::int64_t column = 0; column < plan.half; ++column) {
        const double u = static_cast<double>(column) / static_cast<double>(plan.width);
        const double factor = scale * gain(u * u + v * v);
        const auto n = static_cast<std::size_t>(row * plan.half + column);
        plan.waves[n][0] = (*from)[n][0] * factor;
        plan.waves[n][1] = (*from)[n][1] * factor;
      }
    }
    fftw_execute(plan.backward);
    to->resize(static_cast<std::size_t>(state_->width * state_->height));
    for (std::int64_t row = 0; row < state_->height; ++row)
      std::copy_n(plan.cells.get() + row * plan.width, state_->width, to->data() + row * state_->width);
  }
}

}  // namespace footwall::extract
