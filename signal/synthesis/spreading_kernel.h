// The kernel by which a non-uniform Fourier transform spreads a point over its grid.
//
// Type 1: F[k] = sum over paths of a exp(j 2 pi k x), |k| <= N / 2, x any real number. Each path is
// spread over w cells of a grid of G >= 2 N cells, the grid is transformed, and the result is
// divided by the kernel's own transform. Kernel: exp(beta (sqrt(1 - (2 t / w)^2) - 1)), t in cells,
// |t| <= w / 2, beta = 2.30 w.
// Source: A. H. Barnett, J. Magland, L. af Klinteberg, "A parallel nonuniform fast Fourier
// transform library based on an exponential of semicircle kernel", SIAM J. Sci. Comput. 41, 2019.
// Relative L2 error with G = 2 N: `spreading_error`.
// A tap as a function of the place between cells is a polynomial of degree w + 3; two taps that
// mirror each other share its even and odd part.
#pragma once

#include <array>
#include <vector>

namespace fanbeam::signal {

struct SpreadingError {
  int width;
  double relative;
};
inline constexpr std::array<SpreadingError, 7> kSpreadingErrors = {
    {{4, 8.2e-4}, {5, 7.6e-5}, {6, 7.5e-6}, {7, 8.4e-7}, {8, 1.1e-7}, {10, 1.5e-9}, {12, 1.5e-11}}};

class SpreadingKernel {
 public:
  // Widths 2 to 16; E-RANGE otherwise.
  explicit SpreadingKernel(int width);

  int width() const { return width_; }
  int degree() const { return width_ + 3; }
  // t in cells.
  double value(double offset_cells) const;
  // Integral of value(t) cos(2 pi t f) dt, f in turns per cell, at most 1/2. Error
  // 1e-4 exp(-beta): far below that of the spreading.
  double transform(double turns_per_cell) const;
  // Coefficients of tap j (0 to w - 1) in powers of u, -1 <= u <= 1: value(-w/2 + j + (u + 1) / 2).
  // degree() + 1 numbers for each tap, constant first.
  const std::vector<double>& taps() const { return taps_; }

 private:
  int width_;
  double beta_;
  std::vector<double> taps_;
  std::vector<double> nodes_, weights_;  // of the transform
};

// Of the next narrower width in the table; E-RANGE below 4.
double spreading_error(int width);

// The least width whose error stays below a quarter of `relative_error`: 4, 6, 8, 10 or 12.
int kernel_width(double relative_error);

}  // namespace fanbeam::signal
