#include "signal/fourier/fast_convolution.h"

#include <cstddef>

#include "signal/fourier/fft.h"

namespace fanbeam::signal {

std::vector<std::complex<double>> convolved(const std::vector<std::complex<double>>& x,
                                            const std::vector<std::complex<double>>& h) {
  if (x.empty() || h.empty()) return {};
  const std::size_t count = x.size() + h.size() - 1;
  const auto length = static_cast<std::size_t>(fast_length(static_cast<int>(count)));
  const auto padded_spectrum = [length](std::vector<std::complex<double>> values) {
    values.resize(length);
    return spectrum(std::move(values));
  };
  auto product = padded_spectrum(x);
  const auto other = padded_spectrum(h);
  for (std::size_t k = 0; k < length; ++k) product[k] *= other[k];
  auto result = inverse_spectrum(std::move(product));
  result.resize(count);
  return result;
}

}  // namespace fanbeam::signal
