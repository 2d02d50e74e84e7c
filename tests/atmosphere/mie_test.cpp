#include "atmosphere/precipitation/mie.h"

#include <cmath>
#include <vector>

#include "core/constants.h"
#include "tests/atmosphere/within.h"

using namespace fanbeam;
using namespace fanbeam::atmosphere;

TEST_CASE("Extinction agrees with the published test cases of Wiscombe", "[mie]") {
  // W. J. Wiscombe, Mie Scattering Calculations, NCAR/TN-140+STR, 1979, test cases; the imaginary
  // part of the index is positive here. x = 0.099, m = 0.75 is also a case of Bohren and Huffman.
  struct Case {
    std::complex<double> index;
    double size, extinction, digits;
  };
  const std::vector<Case> cases = {
      {{0.75, 0.0}, 0.099, 7.417859e-6, 1e-6}, {{0.75, 0.0}, 0.101, 8.033538e-6, 1e-6},
      {{0.75, 0.0}, 10.0, 2.232265, 1e-6},     {{0.75, 0.0}, 1000.0, 1.997908, 1e-6},
      {{1.33, 1e-5}, 1.0, 0.093952, 1e-5},     {{1.33, 1e-5}, 100.0, 2.101321, 1e-6},
      {{1.33, 1e-5}, 1e4, 2.004089, 1e-6},     {{1.5, 0.0}, 10.0, 2.881999, 1e-6},
      {{1.5, 0.0}, 100.0, 2.094388, 1e-6},     {{1.5, 0.0}, 1000.0, 2.013945, 1e-6},
      {{1.5, 1.0}, 0.055, 0.1014910, 1e-6},    {{1.5, 1.0}, 0.056, 0.1033467, 1e-6},
      {{1.5, 1.0}, 1.0, 2.336321, 1e-6},       {{1.5, 1.0}, 100.0, 2.097502, 1e-6},
      {{1.5, 1.0}, 1e4, 2.004368, 1e-6},       {{10.0, 10.0}, 1.0, 2.532993, 1e-6},
      {{10.0, 10.0}, 100.0, 2.071124, 1e-6},   {{10.0, 10.0}, 1e4, 2.005914, 1e-6}};
  for (const Case& c : cases) {
    INFO("m = " << c.index << ", x = " << c.size);
    CHECK(mie_efficiencies(c.size, c.index).extinction == tests::within(c.extinction, c.digits));
  }
}

TEST_CASE("Backscatter agrees with the example of Bohren and Huffman", "[mie]") {
  // Page 482: radius 0.525 um, index 1.55, wavelength 0.6328 um: Q_ext 3.10543, Q_back 2.92534.
  const MieEfficiencies q = mie_efficiencies(2.0 * core::kPi * 0.525 / 0.6328, {1.55, 0.0});
  CHECK(q.extinction == tests::within(3.10543, 2e-6));
  CHECK(q.backscatter == tests::within(2.92534, 2e-6));
}

TEST_CASE("Small spheres follow Rayleigh", "[mie]") {
  const std::complex<double> index(5.0, 2.8);  // water at 35 GHz, about
  const std::complex<double> square = index * index;
  const std::complex<double> k = (square - 1.0) / (square + 2.0);
  for (const double x : {1e-5, 1e-4, 1e-3}) {
    const MieEfficiencies q = mie_efficiencies(x, index);
    // Corrections are of relative order |m|^2 x^2.
    CHECK(q.backscatter == tests::within(4.0 * std::pow(x, 4.0) * std::norm(k), 60.0 * x * x));
    CHECK(q.extinction == tests::within(4.0 * x * k.imag(), 60.0 * x * x + 1e-12));
  }
}

TEST_CASE("Large absorbing spheres take twice their shadow and mirror like a plane", "[mie]") {
  const std::complex<double> index(3.0, 2.0);
  const double mirror = std::norm((index - 1.0) / (index + 1.0));
  for (const double x : {1000.0, 10000.0}) {
    const MieEfficiencies q = mie_efficiencies(x, index);
    CHECK(q.extinction == Approx(2.0).epsilon(0.0).margin(3.0 * std::pow(x, -2.0 / 3.0)));
    CHECK(q.backscatter == Approx(mirror).epsilon(0.0).margin(3.0 / x));
  }
  // A perfect conductor returns its own cross-section.
  CHECK(mie_efficiencies(1000.0, {1e2, 1e2}).backscatter == Approx(1.0).epsilon(0.0).margin(0.03));
}
