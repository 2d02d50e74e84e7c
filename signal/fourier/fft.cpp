#include "signal/fourier/fft.h"

#include <fftw3.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "signal/checks_private.h"

namespace fanbeam::signal {
namespace {

template <typename Real>
struct Library;

template <>
struct Library<float> {
  using Plan = fftwf_plan;
  using Value = fftwf_complex;
  static Plan plan(const FftLayout& l, Value* in, Value* out, int sign, unsigned flags) {
    return fftwf_plan_many_dft(1, &l.length, l.batches, in, nullptr, l.stride, l.distance, out,
                               nullptr, l.stride, l.distance, sign, flags);
  }
  static void run(Plan plan, Value* in, Value* out) { fftwf_execute_dft(plan, in, out); }
  static void free(Plan plan) { fftwf_destroy_plan(plan); }
  static bool aligned(Value* values) {
    return fftwf_alignment_of(reinterpret_cast<float*>(values)) == 0;
  }
};

template <>
struct Library<double> {
  using Plan = fftw_plan;
  using Value = fftw_complex;
  static Plan plan(const FftLayout& l, Value* in, Value* out, int sign, unsigned flags) {
    return fftw_plan_many_dft(1, &l.length, l.batches, in, nullptr, l.stride, l.distance, out,
                              nullptr, l.stride, l.distance, sign, flags);
  }
  static void run(Plan plan, Value* in, Value* out) { fftw_execute_dft(plan, in, out); }
  static void free(Plan plan) { fftw_destroy_plan(plan); }
  static bool aligned(Value* values) {
    return fftw_alignment_of(reinterpret_cast<double*>(values)) == 0;
  }
};

// The library's planner is not thread-safe; running a plan is.
std::mutex& planner_mutex() {
  static std::mutex mutex;
  return mutex;
}

void check_layout(const FftLayout& layout) {
  const auto at_least_one = [](const char* field, int value) {
    if (value < 1) refuse(field, value, "1 or more");
  };
  at_least_one("fft.length", layout.length);
  at_least_one("fft.stride", layout.stride);
  at_least_one("fft.batches", layout.batches);
  if (layout.batches > 1) at_least_one("fft.distance", layout.distance);
}

}  // namespace

// The plans of one layout and direction: in place or not, aligned or not, each made when it is
// first needed.
template <typename Real>
class FftPlans {
 public:
  FftPlans(const FftLayout& layout, FftDirection direction)
      : layout_(layout), sign_(direction == FftDirection::forward ? FFTW_FORWARD : FFTW_BACKWARD) {}
  ~FftPlans() {
    for (const auto plan : plans_)
      if (plan != nullptr) Library<Real>::free(plan);
  }
  FftPlans(const FftPlans&) = delete;
  FftPlans& operator=(const FftPlans&) = delete;

  void run(std::complex<Real>* in, std::complex<Real>* out) {
    auto* const from = reinterpret_cast<typename Library<Real>::Value*>(in);
    auto* const to = reinterpret_cast<typename Library<Real>::Value*>(out);
    const bool aligned = Library<Real>::aligned(from) && Library<Real>::aligned(to);
    const std::size_t kind = (in == out ? 1U : 0U) + (aligned ? 2U : 0U);
    std::call_once(made_[kind], [&] {
      const std::lock_guard<std::mutex> lock(planner_mutex());
      const unsigned flags = FFTW_ESTIMATE | (aligned ? 0U : FFTW_UNALIGNED);
      // An estimate looks at the addresses only, never at the values.
      plans_[kind] = Library<Real>::plan(layout_, from, to, sign_, flags);
    });
    if (plans_[kind] == nullptr) throw core::InternalError("no plan for a Fourier transform");
    Library<Real>::run(plans_[kind], from, to);
  }

 private:
  FftLayout layout_;
  int sign_;
  std::array<std::once_flag, 4> made_;
  std::array<typename Library<Real>::Plan, 4> plans_{};
};

namespace {

template <typename Real>
FftPlans<Real>* kept_plans(const FftLayout& layout, FftDirection direction) {
  using Key = std::pair<FftLayout, FftDirection>;
  static std::mutex mutex;
  static std::map<Key, std::unique_ptr<FftPlans<Real>>> plans;
  const std::lock_guard<std::mutex> lock(mutex);
  auto& found = plans[Key{layout, direction}];
  if (found == nullptr) found = std::make_unique<FftPlans<Real>>(layout, direction);
  return found.get();
}

}  // namespace

template <typename Real>
Fft<Real>::Fft(const FftLayout& layout, FftDirection direction) {
  check_layout(layout);
  plans_ = kept_plans<Real>(layout, direction);
}

template <typename Real>
void Fft<Real>::run(std::complex<Real>* values) const {
  plans_->run(values, values);
}

template <typename Real>
void Fft<Real>::run(const std::complex<Real>* in, std::complex<Real>* out) const {
  // Complex transforms out of place keep their input unless told otherwise.
  plans_->run(const_cast<std::complex<Real>*>(in), out);
}

template class Fft<float>;
template class Fft<double>;

int fast_length(int least) {
  for (int length = std::max(1, least);; ++length) {
    int rest = length;
    for (const int factor : {2, 3, 5})
      while (rest % factor == 0) rest /= factor;
    if (rest == 1) return length;
  }
}

std::vector<std::complex<double>> spectrum(std::vector<std::complex<double>> values) {
  if (values.empty()) return values;
  Fft<double>({.length = static_cast<int>(values.size())}, FftDirection::forward)
      .run(values.data());
  return values;
}

std::vector<std::complex<double>> inverse_spectrum(std::vector<std::complex<double>> values) {
  if (values.empty()) return values;
  Fft<double>({.length = static_cast<int>(values.size())}, FftDirection::inverse)
      .run(values.data());
  const double scale = 1.0 / static_cast<double>(values.size());
  for (std::complex<double>& value : values) value *= scale;
  return values;
}

}  // namespace fanbeam::signal
