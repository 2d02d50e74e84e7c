#include "signal/waveform/m_sequence.h"

#include <array>
#include <cstdint>

#include "signal/checks_private.h"

namespace fanbeam::signal {
namespace {

constexpr int kLeastDegree = 3;
// Bit k - 1 stands for x^k; the constant term is left out.
constexpr std::array<std::uint32_t, 10> kPolynomials = {0x6,  0xC,   0x14,  0x30,  0x60,
                                                        0xB8, 0x110, 0x240, 0x500, 0xE08};

}  // namespace

std::vector<int> m_sequence(int degree) {
  check_count("code degree", degree, kLeastDegree,
              kLeastDegree + static_cast<int>(kPolynomials.size()) - 1);
  const std::uint32_t polynomial = kPolynomials[static_cast<std::size_t>(degree - kLeastDegree)];
  std::vector<int> chips;
  std::uint32_t state = 1;
  for (int i = 0; i < (1 << degree) - 1; ++i) {
    const bool out = (state & 1u) != 0;
    chips.push_back(out ? 1 : -1);
    state >>= 1;
    if (out) state ^= polynomial;
  }
  return chips;
}

}  // namespace fanbeam::signal
