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

std::vector<std::complex<double>> compressed(const std::vector<std::complex<double>>& x,
                                             const std::vector<std::complex<double>>& pulse) {
  if (x.empty() || pulse.empty()) return std::vector<std::complex<double>>(x.size());
  std::vector<std::complex<double>> reversed(pulse.rbegin(), pulse.rend());
  for (auto& value : reversed) value = std::conj(value);
  const auto all = convolved(x, reversed);
  const auto first = all.begin() + static_cast<std::ptrdiff_t>(pulse.size() - 1);
  return {first, first + static_cast<std::ptrdiff_t>(x.size())};
}

}  // namespace fanbeam::signal
