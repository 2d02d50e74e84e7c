#include "signal/angle/spatial_spectrum.h"

#include <Eigen/Cholesky>
#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "signal/checks_private.h"
#include "signal/fourier/peak_fit.h"

namespace fanbeam::signal {
namespace {

using Matrix = Eigen::MatrixXcd;

Matrix matrix_of(const Covariance& covariance) {
  const int n = covariance.elements;
  if (n < 1 ||
      covariance.values.size() != static_cast<std::size_t>(n) * static_cast<std::size_t>(n))
    refuse("covariance.elements", n, "1 or more, with as many values as its square");
  Matrix matrix(n, n);
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) matrix(row, column) = covariance.at(row, column);
  return matrix;
}

void check_steering(const Covariance& covariance, const Steering& steering) {
  if (steering.elements != covariance.elements)
    refuse("steering.elements", steering.elements, "the size of the covariance");
}

Eigen::Map<const Eigen::VectorXcd> beam_vector(const Steering& steering, int beam) {
  return {&steering.at(beam, 0), steering.elements};
}

}  // namespace

std::vector<double> capon_spectrum(const Covariance& covariance, const Steering& steering,
                                   double loading) {
  check_steering(covariance, steering);
  if (!(loading >= 0.0)) refuse("loading", loading, "0 or more");
  Matrix r = matrix_of(covariance);
  const double load = loading * r.trace().real() / covariance.elements;
  r.diagonal().array() += load;
  std::vector<double> powers(static_cast<std::size_t>(steering.beams), 0.0);
  const Eigen::LLT<Matrix> cholesky(r);
  if (cholesky.info() != Eigen::Success) return powers;
  for (int beam = 0; beam < steering.beams; ++beam) {
    // a^H R^-1 a = |L^-1 a|^2
    const double inverse = cholesky.matrixL().solve(beam_vector(steering, beam)).squaredNorm();
    if (std::isfinite(inverse) && inverse > 0.0)
      powers[static_cast<std::size_t>(beam)] = 1.0 / inverse;
  }
  return powers;
}

std::vector<double> music_spectrum(const Covariance& covariance, const Steering& steering,
                                   int sources) {
  check_steering(covariance, steering);
  if (sources < 0 || sources >= covariance.elements)
    refuse("sources", sources, "0 to one less than the elements");
  // Eigenvalues rise: the noise space is at the front.
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(matrix_of(covariance));
  const Matrix noise = eigen.eigenvectors().leftCols(covariance.elements - sources).adjoint();
  std::vector<double> powers(static_cast<std::size_t>(steering.beams));
  constexpr double kLeast = 1e-30;  // a direction may lie in the signal space to the last bit
  for (int beam = 0; beam < steering.beams; ++beam)
    powers[static_cast<std::size_t>(beam)] =
        1.0 / std::max(kLeast, (noise * beam_vector(steering, beam)).squaredNorm());
  return powers;
}

std::vector<double> eigenvalues(const Covariance& covariance) {
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(matrix_of(covariance), Eigen::EigenvaluesOnly);
  return {eigen.eigenvalues().begin(), eigen.eigenvalues().end()};
}

std::vector<SpectrumPeak> spectrum_peaks(const std::vector<double>& powers) {
  std::vector<SpectrumPeak> peaks;
  for (std::size_t i = 1; i + 1 < powers.size(); ++i) {
    if (!(powers[i] > powers[i - 1] && powers[i] >= powers[i + 1])) continue;
    const PeakFit fit = log_parabola_peak(powers[i - 1], powers[i], powers[i + 1]);
    peaks.push_back({static_cast<double>(i) + fit.offset, fit.top});
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const SpectrumPeak& a, const SpectrumPeak& b) { return a.power > b.power; });
  return peaks;
}

}  // namespace fanbeam::signal
