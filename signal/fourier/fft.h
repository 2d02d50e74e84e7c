// The discrete Fourier transform of complex values, single or in batches along any axis of an
// array.
//
//   forward   X[k] = sum over n of x[n] exp(-j 2 pi k n / N)
//   inverse   x[n] = sum over k of X[k] exp(+j 2 pi k n / N)
//
// Neither is scaled: inverse after forward gives N times the input. Parseval:
// sum |X|^2 = N sum |x|^2.
//
// Method: M. Frigo, S. G. Johnson, "The design and implementation of FFTW3", Proc. IEEE 93, 2005.
// Plans are estimated, never measured, so that one machine gives the same bits in every run. They
// are made once per layout and kept until the program ends; every function here may be called from
// several threads at once.
//
// Inputs: any length from 1, primes included. E-RANGE otherwise. Accuracy against a direct sum in
// extended precision: relative L2 error below 1e-15 sqrt(log2 N) in double, 5e-7 in float. Cost:
// about 5 N log2 N operations. The last bits may depend on the instruction set, and on whether the
// values start at a multiple of 16 bytes (as those of a std::vector do).
#pragma once

#include <complex>
#include <cstddef>
#include <vector>

namespace fanbeam::signal {

enum class FftDirection { forward, inverse };

// `batches` transforms of `length` values that lie `stride` apart; the first values of neighbouring
// transforms lie `distance` apart. Counts are of complex values.
struct FftLayout {
  int length = 1;
  int stride = 1;
  int batches = 1;
  int distance = 0;
  auto operator<=>(const FftLayout&) const = default;
};

template <typename Real>
class FftPlans;

// A transform that is ready to run; copies are free.
template <typename Real>
class Fft {
 public:
  Fft(const FftLayout& layout, FftDirection direction);

  void run(std::complex<Real>* values) const;
  // The two arrays must not overlap; the input is kept.
  void run(const std::complex<Real>* in, std::complex<Real>* out) const;

 private:
  FftPlans<Real>* plans_;
};

extern template class Fft<float>;
extern template class Fft<double>;

// The smallest product of 2, 3 and 5 that is not below `least`: a length that is transformed fast.
int fast_length(int least);

// One whole array, for where speed does not matter. The inverse is scaled by 1/N here.
std::vector<std::complex<double>> spectrum(std::vector<std::complex<double>> values);
std::vector<std::complex<double>> inverse_spectrum(std::vector<std::complex<double>> values);

}  // namespace fanbeam::signal
